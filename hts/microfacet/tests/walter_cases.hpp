/// Facets and directions on which the tests of Walter's models agree.
#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "comparison.hpp"
#include "hts/microfacet/walter.hpp"

namespace hts::testing::walter {

inline constexpr double pi = std::numbers::pi;
inline const RefractiveIndex perfect{1e12, 0};

inline FacetDistribution distribution(double shape, double width) {
    if (shape == 0) return FacetDistribution::beckmann(width);
    return shape == 1 ? FacetDistribution::phong(width) : FacetDistribution::ggx(width);
}

/// Polar angle from the front's normal, 0 ... pi.
inline double polar_angle(const SidedDirection& d) {
    const double theta = std::atan2(d.direction.sin_theta(), d.direction.cos_theta());
    return d.side == Side::front ? theta : pi - theta;
}

inline SidedDirection on_sphere(double polar, double phi) {
    const bool front = polar < pi / 2;
    return {front ? Side::front : Side::back, Direction::from_angles(front ? polar : pi - polar, phi)};
}

inline double azimuth(const Direction& d) {
    return std::atan2(d.sin_phi(), d.cos_phi());
}

inline FacetDistribution random_facets(Random& random) {
    const double alpha = random.logarithmic(0.02, 1);
    const double shape = random.one_of({0, 1, 2});
    return distribution(shape, shape == 1 ? 2 / (alpha * alpha) - 2 : alpha);
}

inline Direction off_grazing(Random& random) {
    return Direction::from_degrees(random.uniform(0, 89.5), random.uniform(0, 360));
}

inline std::string text(const FacetDistribution& facets, double theta) {
    std::ostringstream text;
    text << "shape " << static_cast<int>(facets.shape()) << ", alpha " << facets.alpha() << ", theta "
         << theta;
    return text.str();
}

}  // namespace hts::testing::walter
