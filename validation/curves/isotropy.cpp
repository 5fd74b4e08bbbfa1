#include "validation/curves/isotropy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace hts::validation {
namespace {

constexpr double half_turn = std::numbers::pi;

/// Tilt of the mirroring facet and BRDF times cos theta_r, on one side of the mirror
/// direction, by rising tilt.
using Side = std::vector<std::pair<double, double>>;

double at_tilt(const Side& side, double tilt) {
    const auto above = std::ranges::lower_bound(side, tilt, {}, &std::pair<double, double>::first);
    if (above == side.end()) return 0;
    if (above == side.begin()) return above->first - tilt < 1e-9 || side.size() > 1 ? above->second : 0;
    const auto below = above - 1;
    const double share = (tilt - below->first) / (above->first - below->first);
    return below->second + share * (above->second - below->second);
}

/// BRDF times cos theta_r, of which facets show in any direction what they show in the plane.
double outgoing(const CurvePoint& point, Quantity quantity) {
    if (quantity == Quantity::brdf_cosine) return point.value;
    const double brdf = quantity == Quantity::reflectance_factor ? point.value / half_turn : point.value;
    return brdf * std::cos(point.theta_r * half_turn / 180);
}

}  // namespace

std::optional<double> isotropic_reflectance(const Curve& curve, Quantity quantity) {
    constexpr double steepest = 60;
    const double fixed = curve.fixed_angle();
    if (curve.sweep == Sweep::scattered || fixed > steepest) return std::nullopt;
    Side sides[2];
    for (const CurvePoint& point : curve.points) {
        const double signed_tilt = (curve.swept_angle(point) - fixed) / 2 * half_turn / 180;
        if (signed_tilt <= 0) sides[0].emplace_back(-signed_tilt, outgoing(point, quantity));
        if (signed_tilt >= 0) sides[1].emplace_back(signed_tilt, outgoing(point, quantity));
    }
    for (Side& side : sides) std::ranges::sort(side);
    if (sides[0].size() + sides[1].size() < 4) return std::nullopt;

    // over tilts t and azimuths p of facets: dw_r = 4 cos d sin t dt dp, d the angle
    // of the light on the facet
    constexpr int tilts = 4000, azimuths = 64;
    const double theta = fixed * half_turn / 180;
    double sum = 0;
    for (int i = 0; i < tilts; ++i) {
        const double part = (i + 0.5) / tilts, tilt = half_turn / 2 * part * part;
        const double width = half_turn / 2 * 2 * part / tilts;
        const double left = at_tilt(sides[0], tilt), right = at_tilt(sides[1], tilt);
        const double value = sides[0].empty() ? right : sides[1].empty() ? left : (left + right) / 2;
        if (value == 0) continue;
        for (int j = 0; j < azimuths; ++j) {
            const double turn = 2 * half_turn * (j + 0.5) / azimuths;
            const double cos_facet =
                std::cos(theta) * std::cos(tilt) + std::sin(theta) * std::sin(tilt) * std::cos(turn);
            const double cos_out = 2 * cos_facet * std::cos(tilt) - std::cos(theta);
            if (cos_facet <= 0 || cos_out <= 0) continue;
            sum += value * 4 * cos_facet * std::sin(tilt) * width * 2 * half_turn / azimuths;
        }
    }
    return sum;
}

std::optional<IsotropicReflectance> brightest_if_isotropic(const CurveSet& set) {
    std::optional<IsotropicReflectance> result;
    if (set.scale != Scale::absolute || set.quantity == Quantity::hemispherical_reflectance) return result;
    for (const Curve& curve : set.curves) {
        const auto reflectance = isotropic_reflectance(curve, set.quantity);
        if (reflectance && (!result || *reflectance > result->reflectance))
            result = IsotropicReflectance{curve.fixed_angle(), *reflectance};
    }
    return result;
}

}  // namespace hts::validation
