/// The light that meets the surface more than once, as a factor of each direction beside the
/// lobe of single reflection.
///
/// m(theta; sigma_0/tau) is the reciprocal factor with which the geometric-optics lobe of a perfect
/// mirror returns everything:
///
///   m(theta_i) integral of D(h) / (4 c_i c_r (1 + Lambda_i + Lambda_r)) m(theta_r) c_r
///   domega = 1 for all theta_i,
///
/// D Beckmann's density of facets of width 2 sigma_0/tau, Lambda Smith's function (Sinkhorn's scaling). It
/// depends on no wavelength. What is used is the interpolant of a table, in Chebyshev polynomials of y = 1/(1
/// + c), c = tau cot theta/(2 sigma_0), and of sigma_0/tau; beyond sigma_0/tau = 1 that of 1 is held, where
/// such surfaces are far outside the theory's validity.
#pragma once

#include <array>
#include <cstddef>

#include "hts/surface.hpp"

namespace hts {

namespace accuracy {
inline constexpr double return_factor =
    2e-4;  ///< of the interpolant, from the solution of the equation for sigma_0/tau <= 1
}

/// m of one surface.
class ReturnFactor {
  public:
    static constexpr std::size_t terms = 20;

    ///   slope   sigma_0/tau   >= 0
    explicit ReturnFactor(double slope) noexcept;
    /// That of an isotropic surface. Of others sigma_0/tau is that of sqrt(tau_x tau_y), while the single
    /// reflection is the mean over all azimuths, each with its own tau(alpha): what `returned` needs of them.
    explicit ReturnFactor(const Surface& surface) noexcept;

    /// m(theta) [1]; 0.5 ... 4.5.
    [[nodiscard]] double operator()(const Direction& direction) const noexcept;
    /// E, the share of uniform light that the geometric-optics lobe of a perfect mirror returns
    /// after one reflection [1].
    [[nodiscard]] double single_reflection() const noexcept { return single_reflection_; }
    /// The factor of light that is reflected again and again, R being lost at each: R E/(1 - R (1 - E)).
    ///   reflectance   R, of uniform light by the flat surface   [1]   0 ... 1
    [[nodiscard]] double returned(double reflectance) const noexcept {
        return reflectance * single_reflection_ / (1 - reflectance * (1 - single_reflection_));
    }
    /// sigma_0/tau, at most 1.
    [[nodiscard]] double slope() const noexcept { return slope_; }
    /// Of T_j(2 y - 1).
    [[nodiscard]] const std::array<double, terms>& coefficients() const noexcept { return coefficients_; }

  private:
    double slope_, single_reflection_;
    std::array<double, terms> coefficients_;
};

}  // namespace hts
