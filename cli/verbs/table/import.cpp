// hts table import: what a file of another program or of an instrument holds, and a material file that points
// to it.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/references.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/points/scatter_points.hpp"

namespace hts::cli {
namespace {

struct ImportOptions {
    std::string source, format, wavelengths, output, csv;
    std::optional<double> mirror_azimuth;
    OutsideOption outside;
    bool json = false;
};

std::string import_help() {
    std::string text = "\nFormats, recognised by content:\n";
    for (const tables::BrdfFormat& format : tables::readable_formats())
        text.append("  ").append(format.name).append(": ").append(format.what).append("\n");
    return text + R"(
Says what the file holds, which directions and which share of the hemisphere
were measured, and how much of the light from 0, 30 and 60 degrees it reflects
at each wavelength [um]; nan where less than 98 % of the hemisphere was, unless
--outside says what stands there. Scans of the plane of incidence alone are
spread about the mirror direction: views beside the plane see what stands in it
at the same angle from the mirror direction. --output writes a material file
with the model "measured", which eval, polar, sample and the others take; of an
OpenMATERIAL file with roughness and optical constants one with the model "he".

Examples:
  hts table export cli/data/rough-aluminium.json --format csv --wavelengths 0.633 --output scan.csv
  hts table import scan.csv --output scan.json)";
}

std::optional<spectral::WavelengthGrid> wavelengths_of(const ImportOptions& options) {
    if (options.wavelengths.empty()) return std::nullopt;
    return wavelengths_from_option(options.wavelengths);
}

std::string material_text(const ImportOptions& options, const tables::BrdfFile& file) {
    if (!file.material.empty()) return file.material;
    std::string text = "{\n  \"name\": ";
    text.append(json_string(std::filesystem::path{options.source}.stem().string()))
        .append(",\n  \"model\": \"measured\",\n  \"file\": ")
        .append(json_string(reference_from(options.output, options.source)));
    if (!options.format.empty()) text.append(",\n  \"format\": ").append(json_string(file.format));
    if (options.mirror_azimuth)
        text.append(",\n  \"mirror_azimuth_deg\": ").append(shortest(*options.mirror_azimuth));
    if (!options.wavelengths.empty()) {
        std::string list;
        for (const double um : file.brdf.wavelengths().micrometres())
            list.append(list.empty() ? "" : ", ").append(shortest(um));
        text.append(",\n  \"wavelengths_um\": [").append(list).append("]");
    }
    return text + "\n}\n";
}

// Directional-hemispherical reflectance per wavelength; NaN where too little of the hemisphere was measured.
std::vector<double> albedo(const spectral::Reflectance& brdf, const Direction& in) {
    std::vector<double> values;
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        try {
            values.push_back(brdf.albedo(in, i).total());
        } catch (const Error&) {
            values.push_back(std::numeric_limits<double>::quiet_NaN());
        }
    }
    return values;
}

void write_summary(const ImportOptions& options, const spectral::Reflectance& brdf,
                   const std::vector<std::string>& channels) {
    Output output{"-"};
    std::vector<std::string> columns{"wavelength_um", "albedo_at_0_deg", "albedo_at_30_deg",
                                     "albedo_at_60_deg"};
    if (!channels.empty()) columns.emplace_back("channel");
    TableWriter table{output, format_of("-", options.json), columns};
    std::vector<std::vector<double>> albedos;
    double largest = 0;
    for (const double theta : {0.0, 30.0, 60.0}) {
        albedos.push_back(albedo(brdf, Direction::from_degrees(theta, 0)));
        for (const double value : albedos.back()) largest = std::fmax(largest, value);
    }
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        std::string text;
        TableWriter::Row row{table, text};
        row.field(shortest(brdf.wavelengths().micrometres()[i]));
        for (const auto& at_angle : albedos)
            std::isnan(at_angle[i]) ? row.number(at_angle[i]) : row.field(brief(at_angle[i]));
        if (!channels.empty()) row.word(channels[i]);
        row.end();
        table.add(text);
    }
    table.finish();
    output.commit();
    warn_of_gain(options.source, largest);
}

void run(const ImportOptions& options) {
    const auto file =
        tables::read_brdf(options.source, {wavelengths_of(options), options.format, options.mirror_azimuth});
    std::cerr << options.source << ": " << file.format << ", " << file.brdf.wavelengths().size()
              << " wavelengths, " << (file.brdf.properties().isotropic ? "isotropic" : "not isotropic")
              << '\n';
    for (const std::string& note : file.notes) std::cerr << options.source << ": " << note << '\n';
    const auto known = file.material.empty()
                           ? tables::material_of_file(file.brdf)
                                 .named(options.source, "measured", options.source)
                                 .at(file.brdf.wavelengths(), {.outside = options.outside.policy})
                           : file.brdf;
    if (!options.output.empty())
        write_file(options.output, verified(options.output, material_text(options, file)));
    if (!options.csv.empty()) {
        const auto grid = tables::csv_grid(file.brdf.properties().isotropic);
        write_file(options.csv, tables::scatter_csv(known, grid));
    }
    write_summary(options, known, file.channels);
}

}  // namespace

void add_table_import(CLI::App& table) {
    CLI::App* verb =
        table.add_subcommand("import", "make a material of a file of another program or instrument");
    auto options = std::make_shared<ImportOptions>();
    std::vector<std::string> names;
    for (const tables::BrdfFormat& format : tables::readable_formats()) names.push_back(format.name);
    reads_whole(verb->add_option("source", options->source, "file to read, - for standard input"))
        ->required();
    one_of(verb->add_option("--format,-f", options->format, "of the file, if it shall not be recognised"),
           names);
    verb->add_option(wavelengths_names, options->wavelengths, "what the channels are called, a,b,c [um]");
    writes(verb->add_option("--output,-o", options->output, "material file to write (JSON)"));
    writes(verb->add_option("--csv", options->csv, "the BRDF on a grid of angles, as CSV"));
    verb->add_option(
            "--mirror-azimuth", options->mirror_azimuth,
            "where azimuths have the mirror direction [deg], 0 or 180:\nif not given, 0 in FRED's tables, "
            "180 in OpenMATERIAL and BiRD")
        ->check(CLI::IsMember({0.0, 180.0}));
    options->outside.add_to(*verb);
    verb->add_flag("--json", options->json, "what it holds as JSON");
    verb->footer(import_help());
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
