/// How much of a rough surface one direction sees: Smith's shadowing of [He91 (23)-(25)] and the paper's K.
///
/// Everything depends on c = tau cot(theta) / (2 sigma_0) alone, tau along the direction's own azimuth. As
/// printed, (25) lacks the factor exp(-c^2) of Smith's Lambda; it stands here, and S_1 is the average over
/// all normals, (1 - erfc(c)/2)/(1 + Lambda), not the 1/(1 + Lambda) of a known normal
/// that microfacet models use.
#pragma once

#include "hts/direction.hpp"
#include "hts/surface.hpp"

namespace hts {

namespace accuracy {
inline constexpr double shadowing = 1.5e-15;  ///< of S_1 and S_1 / cos theta, relative
inline constexpr double obstruction = 3e-15;  ///< of K, relative to max(K, 1)
inline constexpr double masked = 1e-15;       ///< of cos theta Lambda, relative to cos theta plus itself
inline constexpr double obstruction_gradient = 1e-13;  ///< of derivatives of ln K, relative, where K > 1e-290
inline constexpr double shadowing_gradient = 5e-15;    ///< of those of ln S_1, beside 1 plus the derivative
}  // namespace accuracy

/// What the view along one direction contributes; independent of wavelength.
struct Visibility {
    double obstruction;  ///< K = tan theta erfc(c) [He91 (82)]: 0 at the normal, infinite at the horizon
    double shadowing;    ///< S_1, 1 at the normal, 0 at the horizon unless the surface is a mirror
    double shadowing_over_cosine;  ///< S_1 / cos theta [1], finite at the horizon: sqrt(pi) tau / (2 sigma_0)
    double masked;  ///< cos theta Lambda [1], (sigma_0/tau) sin theta ierfc(c): finite at the horizon
};

/// Visibility along a direction.
///   formula   S_1/cos theta = (1 + erf c)/2 / (cos theta + (sigma_0/tau) sin theta ierfc(c)),
///             ierfc(c) = exp(-c^2)/sqrt(pi) - c erfc(c): the quotient of (24) without its 0/0 at the horizon
///   limits    sigma_0 = 0: K = 0, S_1 = 1. At the horizon of a mirror 1/cos theta has no finite value; the
///             member is then 0, since no light falls on a surface edge on
///   error     accuracy::shadowing, accuracy::obstruction
[[nodiscard]] Visibility visibility(const Surface& surface, const Direction& direction) noexcept;

/// A visibility with its logarithmic derivatives, by theta [1/rad] and by ln(sigma_0/tau) [1].
struct VisibilityGradient {
    Visibility value;
    double log_obstruction_by_theta;  ///< of ln K; both are 0 where K is 0
    double log_obstruction_by_log_slope;
    double log_shadowing_by_theta;      ///< of ln S_1
    double log_shadowing_by_log_slope;  ///< of ln S_1 and of ln(S_1/cos theta)
    double log_quotient_by_theta;       ///< of ln(S_1/cos theta)
};

/// Visibility along a direction, and how it changes.
///   formula   with e = exp(-c^2)/sqrt(pi), h = 2 c e/erfc(c), N = 1 - erfc(c)/2, D = cos theta / (S_1/N):
///             ln K by slope: h, by theta: (1 + h)/(sin theta cos theta);
///             ln S_1 by slope: -e (c/N + (sigma_0/tau) sin theta/D),
///             by theta: -e (tau/(2 sigma_0 sin^2 theta N) + (sigma_0/tau)/(cos theta D))
///   limits    at the horizon ln K and ln S_1 fall and grow without bound: infinite; a mirror's are 0
///   error     accuracy::obstruction_gradient, accuracy::shadowing_gradient
[[nodiscard]] VisibilityGradient visibility_gradient(const Surface& surface,
                                                     const Direction& direction) noexcept;

}  // namespace hts
