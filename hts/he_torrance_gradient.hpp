/// Derivatives of the model by everything it depends on, beside its value: what a fit, a sensitivity or an
/// uncertainty needs.
///
///     const auto in = hts::view_gradient(surface, light), out = hts::view_gradient(surface, viewer);
///     const hts::PairGradient pair{surface, in, out};
///     const auto f = hts::directional_diffuse_gradient(pair, wavelength, index);
///     f.value;             // [1/sr], what directional_diffuse gives
///     f.by.rms_roughness;  // [1/sr/um]
///
/// The formulas are those of terms.hpp, differentiated; each derivative of a part stands with the part.
/// Work is split as there: `view_gradient` once per direction, `PairGradient` once per pair, the rest once
/// per wavelength. Functions allocate nothing and are total: every derivative is finite.
///
/// Where a derivative needs a convention:
///   theta = 0      along the azimuth that the direction keeps, on both sides alike
///   phi            of the outgoing azimuth, the incident one being kept. Of isotropic surfaces, in the plane
///                  of incidence every derivative by phi is 0 but those of the eight Mueller elements that
///                  change sign with phi, which are 0 there
///   theta = 90 deg a rough surface's lobe falls to 0 there with infinite slope: where cos theta < 1e-100 all
///                  its derivatives are taken for 0
///   sigma_0 = 0    the lobe grows as sigma_0^2, the specular term falls so:
///                  derivatives by both lengths are 0
///   k = 0          one-sided; negative where n < sin theta_d, total reflection
///   films          n and k of the gradient are those of the substrate; what is asked for in `films`,
///                  outermost first, is by each film's own numbers
///   correlation    of a shape that is not Gaussian: by its length, the shape being kept; D's derivatives are
///                  those of its table, accuracy::correlation_slopes
///   n = sin theta_d (with k = 0)   the critical angle: Fresnel's amplitudes have no derivative, 0 is taken
#pragma once

#include <span>

#include "hts/terms.hpp"

namespace hts {

// Of each derivative d, beside the value f it belongs to (element 00 of a Mueller matrix): by a length p [um]
// |p d| + f, by n and k |n + ik| |d| + f, by an angle |d| + f/w. There w [rad] is the lobe's width,
// sqrt(2 m) lambda/(2 pi tau) with 1/m = -d ln Phi/dt, or 1 rad where that is less; 1 rad for the mirror
// term. For values above 1e-270, sigma_0/tau >= 0.003 and index as of accuracy::fresnel_gradient.
namespace accuracy {
inline constexpr double brdf_gradient = 2e-10;  // Phi's table: accuracy::tabled_phi_gradient
inline constexpr double mueller_gradient = 2e-10;
inline constexpr double specular_gradient = 4e-12;
inline constexpr double specular_mueller_gradient = 5e-13;
}  // namespace accuracy

/// A derivative, or a matrix of them, by each parameter of the model.
template <class Value = double>
struct Gradient {
    Value rms_roughness{};       ///< sigma_0 [1/um]
    Value correlation_length{};  ///< tau, of an anisotropic surface with tau_x/tau_y kept [1/um]
    Value n{}, k{};              ///< refractive index [1]
    Value diffuse_albedo{};      ///< a [1]
    Value theta_i{};             ///< polar angles [1/rad]; the specular term has theta_i alone
    Value theta_r{};
    Value phi{};  ///< azimuth of the outgoing less that of the incident direction [1/rad]
    Value correlation_length_x{},
        correlation_length_y{};  ///< tau_x and tau_y along the axes of the surface [1/um]
    Value azimuth{};  ///< of the first axis; turning both directions instead gives its negative [1/rad]
};

/// A BRDF with its derivatives [1/sr, 1/sr per unit of the parameter].
struct BrdfGradient {
    double value;
    Gradient<> by;
};

/// A specular reflectance with its derivatives.
struct SpecularGradient {
    SpecularReflectance value;
    Gradient<> by;
};

/// A Mueller matrix with its derivatives.
struct MuellerGradient {
    Mueller value;
    Gradient<Mueller> by;
};

/// A derivative, or a matrix of them, by what a film is.
template <class Value = double>
struct ByFilm {
    Value n{}, k{};     ///< its refractive index [1]
    Value thickness{};  ///< [1/um]
};

/// A direction, what a given surface lets it see, and how that changes.
struct ViewGradient {
    Direction direction;
    VisibilityGradient visibility;
    /// Of the logarithm of the slope width along it, by the axes and, negative, by ln tau with tau_x/tau_y
    /// kept.
    ByAxes slope_by_axes;
    double slope_by_length;

    [[nodiscard]] View view() const noexcept { return {direction, visibility.value}; }
};

///   surface   with a Gaussian correlation
[[nodiscard]] ViewGradient view_gradient(const Surface& surface, const Direction& direction) noexcept;
/// With any: then the slopes are those that the wavelength sees, and the view is for it alone.
[[nodiscard]] ViewGradient view_gradient(const Surface& surface, const Direction& direction,
                                         const Wavelength& wavelength) noexcept;

/// All that a pair of directions contributes to the lobe and to its derivatives, whatever the wavelength.
class PairGradient {
  public:
    /// Both views must be of this surface.
    PairGradient(const Surface& surface, const ViewGradient& in, const ViewGradient& out) noexcept;
    PairGradient(const Surface& surface, const Direction& in, const Direction& out) noexcept
        : PairGradient{surface, view_gradient(surface, in), view_gradient(surface, out)} {}
    PairGradient(const Surface& surface, const Direction& in, const Direction& out,
                 const Wavelength& wavelength) noexcept
        : PairGradient{surface, view_gradient(surface, in, wavelength),
                       view_gradient(surface, out, wavelength)} {}

