// hts render: pictures of the papers' scenes, and of any material on a sphere, a cloth or a plate.

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <numbers>

#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/jobs/progress.hpp"
#include "validation/pictures/gallery.hpp"
#include "validation/pictures/picture.hpp"

namespace hts::cli {
namespace {

using validation::Gallery;
using validation::Scene;

constexpr auto render_help = R"(
fig12, fig13, fig14: the scenes of He et al. 1991 by its equation (12): one mirror ray, the
lights' directional-diffuse and uniform-diffuse reflection, an ambient term. --path-trace
lets light go between surfaces by every lobe, with the library's sampler instead.
ashikhmin1, 5, 7, 9, 11 and kurt4, 13: pictures of those papers.
sphere, cloth, plate: any material file under one light. On the sphere x runs east and y
north, on the cloth x runs across; --turn turns the x axis.

Spectra of 31 wavelengths, lights like D65, picture sRGB. --size is the width of the whole
picture in pixels. The same bits for any number of threads.

Examples:
  hts render fig14 --output fig14.png
  hts render fig12 --size 900 --samples 32 --output fig12.png
  hts render sphere --material cli/data/rough-gold.json --size 256 --output gold.png)";

struct RenderOptions {
    std::string scene, output;
    MaterialOptions material;
    int size = 512, samples = 16;
    double turn = 0, exposure = 1;
    bool path_trace = false;
};

constexpr std::size_t share_parts = 10'000;  // of a picture, as progress counts

/// One panel with a material of the user's.
struct ShapeScene {
    const char* name;
    Scene (*of)(const validation::Appearance& material);
};

constexpr std::array shapes{ShapeScene{"sphere", validation::sphere_scene},
                            ShapeScene{"cloth", validation::cloth_scene},
                            ShapeScene{"plate", validation::plate_scene}};

template <class List>
auto named(const List& list, const std::string& name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
}

/// The scene that the options ask for.
Gallery chosen(const RenderOptions& options) {
    const auto shape = named(shapes, options.scene);
    if (shape == shapes.end()) {
        if (!options.material.path.empty())
            throw UsageError{"--material: must not come with " + options.scene};
        if (options.turn != 0) throw UsageError{"--turn: must not come with " + options.scene};
        return *named(validation::galleries(), options.scene);
    }
    if (options.material.path.empty()) throw UsageError{options.scene + ": --material is missing"};
    const auto material = options.material.read();
    require_spectrum(material);
    const auto policy = options.material.policy();
    const auto known = reflectance_from_option("hts render", material, validation::picture_wavelengths(),
                                               {.outside = policy});
    if (known.properties().partial) static_cast<void>(known.sampler(0));  // refuses data that end too soon
    double largest = 0;
    for (const double theta : {0.0, 60.0})
        largest =
            std::max(largest, known.albedo(Direction::from_degrees(theta, 0), known.size() / 2).total());
    warn_of_gain(options.material.path, largest);
    Scene scene = shape->of(validation::Appearance{material, policy});
    for (auto& object : scene.objects) object.turn = options.turn * std::numbers::pi / 180;
    return {options.scene, material.name(), 1, 1, [scene] { return std::vector{scene}; }};
}

void run(const RenderOptions& options) {
    if (!options.output.ends_with(".png")) {
        throw UsageError{"--output " + options.output + ": must end in .png"};
    }
    validation::RenderSettings settings;
    settings.width = static_cast<std::size_t>(options.size);
    settings.samples = static_cast<std::uint32_t>(options.samples);
    settings.path_trace = options.path_trace;
    auto picture = validation::picture_of(
        chosen(options), settings, [job = std::make_shared<spectral::Job>("", share_parts)](double share) {
            job->set_done(static_cast<std::size_t>(share * share_parts));
        });
    for (auto& pixel : picture.pixels) pixel = options.exposure * pixel;
    write_file(options.output, validation::png(picture));
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const Gallery& each : validation::galleries()) names.push_back(each.name);
    for (const ShapeScene& each : shapes) names.emplace_back(each.name);
    return names;
}

}  // namespace

void add_render(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("render", "pictures of the papers' scenes and of any material, PNG");
    auto options = std::make_shared<RenderOptions>();
    one_of(verb->add_option("scene", options->scene, "which"), scene_names())->required();
    writes(verb->add_option("-o,--output", options->output, "picture, a .png file"))->required();
    options->material.add_to(*verb);
    verb->add_option("--turn", options->turn, "of the material's x axis on a shape [deg], -360 ... 360")
        ->check(number_within(-360, 360))
        ->capture_default_str();
    verb->add_option("--size", options->size, "width of the picture, 16 ... 4096")
        ->capture_default_str()
        ->check(whole_number(16, 4096));
    verb->add_option("--samples,--count", options->samples, "rays or paths per pixel, 1 ... 65536")
        ->capture_default_str()
        ->check(whole_number(1, 65536));
    verb->add_option("--exposure", options->exposure, "factor of brightness, 0.001 ... 1000")
        ->capture_default_str()
        ->check(number_within(0.001, 1000));
    verb->add_flag("--path-trace", options->path_trace, "paths instead of equation (12)");
    verb->footer(render_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
