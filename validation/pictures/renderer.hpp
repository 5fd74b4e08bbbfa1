/// Pictures of scenes: spectral ray tracing by equation (12) of He et al. 1991, or by paths.
///
/// [He91 (12)], as the tracer sums it at every point that a ray meets:
///   L = rho_s L(mirror ray) + sum over lights of int (f_dd + f_ud) L_light cos theta_i dw + rho_hd L_ambient
///
/// One mirror ray; lights are areas, whose integral replaces the paper's f cos theta_i dw of a point; rho_hd
/// is a function of wavelength alone, as in the paper, but without the specular term, since the mirror ray
/// that meets nothing already sees the ambient light. So a white surface in white light is white, and the
/// paper's smooth cylinder, whose ambient term it "set to zero to emphasise the specular images", has none to
/// begin with. Light from other surfaces arrives by mirror rays alone.
///
/// Path tracing has no ambient term: every ray that leaves the scene sees the ambient light, and light from
/// surfaces arrives by every lobe. Lights are sampled and met, both weighted by the balance heuristic.
#pragma once

#include <functional>

#include "spectral/colour/colour.hpp"
#include "validation/pictures/scene.hpp"

namespace hts::validation {

/// Colours by rows from the top; Y is 1 where the radiance is that of the illuminant, 1, at exposure 1.
struct Picture {
    std::size_t width, height;
    std::vector<spectral::Xyz> pixels;
};

struct RenderSettings {
    std::size_t width = 512, height = 512;  ///< pixels
    std::uint32_t samples = 16;             ///< rays or paths per pixel, evenly spread over its square
    bool path_trace = false;
    std::uint32_t seed = 1;
};

/// Told of the share that is done, 0 ... 1, by one thread at a time.
using Progress = std::function<void(double share)>;

/// A picture, on all cores; the same bits for any number of threads.
[[nodiscard]] Picture render(const Scene& scene, const RenderSettings& settings,
                             const Progress& progress = {});

/// Radiance along a ray by [He91 (12)], the mean of `samples` choices of points on the lights.
[[nodiscard]] Spectrum radiance(const Scene& scene, const Ray& ray, std::uint32_t samples);
/// The same by paths.
[[nodiscard]] Spectrum path_radiance(const Scene& scene, const Ray& ray, std::uint32_t samples);

}  // namespace hts::validation
