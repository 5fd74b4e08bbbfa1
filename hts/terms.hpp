/// The reflectance model of He, Torrance, Sillion and Greenberg (SIGGRAPH 1991) at one wavelength:
///
///   f = specular + directional diffuse + uniform diffuse                              [He91 (5)]
///
///   specular             a delta in the mirror direction,
///                        reflectance |F|^2 exp(-g) S                                  [He91 (73)]
///   directional diffuse  |F|^2 G S D / (pi cos theta_i cos theta_r),
///                        D = pi^2 tau^2/(4 lambda^2) Phi(g, t)                        [He91 (71), (78)]
///   uniform diffuse      a/pi; the paper prints a(lambda), but its numbers are albedos  [He91 (72)]
///
/// Work that many evaluations share is split off: `view` once per direction, `PairFactors` once per pair, the
/// rest once per wavelength. BRDFs are in 1/sr, reflectances 0 ... 1. Every function is total, never NaN.
///
/// At the horizon. As theta -> 90 deg the directional-diffuse term goes to 0, but only logarithmically, since
/// sigma^2 ~ sigma_0^2/(2 ln K): at 89.9999999999 deg it can still be a quarter of its value at 89.99 deg. At
/// exactly 90 deg it is 0. A table should end short of the horizon. The specular reflectance of a mirror
/// (sigma_0 = 0) is 1 there; that of a rough surface goes to 0 at every wavelength, since the model shadows
/// the specular term too, even where lambda >> sigma_0 and a real surface would reflect all.
#pragma once

#include "hts/direction.hpp"
#include "hts/films/coated_index.hpp"
#include "hts/phi.hpp"
#include "hts/polarisation.hpp"
#include "hts/shadowing.hpp"
#include "hts/surface.hpp"
#include "hts/wavelength.hpp"

namespace hts {

// Of `directional_diffuse` and of each Mueller element beside element 00, and of `specular_reflectance`,
// relative, above 1e-280, for sigma_0/tau >= 0.003. Narrower lobes are worse in proportion: |v_xy| keeps
// 4e-16, which is relative to the lobe's width, (t/g) 4e-16/|v_xy| in all; inputs that carry
// their last bits do no better.
namespace accuracy {
inline constexpr double brdf = 4e-12;
inline constexpr double specular_reflectance = 7e-13;
inline constexpr double mueller = 4e-12;
}  // namespace accuracy

/// A direction together with what a given surface lets it see.
struct View {
    Direction direction;
    Visibility visibility;
};

[[nodiscard]] View view(const Surface& surface, const Direction& direction) noexcept;

/// How the directional-diffuse lobe depends on Phi; all but `full` are approximations for
/// surfaces that need no more.
enum class DiffuseLobe {
    none,         ///< 0: a mirror, with its uniform diffuse term
    first_order,  ///< Phi = g exp(-g - t), for g << 1 and t not large; 2 g exp(-g) W of another correlation
    /// Phi = exp(-t/g)/g, geometric optics: Beckmann's distribution; of the Gaussian correlation alone
    rough_limit,
    full,  ///< Phi(g, t)
};

[[nodiscard]] const char* name(DiffuseLobe lobe) noexcept;

/// All that a pair of directions contributes to the directional-diffuse term, whatever the wavelength.
class PairFactors {
  public:
    /// Both views must be of this surface, or of what it is `seen_by` at the wavelengths asked for. The
    /// surface must outlive the factors.
    PairFactors(const Surface& surface, const View& in, const View& out) noexcept;
    PairFactors(const Surface& surface, const Direction& in, const Direction& out) noexcept
        : PairFactors{surface, view(surface, in), view(surface, out)} {}

