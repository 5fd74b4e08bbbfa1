/// Lengths and frames in a scene. Scenes are measured in a unit of their own, z is up.
#pragma once

#include <cmath>

#include "hts/direction.hpp"

namespace hts::validation {

[[nodiscard]] inline double length(Vector3 a) noexcept {
    return std::sqrt(dot(a, a));
}
[[nodiscard]] inline Vector3 normalised(Vector3 a) noexcept {
    return (1 / length(a)) * a;
}

/// Three unit vectors at right angles: x and y along the surface, z its outward normal.
struct Frame {
    Vector3 x, y, z;

    ///   along   turned into the surface it is x; any direction but the normal's
    [[nodiscard]] static Frame about(Vector3 normal, Vector3 along) noexcept {
        const Vector3 x = normalised(along - dot(along, normal) * normal);
        return {x, cross(normal, x), normal};
    }
    /// Turned about its normal.   angle   [rad], from x to y
    [[nodiscard]] Frame turned(double angle) const noexcept {
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * x + s * y, c * y - s * x, z};
    }
    [[nodiscard]] Vector3 inward(Vector3 world) const noexcept {
        return {dot(world, x), dot(world, y), dot(world, z)};
    }
    [[nodiscard]] Vector3 outward(Vector3 local) const noexcept {
        return local.x * x + local.y * y + local.z * z;
    }
};

}  // namespace hts::validation
