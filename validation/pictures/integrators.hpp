/// How much light comes along one ray: what the renderer averages. Private to validation/pictures.
#pragma once

#include <cstdint>

#include "validation/pictures/scene.hpp"

namespace hts::validation {

/// A sample of a pixel: where its evenly spread numbers come from.
struct PixelSample {
    std::uint32_t seed, pixel, index;
};

/// One ray by [He91 (12)].
[[nodiscard]] Spectrum ray_radiance(const Scene& scene, const Ray& ray, const PixelSample& sample) noexcept;
/// One path.
[[nodiscard]] Spectrum path_radiance(const Scene& scene, const Ray& ray, const PixelSample& sample) noexcept;

/// A point on a surface as its material sees it.
struct SurfacePoint {
    Vector3 position;  ///< just off the surface
    Frame frame;
    Direction view;  ///< back along the ray that met it
    const Appearance* appearance;

    SurfacePoint(const Ray& ray, const Sight& sight) noexcept;
    [[nodiscard]] Ray towards(const Direction& out) const noexcept {
        return {position, frame.outward(out.vector())};
    }
};

}  // namespace hts::validation
