#include "hts/direction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "hts/angles/degrees_simd.hpp"
#include "hts/angles/half_turns.hpp"
#include "hts/error.hpp"

namespace hts {
namespace {

void require_finite_azimuth(double phi, const char* unit) {
    if (!std::isfinite(phi)) throw out_of_range("azimuth", phi, unit, "finite");
}

double square(double x) {
    return x * x;
}

/// sin(theta_r) - sin(theta_i), from whichever of sine and cosine is the better conditioned.
double sine_difference(const Direction& in, const Direction& out) {
    const double sines = in.sin_theta() + out.sin_theta();
    if (sines < 1) return out.sin_theta() - in.sin_theta();
    return (in.cos_theta() - out.cos_theta()) * (in.cos_theta() + out.cos_theta()) / sines;
}

}  // namespace

Direction Direction::from_angles(double theta, double phi) {
    if (!(theta >= 0 && theta <= std::numbers::pi / 2)) {
        throw out_of_range("polar angle", theta, "rad", "from 0 to pi/2 rad");
    }
    require_finite_azimuth(phi, "rad");
    return {std::cos(theta), std::sin(theta), std::cos(phi), std::sin(phi)};
}

Direction Direction::from_degrees(double theta, double phi) {
    if (!(theta >= 0 && theta <= 90)) throw out_of_range("polar angle", theta, "deg", "from 0 to 90 deg");
    require_finite_azimuth(phi, "deg");
    const SineCosine azimuth = half_turns((std::fabs(phi) <= 180 ? phi : std::remainder(phi, 360.0)) / 180);
    if (theta < 45) {
        const SineCosine polar = half_turns(theta / 180);
        return {polar.cosine, polar.sine, azimuth.cosine, azimuth.sine};
    }
    // Near the horizon the cosine is the sine of the elevation, whose subtraction is exact.
    return {sin_half_turns((90 - theta) / 180), sin_half_turns(theta / 180), azimuth.cosine, azimuth.sine};
}

void Direction::from_degrees(std::span<const double> theta, std::span<const double> phi,
                             std::span<Direction> result) {
    if (theta.size() != result.size() || phi.size() != result.size()) {
        throw Error{"Direction::from_degrees: " + std::to_string(theta.size()) + " polar angles and " +
                    std::to_string(phi.size()) + " azimuths for " + std::to_string(result.size()) +
                    " directions: must be as many"};
    }
    using angles_detail::DirectionColumns;
    const angles_detail::OctantTable& octant = angles_detail::octant_table();
    DirectionColumns columns;
    for (std::size_t first = 0; first < result.size(); first += DirectionColumns::size) {
        const std::size_t number = std::min(DirectionColumns::size, result.size() - first);
        std::copy_n(theta.data() + first, number, columns.theta.data());
        std::copy_n(phi.data() + first, number, columns.phi.data());
        std::fill(columns.theta.begin() + number, columns.theta.end(), 0);
        std::fill(columns.phi.begin() + number, columns.phi.end(), 0);
        const std::uint64_t uncertain = angles_detail::turn(octant, columns);
        for (std::size_t i = 0; i < number; ++i) {
            result[first + i] = (uncertain >> i & 1) != 0
                                    ? from_degrees(theta[first + i], phi[first + i])
                                    : Direction{columns.cos_theta[i], columns.sin_theta[i],
                                                columns.cos_phi[i], columns.sin_phi[i]};
        }
    }
}

Direction Direction::from_vector(Vector3 v) {
    const double length = std::hypot(v.x, v.y, v.z);
    if (!(length > 0 && std::isfinite(length))) {
        throw out_of_range("length of a direction vector", length, "", "> 0 and finite");
    }
    if (!(v.z >= 0)) throw out_of_range("z of a direction vector", v.z, "", ">= 0 (above the horizon)");
    const double radius = std::hypot(v.x, v.y);
    if (radius == 0) return {1, 0, 1, 0};
    return {v.z / length, radius / length, v.x / radius, v.y / radius};
}

Direction Direction::from_unit_vector(Vector3 v) noexcept {
    const double radius = std::sqrt(v.x * v.x + v.y * v.y);
    if (!(radius > 0)) return {1, 0, 1, 0};
    const double inverse = 1 / radius;
    return {v.z, radius, v.x * inverse, v.y * inverse};
}

double WaveVectorChange::cos_theta_d() const noexcept {
    return std::fmin(1, std::sqrt(squared()) / 2);
}

double WaveVectorChange::root_geometrical_factor() const noexcept {
    return vertical > 0 ? squared() / vertical : 0;
}

WaveVectorChange wave_vector_change(const Direction& in, const Direction& out) noexcept {
    // |v_xy|^2 = (sin theta_r - sin theta_i)^2 + sin theta_i sin theta_r |u_i + u_r|^2, u the azimuth's unit
    // vector
    const double along = sine_difference(in, out);
    const double across = std::sqrt(in.sin_theta() * out.sin_theta()) *
                          std::hypot(in.cos_phi() + out.cos_phi(), in.sin_phi() + out.sin_phi());
    return {std::hypot(along, across), in.cos_theta() + out.cos_theta()};
}

HorizontalChange horizontal_change(const Direction& in, const Direction& out) noexcept {
    const double difference = sine_difference(in, out) / 2;
    const double sum = (in.sin_theta() + out.sin_theta()) / 2;
    return {difference * (out.cos_phi() - in.cos_phi()) + sum * (out.cos_phi() + in.cos_phi()),
            difference * (out.sin_phi() - in.sin_phi()) + sum * (out.sin_phi() + in.sin_phi())};
}

double sin_azimuth_between(const Direction& in, const Direction& out) noexcept {
    return out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi();
}

WaveVectorChangeGradient wave_vector_change_gradient(const Direction& in, const Direction& out) noexcept {
    const double along = sine_difference(in, out);
    // 1 + cos phi, so that sin theta_i + sin theta_r cos phi does not cancel about the mirror direction
    const double across = (square(in.cos_phi() + out.cos_phi()) + square(in.sin_phi() + out.sin_phi())) / 2;
    const double vertical = in.cos_theta() + out.cos_theta();
    const ByAngles<double> horizontal_squared{
        2 * in.cos_theta() * (out.sin_theta() * across - along),
        2 * out.cos_theta() * (in.sin_theta() * across + along),
        -2 * in.sin_theta() * out.sin_theta() * sin_azimuth_between(in, out)};
    return {horizontal_squared,
            {-in.sin_theta(), -out.sin_theta(), 0},
            {horizontal_squared.theta_i - 2 * vertical * in.sin_theta(),
             horizontal_squared.theta_r - 2 * vertical * out.sin_theta(), horizontal_squared.phi}};
}

}  // namespace hts
