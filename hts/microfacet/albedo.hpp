/// How much of the light from one direction a model reflects in all, its
/// directional-hemispherical reflectance:
///
///   albedo(in) = integral over the hemisphere of f(in, out) cos theta_out domega
///
/// The integral runs over the normals h of the facets that mirror `in` into `out`, domega_out = 4 (in.h)
/// domega_h, in polar angle and azimuth of h. With tan delta = tan theta_in cos(phi_h - phi_in) the direction
/// `out` is above the horizon for theta_h < pi/4 + delta/2, a closed form, so the integrand has no edge
/// inside. Panels shrink in proportion to their distance from h = n, the mirror direction, so that a lobe
/// about it is seen whatever its width down to 1e-8 rad, and are cut at in = out and where theta_out =
/// theta_in; the panel with the largest error is halved until the sum is good.
#pragma once

#include <functional>

#include "hts/microfacet/model.hpp"
#include "hts/tolerance.hpp"

namespace hts {

namespace accuracy {
/// Of `directional_albedo`, relative, for BRDFs that are smooth but for lobes about the mirror direction,
/// lobes elsewhere at least 2 degrees wide, kinks in the slope along lines, and growth like 1/cos theta_out
/// at most towards the horizon.
inline constexpr double directional_albedo = 1e-7;
}  // namespace accuracy

/// A BRDF for one incident direction, whatever the type of the model [1/sr].
using OutgoingBrdf = std::function<double(const Direction& out)>;

/// Albedo of a BRDF [1].
///   range   >= 0; at most 1 if the model conserves energy, which many do not; 0 for `in` on the horizon
///   error   the tolerance, relative, or accuracy::directional_albedo if that is more
///   cost    1e4 evaluations, at the finest tolerance up to 2e6 near the horizon, and 4e7 of a BRDF whose
///           slope has kinks all over, as interpolation in a table leaves
[[nodiscard]] double directional_albedo(const OutgoingBrdf& brdf, const Direction& in,
                                        Tolerance tolerance = Tolerance{accuracy::directional_albedo});

/// Albedo of a model [1].
template <ReflectanceModel Model>
[[nodiscard]] double directional_albedo(const Model& model, const Direction& in,
                                        Tolerance tolerance = Tolerance{accuracy::directional_albedo}) {
    return directional_albedo([&](const Direction& out) { return model.brdf(in, out); }, in, tolerance);
}

}  // namespace hts
