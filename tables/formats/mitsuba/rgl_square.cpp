#include "tables/formats/mitsuba/rgl_square.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hts::tables {
namespace {

constexpr auto pi = std::numbers::pi_v<float>;

struct FloatVector {
    float x, y, z;
};

FloatVector rounded(Vector3 v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

FloatVector normalised_sum(FloatVector a, FloatVector b) noexcept {
    const FloatVector sum{a.x + b.x, a.y + b.y, a.z + b.z};
    const float scale = 1 / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    return {scale * sum.x, scale * sum.y, scale * sum.z};
}

/// By the chord from the normal, exact for small angles.
float elevation(FloatVector v) noexcept {
    const float chord = std::sqrt(v.x * v.x + v.y * v.y + (v.z - 1) * (v.z - 1));
    return 2 * std::asin(std::min(0.5F * chord, 1.0F));
}

float azimuth(FloatVector v) noexcept {
    return std::atan2(v.y, v.x);
}

float v_of_phi(float phi) noexcept {
    return (phi + pi) / (2 * pi);
}

}  // namespace

float u_of_theta(float theta) noexcept {
    return std::sqrt(theta * (2 / pi));
}

float theta_of_u(float u) noexcept {
    return u * u * (pi / 2);
}

LightAngles::LightAngles(const Direction& in) noexcept
    : theta{elevation(rounded(in.vector()))}, phi{azimuth(rounded(in.vector()))} {}

Point2 LightAngles::square() const noexcept {
    return {u_of_theta(theta), v_of_phi(phi)};
}

HalfVector::HalfVector(const DirectionPair& pair, bool isotropic) noexcept : light_{pair.in} {
    const FloatVector in = rounded(pair.in.vector());
    const FloatVector m = normalised_sum(in, rounded(pair.out.vector()));
    const float theta = elevation(m);
    const float v = v_of_phi(isotropic ? azimuth(m) - light_.phi : azimuth(m));
    square_ = {u_of_theta(theta), v - std::floor(v)};
    const float cosine = in.x * m.x + in.y * m.y + in.z * m.z;
    solid_angle_ = std::max(2 * pi * pi * square_.x * std::sin(theta), 1e-6F) * 4 * cosine;
}

Vector3 half_vector(Point2 square, float phi) noexcept {
    const auto theta = static_cast<double>(theta_of_u(square.x));
    const auto azimuth = static_cast<double>((2 * square.y - 1) * pi + phi);
    return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
}

}  // namespace hts::tables
