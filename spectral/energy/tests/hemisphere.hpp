/// The slow and plain way to integrate over the hemisphere, for comparison.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

#include "hts/direction.hpp"

namespace hts::spectral::testing {

/// Ends of panels over from ... to that halve again and again towards a place, until they are `finest` wide.
inline std::vector<double> panels_towards(double place, double from, double to, double finest) {
    std::vector<double> ends{from, place, to};
    for (double step = finest; step < to - from; step *= 2) {
        if (place - step > from) ends.push_back(place - step);
        if (place + step < to) ends.push_back(place + step);
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

/// Ends of panels over from ... to of equal width, at most `widest`.
inline std::vector<double> equal_panels(double from, double to, double widest) {
    const int count = static_cast<int>(std::ceil((to - from) / widest));
    std::vector<double> ends;
    for (int i = 0; i <= count; ++i) ends.push_back(from + (to - from) * i / count);
    return ends;
}

/// Gauss's rule with 20 points on each panel.
template <class Function>
double panel_sum(const std::vector<double>& ends, Function&& f) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (ends[i + 1] > ends[i])
            sum += boost::math::quadrature::gauss<double, 20>::integrate(f, ends[i], ends[i + 1]);
    }
    return sum;
}

/// Integral of f(direction) cos theta over the hemisphere in polar angle and azimuth, with panels that refine
/// towards the mirror direction of `light` (azimuth 0) and half as far towards the horizon.
/// f is even in the azimuth.
///   width   [rad]  of the finest panels
template <class Function>
double hemisphere_integral(double theta_of_light, double width, Function&& f) {
    constexpr double horizon = std::numbers::pi / 2;
    std::vector<double> rings = panels_towards(theta_of_light, 0, horizon, width);
    for (const double end : panels_towards(horizon, theta_of_light, horizon, 1e-4)) rings.push_back(end);
    std::sort(rings.begin(), rings.end());
    const std::vector<double> sectors = panels_towards(std::numbers::pi, 0, std::numbers::pi, width);
    return 2 * panel_sum(rings, [&](double theta) {
               const double ring =
                   panel_sum(sectors, [&](double phi) { return f(Direction::from_angles(theta, phi)); });
               return ring * std::sin(theta) * std::cos(theta);
           });
}

}  // namespace hts::spectral::testing
