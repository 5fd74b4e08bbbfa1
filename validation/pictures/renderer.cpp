#include "validation/pictures/renderer.hpp"

#include <algorithm>

#include "spectral/colour/colour.hpp"
#include "spectral/parallel.hpp"
#include "validation/pictures/evenly.hpp"
#include "validation/pictures/integrators.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t tile_edge = 16;

/// One ray or one path.
Spectrum sampled(const Scene& scene, const Ray& ray, const PixelSample& sample, bool path_trace) {
    return path_trace ? path_radiance(scene, ray, sample) : ray_radiance(scene, ray, sample);
}

Spectrum mean(const Scene& scene, const Ray& ray, std::uint32_t samples, bool path_trace) {
    Spectrum sum;
    for (std::uint32_t i = 0; i < samples; ++i) sum += sampled(scene, ray, {1, 0, i}, path_trace);
    return (1.0 / samples) * sum;
}

/// What turns a scene into the pixels of a picture.
class Tracer {
  public:
    Tracer(const Scene& scene, const RenderSettings& settings)
        : scene_{scene},
          settings_{settings},
          colours_{spectral::tristimulus_weights(picture_wavelengths().micrometres(),
                                                 spectral::Illuminant::D65)} {}

    [[nodiscard]] spectral::Xyz pixel(std::size_t row, std::size_t column) const {
        const auto number = static_cast<std::uint32_t>(row * settings_.width + column);
        const auto width = static_cast<double>(settings_.width);
        Spectrum sum;
        for (std::uint32_t i = 0; i < settings_.samples; ++i) {
            const auto [x, y] = even_point(stream(settings_.seed, number, 0), i);
            const Ray ray = scene_.camera.ray((static_cast<double>(column) + x) / width,
                                              (static_cast<double>(row) + y) / width,
                                              static_cast<double>(settings_.height) / width);
            sum += sampled(scene_, ray, {settings_.seed, number, i}, settings_.path_trace);
        }
        return scene_.exposure / settings_.samples * colours_(sum.values);
    }

  private:
    const Scene& scene_;
    const RenderSettings& settings_;
    spectral::TristimulusWeights colours_;
};

}  // namespace

Spectrum radiance(const Scene& scene, const Ray& ray, std::uint32_t samples) {
    return mean(scene, ray, samples, false);
}

Spectrum path_radiance(const Scene& scene, const Ray& ray, std::uint32_t samples) {
    return mean(scene, ray, samples, true);
}

Picture render(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
    Picture picture{settings.width, settings.height,
                    std::vector<spectral::Xyz>(settings.width * settings.height)};
    const Tracer tracer{scene, settings};
    const std::size_t across = (settings.width + tile_edge - 1) / tile_edge;
    const std::size_t tiles = across * ((settings.height + tile_edge - 1) / tile_edge);
    std::size_t done = 0;
    spectral::parallel_for(tiles, [&](std::size_t tile) {
        const std::size_t top = tile / across * tile_edge, left = tile % across * tile_edge;
        for (std::size_t row = top; row < std::min(top + tile_edge, settings.height); ++row) {
            for (std::size_t column = left; column < std::min(left + tile_edge, settings.width); ++column) {
                picture.pixels[row * settings.width + column] = tracer.pixel(row, column);
            }
        }
#pragma omp critical(hts_render_progress)
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(tiles));
    });
    return picture;
}

}  // namespace hts::validation
