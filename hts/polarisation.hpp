/// Jones and Mueller calculus in the frames of the surface, and the reflection of polarised light by one
/// facet.
///
/// Frames. Every ray with propagation direction k has s = k x z / |k x z| and p = s x k [He91 (14), (35)];
/// along the normal the limit is taken along the given azimuth. Incident light has k_i = -in, reflected light
/// k_r = out. Stokes vector of a field with time factor exp(-i omega t):
///   S = (|E_s|^2 + |E_p|^2, |E_s|^2 - |E_p|^2, 2 Re E_s E_p*, -2 Im E_s E_p*).
#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "hts/direction.hpp"
#include "hts/fresnel.hpp"

namespace hts {

/// Complex field amplitudes along s and p.
struct JonesVector {
    std::complex<double> s, p;
};

/// Reflected from incident field; `sp` is the s field that unit p light causes.
struct JonesMatrix {
    std::complex<double> ss, sp, ps, pp;
};

/// State of polarisation of light, fully, partly or not polarised.
class Stokes {
  public:
    ///   s0   intensity, >= 0     s1, s2, s3   s1^2 + s2^2 + s3^2 <= s0^2 (to 1e-12), else hts::Error
    Stokes(double s0, double s1, double s2, double s3);

    [[nodiscard]] static Stokes unpolarised() { return {1, 0, 0, 0}; }
    [[nodiscard]] static Stokes s_polarised() { return {1, 1, 0, 0}; }
    [[nodiscard]] static Stokes p_polarised() { return {1, -1, 0, 0}; }
    [[nodiscard]] static Stokes from_jones(const JonesVector& field);

    [[nodiscard]] double operator[](std::size_t i) const noexcept { return components_[i]; }
    [[nodiscard]] double intensity() const noexcept { return components_[0]; }
    /// Polarised fraction of the intensity, 0 ... 1; 0 for no light.
    [[nodiscard]] double degree_of_polarisation() const noexcept;
    /// Angle from s towards p of the major axis of the polarisation ellipse [rad], (-pi/2, pi/2]; 0 if
    /// undefined.
    [[nodiscard]] double angle_of_polarisation() const noexcept;

  private:
    friend class Mueller;
    struct Unchecked {};
    Stokes(Unchecked, const std::array<double, 4>& components) noexcept : components_{components} {}
    std::array<double, 4> components_;
};

/// Reflected from incident Stokes vector, 4 x 4.
class Mueller {
  public:
    /// All zero.
    Mueller() noexcept = default;
    /// From its elements, row by row.
    [[nodiscard]] static Mueller from_elements(const std::array<double, 16>& elements) noexcept;
    /// Of a deterministic reflection: M_ij = Tr(sigma_i J sigma_j J^+) / 2.
    [[nodiscard]] static Mueller from_jones(const JonesMatrix& jones) noexcept;
    /// Derivative of `from_jones` where the Jones matrix changes by `by`: bilinear in both.
    [[nodiscard]] static Mueller from_jones_gradient(const JonesMatrix& jones,
                                                     const JonesMatrix& by) noexcept;
    /// Unpolarised light of the given reflectance whatever comes in.
    [[nodiscard]] static Mueller depolariser(double reflectance) noexcept;

    [[nodiscard]] double operator()(std::size_t row, std::size_t column) const noexcept {
        return elements_[4 * row + column];
    }
    /// Row by row.
    [[nodiscard]] const std::array<double, 16>& elements() const noexcept { return elements_; }
    [[nodiscard]] Stokes operator*(const Stokes& incident) const noexcept;
    [[nodiscard]] friend Mueller operator*(double scale, Mueller mueller) noexcept {
        for (double& element : mueller.elements_) element *= scale;
        return mueller;
    }
    [[nodiscard]] friend Mueller operator+(Mueller a, const Mueller& b) noexcept {
        for (std::size_t i = 0; i < a.elements_.size(); ++i) a.elements_[i] += b.elements_[i];
        return a;
    }

  private:
    std::array<double, 16> elements_{};
};

/// s = k x z / |k x z| of a ray that arrives, k = -in, and of one that leaves, k = out.
[[nodiscard]] Vector3 s_vector_of_incident(const Direction& in) noexcept;
[[nodiscard]] Vector3 s_vector_of_reflected(const Direction& out) noexcept;

/// Jones matrix of the facet that mirrors `in` into `out`: a rotation into the plane of both, diag(F_s, F_p),
/// and a rotation out. Equal, but for the phase factor -1, to (61)-(64) of [He91] divided by |k_r x k_i|^2,
/// and free of their 0/0 at backscatter and along the normal. (|ss|^2 + |sp|^2 + |ps|^2 + |pp|^2)/2 = |F|^2.
///   amplitudes   at the facet's own angle of incidence, `WaveVectorChange::cos_theta_d`
[[nodiscard]] JonesMatrix facet_jones(const Direction& in, const Direction& out,
                                      const FresnelAmplitudes& amplitudes) noexcept;

/// Derivatives of `facet_jones` by the angles, at constant amplitudes: the frames turn about their rays.
///   formula   J is F_s and F_p between two rotations, by alpha_i and alpha_r; mu = in . out.
///             (F_s - F_p)/2 goes with their sum, whose derivatives are
///             (-sin theta_r sin phi, -sin theta_i sin phi, cos theta_i + cos theta_r)/(1 + mu);
///             (F_s + F_p)/2 goes with alpha_i - alpha_r, whose derivatives are
///             (sin theta_r sin phi, -sin theta_i sin phi, cos theta_i - cos theta_r)/(1 - mu),
///             where 1 - mu = 2 sin^2 theta_d cancels
///   jones     of `facet_jones`      amplitudes   of `fresnel_gradient` at theta_d
///   limits    both rays along the horizon and mirrored: 0
[[nodiscard]] ByAngles<JonesMatrix> facet_jones_gradient(const Direction& in, const Direction& out,
                                                         const JonesMatrix& jones,
                                                         const FresnelGradient& amplitudes) noexcept;

}  // namespace hts
