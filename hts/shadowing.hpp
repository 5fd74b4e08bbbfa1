/// How much of a rough surface one direction sees: Smith's shadowing of [He91 (23)-(25)] and the paper's K.
///
/// Everything depends on c = tau cot(theta) / (2 sigma_0) alone. As printed, (25) lacks the factor exp(-c^2)
/// of Smith's Lambda; it stands here, and S_1 is the average over all normals, (1 - erfc(c)/2)/(1 + Lambda),
/// not the 1/(1 + Lambda) of a known normal that microfacet models use.
#pragma once

#include "hts/direction.hpp"
#include "hts/surface.hpp"

namespace hts {

namespace accuracy {
inline constexpr double shadowing = 1.5e-15;  ///< of S_1 and S_1 / cos theta, relative
inline constexpr double obstruction = 3e-15;  ///< of K, relative to max(K, 1)
}  // namespace accuracy

/// What the view along one direction contributes; independent of wavelength.
struct Visibility {
    double obstruction;  ///< K = tan theta erfc(c) [He91 (82)]: 0 at the normal, infinite at the horizon
    double shadowing;    ///< S_1, 1 at the normal, 0 at the horizon unless the surface is a mirror
    double shadowing_over_cosine;  ///< S_1 / cos theta [1], finite at the horizon: sqrt(pi) tau / (2 sigma_0)
};

/// Visibility along a direction.
///   formula   S_1/cos theta = (1 + erf c)/2 / (cos theta + (sigma_0/tau) sin theta ierfc(c)),
///             ierfc(c) = exp(-c^2)/sqrt(pi) - c erfc(c): the quotient of (24) without its 0/0 at the horizon
///   limits    sigma_0 = 0: K = 0, S_1 = 1. At the horizon of a mirror 1/cos theta has no finite value; the
///             member is then 0, since no light falls on a surface edge on
///   error     accuracy::shadowing, accuracy::obstruction
[[nodiscard]] Visibility visibility(const Surface& surface, const Direction& direction) noexcept;

}  // namespace hts
