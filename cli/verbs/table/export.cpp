// hts table export: files of other programs, each read back at once and compared with what was written.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/formats.hpp"
#include "cli/verbs/table/table.hpp"
#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/specular_box.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

struct ExportOptions {
    std::string source, format, output, wavelengths, specular = "none";
    double solid_angle = 0.001;
    std::size_t pairs = 100'000;
    std::uint64_t seed = 1;
    bool json = false;
    OutsideOption outside;
};

std::string export_help() {
    std::string text = "\nFormats:\n";
    for (const TableFormat& format : table_formats()) text += "  " + format.name + ": " + format.what + "\n";
    return text + R"(
The source is a material file or a table (.htst), which has its own wavelengths. The file
holds the diffuse terms; the specular delta is left out and its reflectance written beside
the file, as FILE.json, together with what the numbers mean. --specular box spreads it over
--solid-angle instead: about the mirror direction, or of formats on half vectors over facets
of as little tilt; a box that the grid of a format cannot hold is refused. Before anything is
written, the files are read as the programs read them that know the format, and compared with
the model at random pairs of directions: the report goes to standard output.

Examples:
  hts table export cli/data/rough-aluminium.json --format rgl --output aluminium.bsdf
  hts table export cli/data/rough-aluminium.json --format pbsdf --output aluminium.pbsdf)";
}

const TableFormat& format_named(const std::string& name) {
    const auto& formats = table_formats();
    return *std::find_if(formats.begin(), formats.end(), [&](const auto& each) { return each.name == name; });
}

/// A table has its own wavelengths.
Reflectance table_of(const ExportOptions& options) {
    if (!options.wavelengths.empty()) throw UsageError{"--wavelengths: must not come with a table"};
    return tables::Table::open(options.source).reflectance();
}

Reflectance source_of(const ExportOptions& options, const TableFormat& format) {
    if (options.source.ends_with(".htst")) return table_of(options);
    const MaterialOptions material{options.source, options.outside};
    const auto wavelengths =
        wavelengths_from_option(options.wavelengths.empty() ? format.wavelengths : options.wavelengths);
    const auto described = material.read();
    const auto& channels = described.properties().channels;
    if (format.name != "merl" || (!channels.empty() && channels.front() != "B")) require_spectrum(described);
    // far finer than any of these files holds
    return reflectance_from_option("--wavelengths", described, wavelengths,
                                   {.tolerance = Tolerance{1e-6}, .outside = material.policy()});
}

Reflectance with_specular(const ExportOptions& options, const TableFormat& format, const Reflectance& brdf) {
    if (options.specular == "none") return brdf;
    return from_option("--solid-angle", [&] {
        return format.spread == SpecularSpread::box ? tables::with_specular_box(brdf, options.solid_angle)
                                                    : tables::with_specular_lobe(brdf, options.solid_angle);
    });
}

std::string name_of(SpecularSpread spread, double solid_angle) {
    if (spread == SpecularSpread::patches) return "spread over the patch that mirrors the light's";
    const std::string box = "a box of " + shortest(solid_angle) + " sr";
    return spread == SpecularSpread::box ? box : "spread over facets, at the normal as high as " + box;
}

/// hts::Error if a reader of the file gains or loses light.
void require_held(const ExportOptions& options, const tables::RoundTrip& report) {
    constexpr double most_lost = 0.02, degree = std::numbers::pi / 180, largest_theta = 76 * degree;
    for (const auto& each : report.albedo) {
        if (each.theta_i > largest_theta || std::abs(each.read_back - each.original) <= most_lost) continue;
        throw Error{options.output + ": would reflect " + brief(each.read_back) + " for " +
                    brief(each.original) + " at theta_i " + brief(each.theta_i / degree) + " deg, " +
                    shortest(each.wavelength_um) + " um, as its readers take it: the grid of format " +
                    options.format + " does not hold a box of " + shortest(options.solid_angle) +
                    " sr; give a larger --solid-angle or --specular none"};
    }
}

void run(const ExportOptions& options) {
    const TableFormat& format = format_named(options.format);
    const Reflectance plain = source_of(options, format);
    const Reflectance boxed = with_specular(options, format, plain);
    const auto held = [&](const Reflectance& brdf) { return format.as_held ? format.as_held(brdf) : brdf; };
    const Reflectance brdf = held(boxed);
    const bool box = options.specular == "box", patches = format.spread == SpecularSpread::patches;
    const ExportDetails details{box ? options.solid_angle : 0, tables::lobe_slope(plain)};
    tables::Exported exported = format.exported(patches ? held(plain) : brdf, options.output, details);
    const auto report =
        tables::round_trip(brdf, format.read(exported),
                           {options.pairs, options.seed, details.slope, details.specular_solid_angle});
    if (box) {
        if (!patches) require_held(options, report);
        exported.sidecar.specular = "in the file, " + name_of(format.spread, options.solid_angle);
    }
    tables::write_with_sidecar(options.output, plain, std::move(exported));
    std::cout << (options.json ? report.json() + "\n" : report.text());
    std::cerr << options.output << ": " << std::filesystem::file_size(spectral::path_to_read(options.output))
              << " bytes\n";
}

}  // namespace

void add_table_export(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("export", "write a file of another program and read it back");
    auto options = std::make_shared<ExportOptions>();
    std::vector<std::string> names;
    for (const TableFormat& format : table_formats()) names.push_back(format.name);
    reads(verb->add_option("source,--material,-m", options->source, "material file (JSON) or table (.htst)"))
        ->required();
    one_of(verb->add_option("--format,-f", options->format, "of the file"), names)->required();
    writes(verb->add_option("--output,-o", options->output, "file to write"), [](const std::string& path) {
        return std::vector{path + ".json"};
    })->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]");
    options->outside.add_to(*verb);
    auto* specular =
        one_of(verb->add_option("--specular", options->specular, "what becomes of the specular delta"),
               {"none", "box"})
            ->capture_default_str();
    verb->add_option("--solid-angle", options->solid_angle, "of the box [sr]")
        ->needs(specular)
        ->capture_default_str();
    verb->add_option(pairs_names, options->pairs, "pairs of directions to compare at, 1 ... 100000000")
        ->check(whole_number(1, 100'000'000))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of those pairs")->check(seed_number())->capture_default_str();
    verb->add_flag("--json", options->json, "the report as JSON");
    verb->footer(export_help());
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
