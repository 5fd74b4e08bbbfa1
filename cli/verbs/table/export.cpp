// hts table export: files of other programs, each read back at once and compared with what was written.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/formats.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
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
--solid-angle instead. Then the file is read back and compared with the model at random
pairs of directions: the report goes to standard output.

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

Reflectance with_specular(const ExportOptions& options, const Reflectance& brdf) {
    if (options.specular == "none") return brdf;
    return from_option("--solid-angle", [&] { return tables::with_specular_box(brdf, options.solid_angle); });
}

void run(const ExportOptions& options) {
    const TableFormat& format = format_named(options.format);
    const Reflectance plain = source_of(options, format);
    const Reflectance boxed = with_specular(options, plain);
    const Reflectance brdf = format.as_held ? format.as_held(boxed) : boxed;
    tables::Exported exported = format.exported(brdf, options.output);
    if (options.specular == "box")
        exported.sidecar.specular = "in the file, a box of " + shortest(options.solid_angle) + " sr";
    tables::write_with_sidecar(options.output, plain, std::move(exported));
    const auto report = tables::round_trip(brdf, format.read(options.output), {options.pairs, options.seed});
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
