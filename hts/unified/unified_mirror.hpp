/// The specular term of he_unified: what roughness leaves of the mirror, for s and for p.
///
///   rho_q = |F_q(theta)|^2 exp(-x_q)
///   x_s = 4 (k sigma_0)^2 c (c^4 + a^4)^(1/4),   a^4 = 0.229 s^2/(k tau)^2
///   x_p = 4 (k sigma_0)^2 c [(c^4 + a^4)^(1/4) + 0.65 (k tau)^(-3/2) s^4/|c + 1/N|^2],   1/N the impedance
///   at the normal where films are
///
/// Of an anisotropic surface a has tau along the azimuth of the light, and the last term sqrt(tau_x tau_y).
/// Closed approximations of second-order perturbation theory: x is g at the normal and on gentle slopes, and
/// goes with c to 0 at the horizon, where a rough surface becomes a mirror; only a perfect conductor's p dies
/// there, with x ~ 1/c. Beside second order, for tau >= lambda: x_s is within accuracy::closed_exponent_s;
/// x_p is within accuracy::closed_exponent_p on metals up to 75 degrees and on dielectrics up to 45. Beyond,
/// x_p is off by up to 60 % on silver, gold, copper and aluminium, and by factors, in places in sign, on
/// metals of small |N| and on dielectrics; "mirror": "second_order" serves there.
#pragma once

#include "hts/unified/unified_terms.hpp"

namespace hts {

namespace accuracy {
inline constexpr double unified_mirror = 6e-13;  ///< of F_q exp(-x_q/2), relative
/// Of the reflectance in lanes, above 1e-280; the worst where an index near 1 reflects totally.
inline constexpr double unified_mirror_in_lanes = 2e-10;
/// Of x_s and of x_p beside second order, relative, where said above.
inline constexpr double closed_exponent_s = 0.26, closed_exponent_p = 0.16;
}  // namespace accuracy

inline constexpr double unified_mirror_slant = 0.229;   ///< in a of x_s and x_p
inline constexpr double unified_mirror_grazing = 0.65;  ///< in x_p

/// F_q exp(-x_q/2).
///   error   accuracy::unified_mirror, above 1e-280
[[nodiscard]] FresnelAmplitudes unified_mirror(const Direction& in, const UnifiedWave& wave) noexcept;

}  // namespace hts
