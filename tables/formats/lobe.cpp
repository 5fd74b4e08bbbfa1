#include "tables/formats/lobe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hts::tables {
namespace {

constexpr double least_slope = 1e-5;
constexpr int slopes = 240;

/// From least_slope to almost 1 in equal ratios.
double nth_slope(int i) {
    return least_slope * std::pow(0.99 / least_slope, static_cast<double>(i) / (slopes - 1));
}

/// One wavelength's fall along a radius: `values` at the mirror direction first, then at every nth_slope.
double half_width(const std::vector<double>& values) {
    const double least = *std::min_element(values.begin(), values.end());
    const double half = (values.front() + least) / 2;
    if (!(values.front() > 1.01 * least)) return 1;
    for (int i = 0; i < slopes; ++i)
        if (values[static_cast<std::size_t>(i) + 1] <= half) return nth_slope(i);
    return 1;
}

double lobe_slope_along(const spectral::Reflectance& brdf, double azimuth) {
    const std::size_t count = brdf.wavelengths().size();
    const Direction in = Direction::from_angles(0, azimuth);
    std::vector<std::vector<double>> falls(count);
    std::vector<double> values(count);
    for (int i = -1; i < slopes; ++i) {
        const double theta = i < 0 ? 0 : 2 * std::atan(nth_slope(i));
        brdf.brdf({in, Direction::from_angles(theta, azimuth)}, values);
        for (std::size_t k = 0; k < count; ++k) falls[k].push_back(values[k]);
    }
    double slope = 1;
    for (const auto& fall : falls) slope = std::min(slope, half_width(fall));
    return slope;
}

/// The plane of incidence's point at a polar angle, which is negative on the light's side.
Direction in_plane(const Direction& in, double theta) {
    const double side = theta < 0 ? 1 : -1;
    const double sine = std::sin(std::abs(theta));
    return Direction::from_unit_vector(
        {side * sine * in.cos_phi(), side * sine * in.sin_phi(), std::cos(theta)});
}

}  // namespace

double lobe_slope(const spectral::Reflectance& brdf) {
    return std::min(lobe_slope_along(brdf, 0), lobe_slope_along(brdf, std::numbers::pi / 2));
}

Vector3 facet_normal(double slope_x, double slope_y) noexcept {
    return (1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y)) * Vector3{slope_x, slope_y, 1};
}

Vector3 mirrored(const Direction& in, Vector3 m) noexcept {
    const Vector3 w = in.vector();
    return 2 * dot(w, m) * m - w;
}

Vector3 bisector(const DirectionPair& pair) noexcept {
    const Vector3 sum = pair.in.vector() + pair.out.vector();
    const double length = std::sqrt(dot(sum, sum));
    return length > 0 ? (1 / length) * sum : Vector3{0, 0, 1};
}

std::vector<Direction> views_of_the_plane_of_incidence(const Direction& in, double slope,
                                                       double largest_theta) {
    constexpr double step = 3 * std::numbers::pi / 180;
    constexpr int fine = 24;  // a quarter of the slope apart, six slopes to either side
    const double mirror = std::atan2(in.sin_theta(), in.cos_theta());
    std::vector<double> angles;
    for (double theta = 0; theta <= largest_theta; theta += step)
        angles.insert(angles.end(), {theta, -theta});
    for (int i = -fine; i <= fine; ++i) angles.push_back(mirror + 2 * std::atan(0.25 * i * slope));
    std::vector<Direction> views;
    for (const double theta : angles)
        if (std::abs(theta) <= largest_theta) views.push_back(in_plane(in, theta));
    return views;
}

std::vector<double> lobe_peaks(const spectral::Reflectance& brdf, const Direction& in, double slope,
                               double largest_theta) {
    std::vector<double> peaks(brdf.wavelengths().size()), values(peaks.size());
    for (const Direction& out : views_of_the_plane_of_incidence(in, slope, largest_theta)) {
        brdf.brdf({in, out}, values);
        for (std::size_t k = 0; k < peaks.size(); ++k) peaks[k] = std::max(peaks[k], values[k]);
    }
    return peaks;
}

}  // namespace hts::tables
