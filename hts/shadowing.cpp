#include "hts/shadowing.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace hts {
namespace {

/// What Smith's functions are made of.
struct Slant {
    double c;           // tau cot(theta) / (2 sigma_0)
    double complement;  // erfc(c)
    double gaussian;    // exp(-c^2)/sqrt(pi)
    double ierfc;       // its absolute error is what counts: where it cancels, it is negligible beside c
};

/// Beyond c = 27 all but c is 0; c^2 and c erfc(c) would meet infinity.
Slant slant(double c) {
    if (!(c < 27)) return {c, std::erfc(c), 0, 0};
    const double complement = std::erfc(c);
    const double gaussian = std::exp(-c * c) * std::numbers::inv_sqrtpi;
    return {c, complement, gaussian, gaussian - c * complement};
}

Visibility of_a_mirror(double cos_theta) {
    return {0, 1, cos_theta > 0 ? 1 / cos_theta : 0, 0};
}

Visibility visibility(const Direction& direction, double width_sine, const Slant& s) {
    const double cosine = direction.cos_theta();
    const double obstruction =
        cosine > 0 ? direction.sin_theta() / cosine * s.complement : std::numeric_limits<double>::infinity();
    const double masked = width_sine * s.ierfc / 2;
    const double quotient = (2 - s.complement) / 2 / (cosine + masked);
    return {obstruction, cosine * quotient, quotient, masked};
}

VisibilityGradient unhindered(const Direction& direction, const Visibility& value) {
    const double cosine = direction.cos_theta();
    return {value, 0, 0, 0, 0, cosine > 0 ? direction.sin_theta() / cosine : 0};
}

}  // namespace

Visibility visibility(const Surface& surface, const Direction& direction) noexcept {
    const double width_sine = surface.slope_width(direction) * direction.sin_theta();
    if (width_sine == 0) return of_a_mirror(direction.cos_theta());
    return visibility(direction, width_sine, slant(direction.cos_theta() / width_sine));
}

VisibilityGradient visibility_gradient(const Surface& surface, const Direction& direction) noexcept {
    const double cosine = direction.cos_theta();
    const double sine = direction.sin_theta();
    const double width_sine = surface.slope_width(direction) * sine;
    if (width_sine == 0) return unhindered(direction, of_a_mirror(cosine));
    const Slant s = slant(cosine / width_sine);
    const Visibility value = visibility(direction, width_sine, s);
    if (s.gaussian == 0 || s.complement == 0) return unhindered(direction, value);
    const double lit = (2 - s.complement) / 2;
    const double extent = cosine + width_sine * s.ierfc / 2;
    const double turned = s.gaussian / (width_sine * sine * lit);  // -d ln(lit)/d theta
    const double steepness = 2 * s.c * s.gaussian / s.complement;
    const double half_width = surface.slope_width(direction) / 2;
    return {value,
            (1 + steepness) / (sine * cosine),
            steepness,
            -(turned + half_width * s.gaussian / (cosine * extent)),
            -s.gaussian * (s.c / lit + half_width * sine / extent),
            (sine - half_width * cosine * s.ierfc - s.complement / (2 * sine)) / extent - turned};
}

}  // namespace hts