    [[nodiscard]] const PairFactors& factors() const noexcept { return factors_; }
    [[nodiscard]] const Surface& surface() const noexcept { return surface_; }
    [[nodiscard]] const Direction& in() const noexcept { return in_; }
    [[nodiscard]] const Direction& out() const noexcept { return out_; }

    /// Derivatives of ln(sigma/sigma_0): by ln(sigma_0/tau) [1] and by the angles.
    [[nodiscard]] double log_roughness_by_log_slope() const noexcept { return log_roughness_by_log_slope_; }
    [[nodiscard]] const ByAngles<double>& log_roughness() const noexcept { return log_roughness_; }
    /// Those of ln(G S/(cos theta_i cos theta_r)).
    [[nodiscard]] double log_geometry_by_log_slope() const noexcept { return log_geometry_by_log_slope_; }
    [[nodiscard]] const ByAngles<double>& log_geometry() const noexcept { return log_geometry_; }
    /// Both, negative, by ln tau as it acts by slopes: the same where the correlation is Gaussian.
    [[nodiscard]] double log_roughness_by_log_length() const noexcept { return log_roughness_by_log_length_; }
    [[nodiscard]] double log_geometry_by_log_length() const noexcept { return log_geometry_by_log_length_; }
    /// Both by the axes of the surface.
    [[nodiscard]] const ByAxes& log_roughness_by_axes() const noexcept { return log_roughness_by_axes_; }
    [[nodiscard]] const ByAxes& log_geometry_by_axes() const noexcept { return log_geometry_by_axes_; }
    /// Those of stretched_horizontal squared, of which t is k^2 tau^2/4 times as much;
    /// by the axes with tau kept.
    [[nodiscard]] const ByAngles<double>& stretched_squared() const noexcept { return stretched_squared_; }
    [[nodiscard]] const ByAxes& stretched_squared_by_axes() const noexcept {
        return stretched_squared_by_axes_;
    }
    /// Those of v.
    [[nodiscard]] const WaveVectorChangeGradient& change() const noexcept { return change_; }
    /// Those of cos theta_d.
    [[nodiscard]] const ByAngles<double>& cos_theta_d() const noexcept { return cos_theta_d_; }

  private:
    Surface surface_;
    Direction in_, out_;
    PairFactors factors_;
    WaveVectorChangeGradient change_;
    ByAngles<double> cos_theta_d_, log_roughness_, log_geometry_, stretched_squared_;
    ByAxes log_roughness_by_axes_, log_geometry_by_axes_, stretched_squared_by_axes_;
    double log_roughness_by_log_slope_, log_geometry_by_log_slope_;
    double log_roughness_by_log_length_, log_geometry_by_log_length_;
};

/// Directional-diffuse term for unpolarised light; by.diffuse_albedo is 0.
///   error   accuracy::brdf_gradient; the value: accuracy::brdf
///   cost    about two evaluations, with views and pair or without
[[nodiscard]] BrdfGradient directional_diffuse_gradient(const PairGradient& pair,
                                                        const Wavelength& wavelength,
                                                        const CoatedIndex& index,
                                                        DiffuseLobe lobe = DiffuseLobe::full,
                                                        std::span<ByFilm<>> films = {}) noexcept;

/// Both diffuse terms together.
///   uniform_diffuse   a/pi [1/sr], see hts::uniform_diffuse
[[nodiscard]] BrdfGradient brdf_gradient(const PairGradient& pair, const Wavelength& wavelength,
                                         const CoatedIndex& index, double uniform_diffuse,
                                         DiffuseLobe lobe = DiffuseLobe::full,
                                         std::span<ByFilm<>> films = {}) noexcept;

/// Mueller matrix of the directional-diffuse term [1/sr] in the frames of polarisation.hpp, which turn with
/// the rays.
///   error   accuracy::mueller_gradient
[[nodiscard]] MuellerGradient directional_diffuse_mueller_gradient(
    const PairGradient& pair, const Wavelength& wavelength, const CoatedIndex& index,
    DiffuseLobe lobe = DiffuseLobe::full, std::span<ByFilm<Mueller>> films = {}) noexcept;

/// Specular term for unpolarised light; by.theta_i turns the outgoing direction along, the mirror of the
/// incident one.
///   error   accuracy::specular_gradient
[[nodiscard]] SpecularGradient specular_reflectance_gradient(const Surface& surface, const ViewGradient& in,
                                                             const Wavelength& wavelength,
                                                             const CoatedIndex& index,
                                                             std::span<ByFilm<>> films = {}) noexcept;

/// Its Mueller matrix [1].
///   error   accuracy::specular_mueller_gradient
[[nodiscard]] MuellerGradient specular_mueller_gradient(const Surface& surface, const ViewGradient& in,
                                                        const Wavelength& wavelength,
                                                        const CoatedIndex& index,
                                                        std::span<ByFilm<Mueller>> films = {}) noexcept;

}  // namespace hts
