/// What the colour tests share: both illuminants, the distance of two colours, and a bound that is printed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "spectral/colour/display_colour.hpp"

namespace hts::testing {

inline constexpr std::array both{spectral::Illuminant::E, spectral::Illuminant::D65};

/// Largest difference of a component.
inline double worst_of(const spectral::Xyz& a, const spectral::Xyz& b) {
    return std::max({std::abs(a.X - b.X), std::abs(a.Y - b.Y), std::abs(a.Z - b.Z)});
}
inline double worst_of(const spectral::LinearRgb& a, const spectral::LinearRgb& b) {
    return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

/// Prints the worst case also when it passes.
inline void check_at_most(const std::string& what, double worst, double bound) {
    std::cout << what << ": worst " << worst << ", bound " << bound << '\n';
    INFO(what);
    CHECK(worst <= bound);
}

/// `count` wavelengths at equal distances.
inline std::vector<double> grid(double first, double last, int count) {
    std::vector<double> result;
    result.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) result.push_back(first + (last - first) * i / (count - 1));
    return result;
}

template <class Function>
std::vector<double> sampled(const std::vector<double>& wavelengths, Function function) {
    std::vector<double> result;
    result.reserve(wavelengths.size());
    for (const double um : wavelengths) result.push_back(function(um));
    return result;
}

/// XYZ of a narrow band of reflectance.
inline spectral::Xyz band(int nanometres, spectral::Illuminant illuminant) {
    const std::vector<double> wavelengths = grid(0.36, 0.83, 471);
    const auto reflectance = sampled(
        wavelengths, [&](double um) { return std::exp(-std::pow((1000 * um - nanometres) / 15, 2)); });
    return spectral::tristimulus(wavelengths, reflectance, illuminant);
}

}  // namespace hts::testing
