#include "hts/shadowing.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace hts {
namespace {

/// Integrated complementary error function. Its absolute error is what counts here: where it cancels, it is
/// negligible beside c.
double ierfc(double c) {
    return std::exp(-c * c) * std::numbers::inv_sqrtpi - c * std::erfc(c);
}

Visibility of_a_mirror(double cos_theta) {
    return {0, 1, cos_theta > 0 ? 1 / cos_theta : 0};
}

}  // namespace

Visibility visibility(const Surface& surface, const Direction& direction) noexcept {
    const double cosine = direction.cos_theta();
    const double sine = direction.sin_theta();
    const double width_sine = surface.slope_width() * sine;
    if (width_sine == 0) return of_a_mirror(cosine);
    const double c = cosine / width_sine;
    const double complement = std::erfc(c);
    const double obstruction =
        cosine > 0 ? sine / cosine * complement : std::numeric_limits<double>::infinity();
    // Beyond c = 27 exp(-c^2) is 0; leave before c^2 or c erfc(c) meets infinity.
    const double overhang = c < 27 ? width_sine * ierfc(c) / 2 : 0;
    const double quotient = (2 - complement) / 2 / (cosine + overhang);
    return {obstruction, cosine * quotient, quotient};
}

}  // namespace hts
