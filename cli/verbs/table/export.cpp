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
    bool json = false, colour = false;
    std::string basis;
    int depth = 0;
    std::optional<double> mirror_azimuth;
    OutsideOption outside;
};

std::string export_help() {
    std::string text = "\nFormats:\n";
    for (const TableFormat& format : table_formats()) text += "  " + format.name + ": " + format.what + "\n";
    return text + R"(
The source is a material file or a table (.htst), which has its own wavelengths. The file
holds the diffuse terms; the specular term is left out (but of glsl) and its reflectance written
beside the file, as FILE.json, together with what the numbers mean. --specular box spreads it over
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

const TableFormat& format_named(const std::string& name) {
    const auto& formats = table_formats();
    return *std::find_if(formats.begin(), formats.end(), [&](const auto& each) { return each.name == name; });
}

/// UsageError for what means nothing in the format.
ExportDetails details_of(const ExportOptions& options, const TableFormat& format) {
    const auto require = [&](bool given, const char* option) {
        if (given && std::ranges::find(format.takes, option) == format.takes.end())
            throw UsageError{std::string{option} + ": must not come with --format " + format.name};
    };
    require(options.colour, "--colour");
    require(!options.basis.empty(), "--basis");
    require(options.depth > 0, "--depth");
    require(options.mirror_azimuth.has_value(), "--mirror-azimuth");
    if (format.holds_specular && options.specular == "box")
        throw UsageError{"--specular box: must not come with --format " + format.name +
                         ", which holds the specular term as it is"};
    ExportDetails details{.colour = options.colour, .depth = options.depth};
    if (!options.basis.empty()) details.basis = options.basis;
    details.mirror_azimuth = options.mirror_azimuth.value_or(details.mirror_azimuth);
    return details;
}

/// Where the user gives none.
std::string default_wavelengths(const ExportOptions& options, const TableFormat& format) {
    const bool one = format.wavelengths.find(':') == std::string::npos;
    return options.colour && one ? "0.40:0.70:31" : format.wavelengths;
}

/// A reflectance, and what its wavelengths stand for if they are none.
struct Source {
    Reflectance brdf;
    std::vector<std::string> channels{};
};

/// A table has its own wavelengths.
Source table_of(const ExportOptions& options) {
    if (!options.wavelengths.empty()) throw UsageError{"--wavelengths: must not come with a table"};
    return {tables::Table::open(options.source).reflectance()};
}

bool in_colour(const ExportOptions& options, const TableFormat& format) {
    return options.colour || format.colour_alone;
}

Source source_of(const ExportOptions& options, const TableFormat& format) {
    if (options.source.ends_with(".htst")) return table_of(options);
    const MaterialOptions material{options.source, options.outside};
    const auto described = material.read();
    const auto& channels = described.properties().channels;
    const bool takes_colour = std::ranges::find(format.takes, "--colour") != format.takes.end();
    if (!in_colour(options, format) && channels.size() > 1 && takes_colour)
        throw Error{described.name() + ": holds the channels " + spectral::joined(channels) +
                    ": must be written with --colour"};
    if (!in_colour(options, format) || channels.size() == 1) require_spectrum(described);
    const std::string otherwise = channels.empty() ? default_wavelengths(options, format) : "0.46,0.55,0.62";
    const auto wavelengths =
        wavelengths_from_option(options.wavelengths.empty() ? otherwise : options.wavelengths);
    // far finer than any of these files holds
    return {reflectance_from_option("--wavelengths", described, wavelengths,
                                    {.tolerance = Tolerance{1e-6}, .outside = material.policy()}),
            channels};
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
    ExportDetails details = details_of(options, format);
    const auto [plain, channels] = source_of(options, format);
    const Reflectance boxed = with_specular(options, format, plain);
    const auto held = [&, &names = channels](const Reflectance& brdf) {
        if (in_colour(options, format)) return as_colour(brdf, format.colour, names);
        return format.as_held ? format.as_held(brdf) : brdf;
    };
    const Reflectance brdf = held(boxed);
    const bool box = options.specular == "box", patches = format.spread == SpecularSpread::patches;
    if (box) details.specular_solid_angle = options.solid_angle;
    details.slope = tables::lobe_slope(plain);
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
