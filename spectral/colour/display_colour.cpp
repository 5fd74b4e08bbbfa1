#include "spectral/colour/display_colour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace hts::spectral {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

// ---- matrices

constexpr Triple operator*(const Matrix& m, const Triple& v) {
    const auto row = [&](std::size_t i) { return m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2]; };
    return {row(0), row(1), row(2)};
}

constexpr Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
    return result;
}

/// The matrix with its columns multiplied by three factors.
constexpr Matrix scaled_columns(const Matrix& m, const Triple& factors) {
    Matrix result = m;
    for (Triple& row : result) {
        for (std::size_t j = 0; j < 3; ++j) row[j] *= factors[j];
    }
    return result;
}

constexpr Matrix inverse(const Matrix& m) {
    const auto cofactor = [&](std::size_t i, std::size_t j) {
        const std::size_t r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[r][c] * m[s][d] - m[r][d] * m[s][c];
    };
    const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) result[i][j] = cofactor(j, i) / determinant;
    }
    return result;
}

constexpr Triple triple(const Xyz& v) {
    return {v.X, v.Y, v.Z};
}
constexpr Xyz xyz(const Triple& v) {
    return {v[0], v[1], v[2]};
}

// ---- chromatic adaptation and sRGB

/// XYZ with Y = 1.
constexpr Triple at_unit_luminance(const Chromaticity& c) {
    return {c.x / c.y, 1, (1 - c.x - c.y) / c.y};
}

constexpr Triple srgb_white = at_unit_luminance({0.3127, 0.3290});

constexpr Matrix bradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Matrix adaptation(const Triple& from_white, const Triple& to_white) {
    const Triple from = bradford * from_white, to = bradford * to_white;
    return scaled_columns(inverse(bradford), {to[0] / from[0], to[1] / from[1], to[2] / from[2]}) * bradford;
}

/// Columns are XYZ of the three primaries at full drive, which add up to the white.
Matrix xyz_of_srgb() {
    const Triple red = at_unit_luminance({0.64, 0.33}), green = at_unit_luminance({0.30, 0.60}),
                 blue = at_unit_luminance({0.15, 0.06});
    const Matrix primaries{
        {{red[0], green[0], blue[0]}, {red[1], green[1], blue[1]}, {red[2], green[2], blue[2]}}};
    return scaled_columns(primaries, inverse(primaries) * srgb_white);
}

/// XYZ under the illuminant to linear sRGB, both steps in one.
const Matrix& srgb_of_xyz(Illuminant illuminant) {
    const auto matrix = [](Illuminant from) {
        return inverse(xyz_of_srgb()) * adaptation(triple(white_point(from)), srgb_white);
    };
    static const Matrix e = matrix(Illuminant::E), d65 = matrix(Illuminant::D65);
    return illuminant == Illuminant::D65 ? d65 : e;
}

/// 1.055 v^(1/2.4) - 0.055, written so that 1 stays exactly 1.
double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1 + 1.055 * (std::pow(linear, 1 / 2.4) - 1);
}

double decoded(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// NaN becomes 0.
double clipped(double linear) {
    return linear > 0 ? std::min(linear, 1.) : 0;
}

bool displayable(double linear) {
    constexpr double rounding = 1e-9;
    return linear >= -rounding && linear <= 1 + rounding;
}

}  // namespace

Xyz bradford_adaptation(const Xyz& colour, const Xyz& from_white, const Xyz& to_white) noexcept {
    return xyz(adaptation(triple(from_white), triple(to_white)) * triple(colour));
}

LinearRgb linear_srgb(const Xyz& colour, Illuminant illuminant) noexcept {
    const Triple rgb = srgb_of_xyz(illuminant) * triple(colour);
    return {rgb[0], rgb[1], rgb[2]};
}

Xyz tristimulus(const LinearRgb& rgb, Illuminant illuminant) noexcept {
    return xyz(inverse(srgb_of_xyz(illuminant)) * Triple{rgb.red, rgb.green, rgb.blue});
}

DisplayRgb DisplayRgb::from_linear(const LinearRgb& rgb) noexcept {
    return {encoded(clipped(rgb.red)), encoded(clipped(rgb.green)), encoded(clipped(rgb.blue)),
            displayable(rgb.red) && displayable(rgb.green) && displayable(rgb.blue)};
}

LinearRgb DisplayRgb::linear() const noexcept {
    return {decoded(red_), decoded(green_), decoded(blue_)};
}

std::array<std::uint8_t, 3> DisplayRgb::eight_bit() const noexcept {
    const auto rounded = [](double value) { return static_cast<std::uint8_t>(std::lround(255 * value)); };
    return {rounded(red_), rounded(green_), rounded(blue_)};
}

std::string DisplayRgb::hex() const {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const unsigned byte : eight_bit()) {
        text += digits[byte / 16];
        text += digits[byte % 16];
    }
    return text;
}

}  // namespace hts::spectral
