/// Closed forms for light scattered by surfaces that are rough in one dimension, a perfectly conducting
/// profile z(x): what the exact solution of `moment_method` is held against.
///
/// The Kirchhoff current of a beam that lights the length L is N = 2i integral (k_i n) exp(-i v r) dl. The
/// integrand's slope is integrated away, z' -> -v_x/v_z, which leaves N = -i |v|^2/v_z integral exp(-i v r)
/// dx. Of Gaussian heights with C = exp(-xi^2/tau^2) the incoherent part of <|N|^2>/L is
///
///   (|v|^2/v_z)^2 integral exp(-i v_x xi) (exp(-g (1 - C)) - exp(-g)) dxi
///     = (|v|^2/v_z)^2 sqrt(pi) tau Phi_1(g, t)
///   Phi_1(g, t) = exp(-g) sum_{m >= 1} g^m/(m! sqrt(m)) exp(-t/m),   g = (v_z sigma)^2,   t = (v_x tau/2)^2
///
/// (the integral over xi gives sqrt(pi/m) tau exp(-t/m) where the one over a plane gives (pi tau^2/m)
/// exp(-t/m): hence Phi_1's root of m in place of m). As |psi_s|^2 r = |N|^2/(8 pi k) and L cos theta_i of
/// power falls in, the power scattered per angle, of all that falls in, is
///
///   k tau |v/k|^4/(v_z/k)^2 Phi_1(g, t) S/(8 sqrt(pi) cos theta_i)   [1/rad]
///
/// both for TE and TM, with (sigma, S) of one of the models. Lengths are in wavelengths, k = 2 pi.
///
/// A K-correlated profile has the same forms with its own C in the integral over xi, and its slopes of
/// frequencies up to 1/lambda in shadowing and effective roughness, as surfaces have in the library.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hts/surface.hpp"
#include "validation/scattering/gaussian_surface.hpp"

namespace hts::validation {

/// Phi_1.
///   g, t   0 or more; g up to 1e5      error   relative 1e-12 where it exceeds 1e-280
///   identity   integral Phi_1(g, q^2) dq = sqrt(pi) (1 - exp(-g))
[[nodiscard]] double profile_phi(double g, double t) noexcept;

/// Phi_1 with the mean of 1/m under the weights of its terms, -d ln Phi_1/dt, and 1 minus
/// it, without the difference.
struct ProfileKicks {
    double phi, inverse_mean, rest;
};
///   domain, error   as of profile_phi
[[nodiscard]] ProfileKicks profile_kicks(double g, double t) noexcept;

/// A profile's statistics, prepared.
class ProfileHeights {
  public:
    ProfileHeights(const RoughnessStatistics& of);  // NOLINT(google-explicit-constructor): what a profile is

    [[nodiscard]] const RoughnessStatistics& statistics() const noexcept { return statistics_; }
    /// What light of wavelength 1 sees: with the tau whose slopes are those of frequencies up to 1.
    [[nodiscard]] const Surface& seen() const noexcept { return seen_; }
    /// The integral over xi, over sqrt(pi) tau, or over sqrt(pi) l, which is Phi_1 of a Gaussian correlation.
    ///   across   |v_x|      domain   of a K-correlated profile g up to 40
    [[nodiscard]] ProfileKicks kicks(double g, double across) const noexcept;
    /// Its value alone.
    [[nodiscard]] double phi(double g, double across) const noexcept;

  private:
    /// Sum over both sides of the lags, of `kernel` of C.
    template <class Kernel>
    [[nodiscard]] double integral(double across, const Kernel& kernel) const noexcept;

    RoughnessStatistics statistics_;
    Surface seen_;
    std::vector<double> correlation_;  // of a K-correlated profile, at even lags
};

/// Which roughness and which shadowing.
enum class ProfileModel {
    kirchhoff,    ///< sigma_0, S = 1
    he_torrance,  ///< sigma of [He91 (80)], S = S_1(theta_i) S_1(theta_r) [He91 (23)]
    smith,        ///< sigma_0, S = 1/(1 + Lambda(theta_i) + Lambda(theta_r)), heights correlated
};
inline constexpr std::array profile_models{ProfileModel::kirchhoff, ProfileModel::he_torrance,
                                           ProfileModel::smith};
[[nodiscard]] const char* name(ProfileModel model) noexcept;

/// Power scattered incoherently, per angle, of all that falls in [1/rad].
///   surface   in wavelengths      theta_i, theta_r   [rad], theta_r < 0 on the side of the source
[[nodiscard]] double profile_lobe(ProfileModel model, const ProfileHeights& surface, double theta_i,
                                  double theta_r);
/// Power mirrored coherently, exp(-g) S at theta_r = theta_i.
[[nodiscard]] double profile_mirror(ProfileModel model, const ProfileHeights& surface, double theta_i);

}  // namespace hts::validation
