// Pictures as arrays.
#include "evaluation.hpp"
#include "module.hpp"

#include <algorithm>

#include "hts/error.hpp"
#include "spectral/colour/display_colour.hpp"
#include "validation/pictures/appearance.hpp"
#include "validation/pictures/gallery.hpp"

namespace hts::python {
namespace {

using namespace validation;

/// Linear sRGB (height, width, 3) of one of the papers' scenes, or of a material on a shape.
nb::object render(const std::string& scene, nb::object material, std::size_t size, std::uint32_t samples,
                  bool path_trace, std::uint32_t seed) {
    RenderSettings settings;
    settings.width = size;
    settings.samples = samples;
    settings.path_trace = path_trace;
    settings.seed = seed;
    Gallery gallery;
    const auto shape = scene == "sphere"  ? &sphere_scene
                       : scene == "cloth" ? &cloth_scene
                       : scene == "plate" ? &plate_scene
                                          : nullptr;
    if (shape != nullptr) {
        if (material.is_none()) throw Error{"material: must be given with scene \"" + scene + "\""};
        const auto of = nb::cast<const PyMaterial&>(material).sampled(picture_wavelengths()).material();
        gallery = {scene, of.name(), 1, 1, [shape, of] { return std::vector{shape(Appearance{of})}; }};
    } else {
        const auto& all = galleries();
        const auto found = std::ranges::find(all, scene, &Gallery::name);
        if (found == all.end()) {
            std::string names = "sphere, cloth, plate";
            for (const Gallery& each : all) names += ", " + each.name;
            throw Error{"scene \"" + scene + "\": must be one of " + names};
        }
        if (!material.is_none()) throw Error{"material: must not come with scene \"" + scene + "\""};
        gallery = *found;
    }
    Picture picture;
    {
        const nb::gil_scoped_release others_may_run;
        picture = picture_of(gallery, settings);
    }
    Result result{
        {static_cast<std::ptrdiff_t>(picture.height), static_cast<std::ptrdiff_t>(picture.width), 3},
        nb::none(),
        {}};
    double* to = result.data();
    for (const auto& pixel : picture.pixels) {
        const auto rgb = spectral::linear_srgb(pixel, spectral::Illuminant::D65);
        *to++ = rgb.red;
        *to++ = rgb.green;
        *to++ = rgb.blue;
    }
    return result.finish();
}

}  // namespace

void bind_pictures(nb::module_& module) {
    module.def("_render", &render, nb::arg("scene"), nb::arg("material").none(), nb::arg("size"),
               nb::arg("samples"), nb::arg("path_trace"), nb::arg("seed"));
}

}  // namespace hts::python