    [[nodiscard]] const WaveVectorChange& change() const noexcept { return change_; }
    [[nodiscard]] double cos_theta_d() const noexcept { return cos_theta_d_; }
    /// sigma [um], the roughness of what is lit and seen [He91 (80)].
    [[nodiscard]] double effective_roughness() const noexcept { return effective_roughness_; }
    /// S, the shadowing of the pair [He91 (23)].
    [[nodiscard]] double shadowing() const noexcept { return shadowing_; }
    /// g [He91 (79)].
    [[nodiscard]] double phase_variance(const Wavelength& wavelength) const noexcept;
    /// t = v_xy^2 tau^2 / 4, of an anisotropic surface (v_x'^2 tau_x^2 + v_y'^2 tau_y^2) / 4.
    [[nodiscard]] double lobe_argument(const Wavelength& wavelength) const noexcept;
    /// Phi(g, t), or 2 D(g, 2 sqrt(t)) of another correlation.
    [[nodiscard]] Phi phi(double g, double t, DiffuseLobe lobe = DiffuseLobe::full) const noexcept;
    /// The lobe for |F|^2 = 1 [1/sr], from Phi(g, t) at that wavelength.
    [[nodiscard]] double lobe(double phi, const Wavelength& wavelength) const noexcept;

  private:
    WaveVectorChange change_;
    double stretched_;  // what |v_xy| counts for in t
    double cos_theta_d_;
    double effective_roughness_;
    double shadowing_;
    double correlation_length_;
    double shadowing_over_cosines_;   // S / (cos theta_i cos theta_r)
    const Correlation* correlation_;  // none of the Gaussian
};

/// Directional-diffuse BRDF and what it was made of.
struct DirectionalDiffuse {
    double brdf;                   ///< [1/sr], unpolarised
    double lobe;                   ///< brdf / |F|^2 [1/sr]
    FresnelAmplitudes amplitudes;  ///< at theta_d
    double phase_variance;         ///< g
    double lobe_argument;          ///< t
    PhiMethod method;              ///< which branch computed Phi
};

/// Directional-diffuse term for unpolarised light.
///   error   accuracy::brdf
[[nodiscard]] DirectionalDiffuse directional_diffuse(const PairFactors& pair, const Wavelength& wavelength,
                                                     const CoatedIndex& index,
                                                     DiffuseLobe lobe = DiffuseLobe::full) noexcept;

/// Its Mueller matrix [1/sr] in the frames of polarisation.hpp; element 00 is the unpolarised BRDF.
///   error   accuracy::mueller
[[nodiscard]] Mueller directional_diffuse_mueller(const Direction& in, const Direction& out,
                                                  const DirectionalDiffuse& term) noexcept;

/// Coefficient of the specular term: reflectance into the mirror direction. Not a BRDF value, so it does not
/// add to one; averaged over a detector's or source's solid angle it is value() / (cos theta_i solid angle)
/// [He91 (70)].
class SpecularReflectance {
  public:
    explicit SpecularReflectance(double value) noexcept : value_{value} {}
    [[nodiscard]] double value() const noexcept { return value_; }

  private:
    double value_;
};

/// What roughness leaves of a mirror's reflectance in the mirror direction, exp(-g) S, all at theta_r =
/// theta_i [He91 (73)].
///   range   0 ... 1, 1 for a mirror      error   accuracy::specular_reflectance
[[nodiscard]] double coherent_fraction(const Surface& surface, const View& in,
                                       const Wavelength& wavelength) noexcept;

/// Specular term for unpolarised light, |F(theta_i)|^2 exp(-g) S, all at theta_r = theta_i.
///   error   accuracy::specular_reflectance
[[nodiscard]] SpecularReflectance specular_reflectance(const Surface& surface, const View& in,
                                                       const Wavelength& wavelength,
                                                       const CoatedIndex& index) noexcept;

/// Its Mueller matrix [1]: that of diag(F_s, F_p), times exp(-g) S.
[[nodiscard]] Mueller specular_mueller(const Surface& surface, const View& in, const Wavelength& wavelength,
                                       const CoatedIndex& index) noexcept;

/// Uniform-diffuse BRDF, albedo / pi [1/sr].
///   albedo   a, 0 ... 1, else hts::Error
[[nodiscard]] double uniform_diffuse(double albedo);

/// Its Mueller matrix [1/sr]: a depolariser.
[[nodiscard]] Mueller uniform_diffuse_mueller(double albedo);

}  // namespace hts
