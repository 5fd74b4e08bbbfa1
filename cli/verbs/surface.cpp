// hts surface: from measured height maps to roughness, spectra and a material.

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/io/references.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "spectral/output/gnuplot.hpp"
#include "validation/topography/maps/map_files.hpp"
#include "validation/topography/surface_report.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;
using validation::SurfaceStudy;

constexpr auto surface_help = R"(
Reads height maps of one surface: Gwyddion's .gsf and text matrices, ESRI grids, x y z,
matrices of numbers (CSV), .npy, grey PNG of 16 bits, and with a python3 that has surfalize
or SurfaceTopography .sdf, .x3p, .al3d, .sur and others. What a file does not state must be
given: --step, --length-unit, --height-unit. Several maps count by their area.
Prints the rms at three places, that of the fitted spectrum with the amplitude that the
spectrum alone gives it and its error; slopes, whether heights are Gaussian and directions
alike; and the Gaussian, the exponential, K-correlation and two Gaussian scales that come
closest to the power spectrum, with standard errors. "deviance" is 1 at most where a
description holds. Into the folder of --output go
  surface.json                       all that was found
  radial-spectrum.csv                S2(f) [um^4], averaged over directions, and the fits
  profile-spectrum-x.csv, -y.csv     one-sided S1(f) [um^3] of the first map
  autocorrelation.csv                C(r), and the fits
  surface.svg, surface.gnuplot       the picture of all
  material.json                      with --index: ready for --material of other verbs
  spectrum.csv                       its spectrum with errors, with --describe measured

Examples:
  hts surface cli/data/rough-surface.gsf
  hts surface cli/data/rough-surface.gsf --index Al --output out/surface)";

struct SurfaceOptions {
    std::vector<std::string> maps;
    std::vector<double> step, band;
    std::string length_unit, height_unit, level = "plane", gaps = "fill", window = "hann", describe = "best",
                                          index, folder;
    double outliers = 8;
    bool json = false;
};

template <class Choice>
Choice choice(const std::string& text, std::initializer_list<Choice> choices) {
    for (const Choice c : choices) {
        if (text == name(c)) return c;
    }
    return *choices.begin();  // CLI11 lets nothing else through
}

validation::MapUnits units(const SurfaceOptions& options) {
    validation::MapUnits result;
    if (!options.step.empty()) {
        if (options.step.size() > 2) throw UsageError{"--step: must be one distance, or those along x and y"};
        result.step_x = options.step.front();
        result.step_y = options.step.back();
    }
    const auto unit = [](const std::string& option, const std::string& text) -> std::optional<double> {
        if (text.empty()) return std::nullopt;
        return from_option(option, [&] { return validation::length_unit(text); });
    };
    result.length = unit("--length-unit", options.length_unit);
    result.height = unit("--height-unit", options.height_unit);
    return result;
}

validation::SurfaceRequest request(const SurfaceOptions& options) {
    using validation::Gaps, validation::Level, validation::Window;
    validation::SurfaceRequest result{{choice(options.level, {Level::mean, Level::plane, Level::quadratic}),
                                       choice(options.gaps, {Gaps::fill, Gaps::mask}), options.outliers},
                                      choice(options.window, {Window::hann, Window::none})};
    if (options.band.empty()) return result;
    if (options.band.size() != 2 || !(options.band[0] > 0 && options.band[0] < options.band[1]))
        throw UsageError{"--band: must be two periods [um], the shorter first"};
    result.band = {1 / options.band[1], 1 / options.band[0]};
    return result;
}

void write_material(const SurfaceOptions& options, const SurfaceStudy& study) {
    const bool measured = options.describe == "measured";
    const auto& fit = fit_named(study, measured ? "best" : options.describe);
    const auto path = (fs::path{options.folder} / "material.json").string();
    if (measured) write_file((fs::path{options.folder} / "spectrum.csv").string(), spectrum_file(study, fit));
    write_file(path, surface_material(study, fit, json_of(options.index), measured ? "spectrum.csv" : ""));
}

void write_folder(const SurfaceOptions& options, const SurfaceStudy& study) {
    const fs::path folder{options.folder};
    write_file((folder / "surface.json").string(), surface_json(study));
    write_figure(folder, surface_figure(study));
    if (!options.index.empty()) write_material(options, study);
}

void run(const SurfaceOptions& options) {
    if (options.folder.empty() && !options.index.empty())
        throw UsageError{"--index: must come with --output, whose folder gets the material"};
    if (!options.folder.empty()) output::require_gnuplot((fs::path{options.folder} / "surface.svg").string());
    const auto wanted = request(options);
    const auto stated = units(options);
    std::vector<validation::HeightMap> maps;
    for (const std::string& path : options.maps) maps.push_back(validation::read_height_map(path, stated));
    const SurfaceStudy study = validation::studied(std::move(maps), wanted);
    if (!options.folder.empty()) write_folder(options, study);
    std::cout << (options.json ? surface_json(study) : surface_text(study));
}

}  // namespace

void add_surface(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("surface", "from measured height maps to roughness and a material");
    auto options = std::make_shared<SurfaceOptions>();
    reads(verb->add_option("maps", options->maps, "height maps of one surface"))->required();
    comma_list(*verb, "--step", options->step, "between points, or along x and along y [um]");
    verb->add_option("--length-unit", options->length_unit,
                     "of places in the plane: nm, um, mm, m or a number of um");
    verb->add_option("--height-unit", options->height_unit,
                     "of heights: nm, um, mm, m or a number of um; of a PNG per grey level");
    one_of(verb->add_option("--level", options->level, "what is taken off"), {"mean", "plane", "quadratic"})
        ->capture_default_str();
    verb->add_option("--outliers", options->outliers,
                     "robust standard deviations from the median of the 3 by 3 points about it; 0: keep all")
        ->check(number_within(0, 1e6))
        ->capture_default_str();
    one_of(verb->add_option("--gaps", options->gaps, "what becomes of points without height"),
           {"fill", "mask"})
        ->capture_default_str();
    one_of(verb->add_option("--window", options->window, "of the spectra"), {"hann", "none"})
        ->capture_default_str();
    comma_list(*verb, "--band", options->band, "periods that are trusted, the shorter first [um]");
    one_of(verb->add_option("--describe", options->describe, "the roughness of the material"),
           {"best", "gaussian", "exponential", "k_correlation", "two_scales", "measured"})
        ->capture_default_str();
    verb->add_option("--index", options->index,
                     "optical constants of the material: a built-in name, or JSON as in a material file");
    fills(verb->add_option("-o,--output", options->folder, "folder for tables, picture and material"),
          {"surface.json", "radial-spectrum.csv", "profile-spectrum-x.csv", "profile-spectrum-y.csv",
           "autocorrelation.csv", "surface.svg", "surface.gnuplot"});
    verb->add_flag("--json", options->json, "print JSON");
    verb->footer(surface_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
