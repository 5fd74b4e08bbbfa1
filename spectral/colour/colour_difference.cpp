#include "spectral/colour/colour_difference.hpp"

#include <cmath>
#include <numbers>

namespace hts::spectral {
namespace {

constexpr double pi = std::numbers::pi;

constexpr double radians(double degrees) {
    return degrees * pi / 180;
}

/// sqrt(C^7 / (C^7 + 25^7)), which separates near-neutral from saturated colours.
double saturation(double chroma) {
    const double seventh = std::pow(chroma / 25, 7);
    return std::sqrt(seventh / (seventh + 1));
}

/// Lightness, chroma and hue [rad, 0 ... 2 pi) of a colour with a* stretched.
struct Lch {
    double L, C, h;
};

Lch stretched(const Lab& colour, double factor) {  // [Sharma05 (5) to (7)]
    const double a = factor * colour.a;
    const double h = a == 0 && colour.b == 0 ? 0 : std::atan2(colour.b, a);
    return {colour.L, std::hypot(a, colour.b), h < 0 ? h + 2 * pi : h};
}

/// 1 + G [Sharma05 (3), (4)], by which a* is stretched.
double stretch(const Lab& a, const Lab& b) {
    const double mean_chroma = (std::hypot(a.a, a.b) + std::hypot(b.a, b.b)) / 2;
    return 1 + (1 - saturation(mean_chroma)) / 2;
}

/// Hue of the second colour minus that of the first, and the hue in between.
struct Hues {
    double difference, mean;
};

Hues hues(const Lch& first, const Lch& second) {  // [Sharma05 (10), (14)]
    if (first.C * second.C == 0) return {0, first.h + second.h};
    constexpr double rounding = 1e-12;  // opposite hues, which rounding puts on either side of pi
    const double difference = second.h - first.h, sum = first.h + second.h;
    if (std::abs(difference) <= pi + rounding) return {difference, sum / 2};
    const double shorter = difference > 0 ? difference - 2 * pi : difference + 2 * pi;
    return {shorter, sum < 2 * pi ? sum / 2 + pi : sum / 2 - pi};
}

/// S_L [Sharma05 (18)].
double lightness_weight(double L) {
    const double from_grey = (L - 50) * (L - 50);
    return 1 + 0.015 * from_grey / std::sqrt(20 + from_grey);
}

/// T [Sharma05 (15)].
double hue_weight(double h) {
    return 1 - 0.17 * std::cos(h - radians(30)) + 0.24 * std::cos(2 * h) +
           0.32 * std::cos(3 * h + radians(6)) - 0.20 * std::cos(4 * h - radians(63));
}

/// R_T [Sharma05 (16), (17), (21)].
double blue_rotation(double chroma, double h) {
    const double turn = radians(30) * std::exp(-std::pow((h - radians(275)) / radians(25), 2));
    return -std::sin(2 * turn) * 2 * saturation(chroma);
}

/// f of CIELAB.
double lab_root(double ratio) {
    constexpr double joint = 24. / 116;
    if (ratio > joint * joint * joint) return std::cbrt(ratio);
    return 841. / 108 * ratio + 16. / 116;
}

}  // namespace

Lab cielab(const Xyz& colour, const Xyz& white) noexcept {
    const double x = lab_root(colour.X / white.X), y = lab_root(colour.Y / white.Y),
                 z = lab_root(colour.Z / white.Z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double colour_difference(const Lab& a, const Lab& b) noexcept {
    const double factor = stretch(a, b);
    const Lch first = stretched(a, factor), second = stretched(b, factor);
    const Hues hue = hues(first, second);
    const double L = (first.L + second.L) / 2, C = (first.C + second.C) / 2;
    const double lightness = (second.L - first.L) / lightness_weight(L);
    const double chroma = (second.C - first.C) / (1 + 0.045 * C);
    const double across = 2 * std::sqrt(first.C * second.C) * std::sin(hue.difference / 2) /
                          (1 + 0.015 * C * hue_weight(hue.mean));
    return std::sqrt(lightness * lightness + chroma * chroma + across * across +
                     blue_rotation(C, hue.mean) * chroma * across);
}

}  // namespace hts::spectral
