// hts table export: files of other programs, each read back at once and compared with what was written.

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/answers/validity_warning.hpp"
#include "cli/io/options.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/specular_box.hpp"
#include "tables/formats/writers/write_brdf.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

struct ExportOptions {
    std::string source, format, output, wavelengths, specular = "none";
    double solid_angle = 0.001;
    std::size_t pairs = 100'000;
    std::uint64_t seed = 1;
    bool json = false, colour = false;
    std::optional<std::string> basis;
    std::optional<int> depth;
    std::optional<double> mirror_azimuth;
    OutsideOption outside;
};

std::string export_help() {
    std::string text = "\nFormats:\n";
    for (const auto& format : tables::written_formats())
        text += "  " + format.name + ": " + format.what + "\n";
    return text + R"(
The source is a material file or a table (.htst), which has its own wavelengths. The file
holds the diffuse terms; the specular term is left out (but of glsl and wgsl) and its reflectance
written beside the file, as FILE.json, together with what the numbers mean. --specular box spreads it over
--solid-angle instead: about the mirror direction, or of formats on half vectors over facets
of as little tilt; a box that the grid of a format cannot hold is refused. Before anything is
written, the files are read as the programs read them that know the format, and compared with
the model at random pairs of directions: the report goes to standard output.

--colour writes red, green and blue where a format could hold spectra or luminance: rgl as rgb,
radiance as CIE-u and CIE-v, klems as CIE-X and CIE-Z beside Visible, zemax as X, Y, Z, astm as
R, G, B.

Examples:
  hts table export cli/data/rough-aluminium.json --format rgl --output aluminium.bsdf
  hts table export cli/data/rough-aluminium.json --format pbsdf --output aluminium.pbsdf
  hts table export cli/data/rough-aluminium.json --format glsl --output aluminium.glsl
  hts table export cli/data/rough-aluminium.json --format openmaterial --output aluminium.xomp)";
}

/// UsageError for what means nothing in the format.
tables::FileRequest request_of(const ExportOptions& options, const tables::WrittenFormat& format) {
    tables::FileRequest request{.path = options.output,
                                .colour = options.colour,
                                .basis = options.basis,
                                .depth = options.depth,
                                .mirror_azimuth = options.mirror_azimuth,
                                .pairs = options.pairs,
                                .seed = options.seed};
    if (options.specular == "box") {
        static_cast<void>(from_option("--solid-angle",
                                      [&] { return tables::specular_box_half_angle(options.solid_angle); }));
        request.specular_spread = options.solid_angle;
    }
    if (const auto what = tables::not_taken(request, format)) {
        throw UsageError{"--" + (*what == "specular" ? "specular box" : *what) +
                         ": must not come with --format " + format.name +
                         (*what == "specular" ? ", which holds the specular term as it is" : "")};
    }
    return request;
}

/// A table has its own wavelengths.
tables::Source source_of(const ExportOptions& options, const tables::WrittenFormat& format) {
    if (options.source.ends_with(".htst")) {
        if (!options.wavelengths.empty()) throw UsageError{"--wavelengths: must not come with a table"};
        return {tables::Table::open(options.source).reflectance()};
    }
    const MaterialOptions material{options.source, options.outside};
    const auto described = material.read();
    auto wavelengths = tables::wavelengths_to_write(described, format, options.colour);
    if (!options.wavelengths.empty()) wavelengths = wavelengths_from_option(options.wavelengths);
    return spectral::located(
        "--wavelengths", [&] { return tables::source_to_write(described, wavelengths, material.policy()); });
}

void run(const ExportOptions& options) {
    const tables::WrittenFormat& format = tables::written_format(options.format);
    const tables::FileRequest request = request_of(options, format);
    const tables::Source source = source_of(options, format);
    const auto report = tables::write_brdf(source, format, request);
    std::cout << (options.json ? report.json() + "\n" : report.text());
    std::cerr << options.output << ": " << std::filesystem::file_size(spectral::path_to_read(options.output))
              << " bytes\n";
    warn_of_gain_of(source.brdf, options.source);
}

}  // namespace

void add_table_export(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("export", "write a file of another program and read it back");
    auto options = std::make_shared<ExportOptions>();
    std::vector<std::string> names;
    for (const auto& format : tables::written_formats()) names.push_back(format.name);
    reads_whole(
        verb->add_option("source,--material,-m", options->source, "material file (JSON) or table (.htst)"))
        ->required();
    one_of(verb->add_option("--format,-f", options->format, "of the file"), names)->required();
    writes(verb->add_option("--output,-o", options->output, "file to write"), [](const std::string& path) {
        return std::vector{path + ".json"};
    })->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]");
    options->outside.add_to(*verb);
    auto* specular =
        one_of(verb->add_option("--specular", options->specular, "what becomes of the specular term"),
               {"none", "box"})
            ->capture_default_str();
    verb->add_option("--solid-angle", options->solid_angle, "of the box [sr]")
        ->needs(specular)
        ->capture_default_str();
    verb->add_flag("--colour", options->colour, "red, green and blue in the file: see below");
    verb->add_option("--basis", options->basis, "of klems: full (145 patches), half (73) or quarter (41)")
        ->check(CLI::IsMember({"full", "half", "quarter"}));
    verb->add_option("--depth", options->depth,
                     "of the tree of radiance: halvings of each dimension, 1 ... 8, for\n"
                     "surfaces with a grain 6; more is finer (7, or 5)")
        ->check(whole_number(1, 8));
    verb->add_option(
            "--mirror-azimuth", options->mirror_azimuth,
            "of openmaterial: where azimuths have the mirror direction [deg], 0 or 180 (the default)")
        ->check(CLI::IsMember({0.0, 180.0}));
    verb->add_option(pairs_names, options->pairs, "pairs of directions to compare at, 1 ... 100000000")
        ->check(whole_number(1, 100'000'000))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of those pairs")->check(seed_number())->capture_default_str();
    verb->add_flag("--json", options->json, "the report as JSON");
    verb->footer(export_help());
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
