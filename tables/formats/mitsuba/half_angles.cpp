#include "tables/formats/mitsuba/half_angles.hpp"

#include <cmath>

#include "tables/formats/lobe.hpp"

namespace hts::tables {
namespace {

double length(Vector3 v) noexcept {
    return std::sqrt(dot(v, v));
}

/// b = z x h/|z x h|.
Vector3 across(Vector3 h) noexcept {
    const double sine = std::hypot(h.x, h.y);
    return sine > 0 ? Vector3{-h.y / sine, h.x / sine, 0} : Vector3{0, 1, 0};
}

}  // namespace

HalfAngles half_angles(const DirectionPair& pair) noexcept {
    const Vector3 h = bisector(pair), light = pair.in.vector();
    const Vector3 b = across(h), t = cross(b, h);
    const Vector3 apart = light - pair.out.vector();  // 2 sin theta_d p
    return {std::atan2(std::hypot(h.x, h.y), h.z), std::atan2(length(apart) / 2, dot(h, light)),
            std::atan2(dot(b, apart), dot(t, apart))};
}

HalfAnglesPair::HalfAnglesPair(const HalfAngles& angles) noexcept {
    const double sin_h = std::sin(angles.theta_h), cos_h = std::cos(angles.theta_h);
    const Vector3 h{sin_h, 0, cos_h}, t{cos_h, 0, -sin_h}, b{0, 1, 0};
    const Vector3 p = std::cos(angles.phi_d) * t + std::sin(angles.phi_d) * b;
    in = std::cos(angles.theta_d) * h + std::sin(angles.theta_d) * p;
    out = std::cos(angles.theta_d) * h - std::sin(angles.theta_d) * p;
    x = cross(p, h);
}

Vector3 scattering_plane_normal(const DirectionPair& pair) noexcept {
    const Vector3 normal = cross(pair.in.vector(), pair.out.vector());
    if (const double sine = length(normal); sine > 0) return (1 / sine) * normal;
    return across(pair.in.vector());
}

}  // namespace hts::tables
