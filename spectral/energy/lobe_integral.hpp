/// Integrals over the directional-diffuse lobe of one incident direction. Private to the library.
///
/// With f cos(theta_r) domega = f dx dy the hemisphere is the unit disc of direction cosines. There the lobe
/// has circular contours about the mirror direction, of a radius that may be 1e-6 or 1e6 and of tails that
/// reach much further. So the disc is described by polar coordinates about the mirror direction,
///   distance   w sinh(u), w the lobe's own width: every scale from the core to the
///              horizon has its share of u
///   horizon    u = U y (2 - y), so that cos(theta_r) ~ 1 - y and the square root at the edge is smooth in y
///   angle      pi/2 +- cos(theta_i) sinh(x): at grazing incidence the way to the horizon changes from
///              cos^2(theta_i) outwards to 2 inwards within an angle of cos(theta_i)
/// in which the integrand is smooth over x, y in panels of order one, wherever the light
/// and whatever the surface.
#pragma once

#include <functional>

#include "hts/tolerance.hpp"
#include "spectral/energy/rough_surface.hpp"

namespace hts::spectral {

/// A factor beside the lobe: smooth, positive, at most of order one.
using LobeWeight = std::function<double(const Direction& out)>;

/// Integral of lobe(in, out) weight(out) cos(theta_r) over the hemisphere by adaptive
/// Gauss-Kronrod quadrature.
///   lobe    of the light from `in`
///   error   relative, at most the tolerance
///   cost    some 4000 to 100 000 lobe values, the more the nearer to the horizon
[[nodiscard]] double lobe_integral(const Surface& surface, const Direction& in, const Wavelength& wavelength,
                                   const ReflectedLight::Lobe& lobe, const LobeWeight& weight,
                                   Tolerance tolerance);

/// Calls visit(out, share) for every node of a fixed rule over the same coordinates: the sum of share
/// weight(out) is the integral above.
///   error   relative, 1e-4 for weights that are smooth in log(cos theta_r)
///   nodes   1536, 0 where there is no lobe
void visit_lobe(const Surface& surface, const Direction& in, const Wavelength& wavelength,
                const ReflectedLight::Lobe& lobe,
                const std::function<void(const Direction& out, double share)>& visit);

}  // namespace hts::spectral
