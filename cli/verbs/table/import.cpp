// hts table import: what a file of another program or of an instrument holds, and a material file that points
// to it.

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/lobe_quadrature.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/points/scatter_points.hpp"

namespace hts::cli {
namespace {

struct ImportOptions {
    std::string source, format, wavelengths, output, csv;
    bool json = false;
};

std::string import_help() {
    std::string text = "\nFormats, recognised by content:\n";
    for (const tables::BrdfFormat& format : tables::readable_formats())
        text.append("  ").append(format.name).append(": ").append(format.what).append("\n");
    return text + R"(
Says what the file holds and how much of the light from 0, 30 and 60 degrees it reflects at
each wavelength [um]. --output writes a material file with the model "measured", which
eval, polar, sample and the others take.

Examples:
  hts table export cli/data/rough-aluminium.json --format csv --wavelengths 0.633 --output scan.csv
  hts table import scan.csv --wavelengths 0.633 --output scan.json)";
}

std::optional<spectral::WavelengthGrid> wavelengths_of(const ImportOptions& options) {
    if (options.wavelengths.empty()) return std::nullopt;
    return wavelengths_from_option(options.wavelengths);
}

std::string material_text(const ImportOptions& options, const tables::BrdfFile& file) {
    const auto folder = std::filesystem::absolute(options.output).parent_path();
    const auto source = std::filesystem::absolute(options.source).lexically_relative(folder);
    std::string text = "{\n  \"name\": ";
    text.append(json_string(std::filesystem::path{options.source}.stem().string()))
        .append(",\n  \"model\": \"measured\",\n  \"file\": ")
        .append(json_string(source.string()));
    if (!options.format.empty()) text.append(",\n  \"format\": ").append(json_string(file.format));
    if (!options.wavelengths.empty()) {
        std::string list;
        for (const double um : file.brdf.wavelengths().micrometres())
            list.append(list.empty() ? "" : ", ").append(shortest(um));
        text.append(",\n  \"wavelengths_um\": [").append(list).append("]");
    }
    return text + "\n}\n";
}

// Directional-hemispherical reflectance per wavelength, to some 1e-3.
std::vector<double> albedo(const spectral::Reflectance& brdf, const Direction& in) {
    std::vector<double> sums(brdf.wavelengths().size(), 0), values(sums.size());
    for (const auto& view : tables::lobe_quadrature(in, tables::lobe_slope(brdf), 20'000)) {
        brdf.brdf({in, view.out}, values);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += view.weight * view.out.cos_theta() * values[i];
    }
    return sums;
}

void write_summary(const ImportOptions& options, const tables::BrdfFile& file) {
    Output output{"-"};
    TableWriter table{
        output, format_of("-", options.json), {"wavelength_um", "albedo_0", "albedo_30", "albedo_60"}};
    std::vector<std::vector<double>> albedos;
    for (const double theta : {0.0, 30.0, 60.0})
        albedos.push_back(albedo(file.brdf, Direction::from_degrees(theta, 0)));
    for (std::size_t i = 0; i < file.brdf.wavelengths().size(); ++i) {
        std::string text;
        TableWriter::Row row{table, text};
        row.field(shortest(file.brdf.wavelengths().micrometres()[i]));
        for (const auto& at_angle : albedos) row.field(brief(at_angle[i]));
        row.end();
        table.add(text);
    }
    table.finish();
    output.commit();
}

void run(const ImportOptions& options) {
    const auto file = tables::read_brdf(options.source, wavelengths_of(options), options.format);
    std::cerr << options.source << ": " << file.format << ", " << file.brdf.wavelengths().size()
              << " wavelengths, " << (file.brdf.properties().isotropic ? "isotropic" : "not isotropic")
              << '\n';
    for (const std::string& note : file.notes) std::cerr << options.source << ": " << note << '\n';
    if (!options.output.empty()) write_file(options.output, material_text(options, file));
    if (!options.csv.empty()) {
        const auto grid = tables::csv_grid(file.brdf.properties().isotropic);
        write_file(options.csv, tables::scatter_csv(file.brdf, grid));
    }
    write_summary(options, file);
}

}  // namespace

void add_table_import(CLI::App& table) {
    CLI::App* verb =
        table.add_subcommand("import", "make a material of a file of another program or instrument");
    auto options = std::make_shared<ImportOptions>();
    std::vector<std::string> names;
    for (const tables::BrdfFormat& format : tables::readable_formats()) names.push_back(format.name);
    reads(verb->add_option("source", options->source, "file to read"))->required();
    one_of(verb->add_option("--format,-f", options->format, "of the file, if it shall not be recognised"),
           names);
    verb->add_option(wavelengths_names, options->wavelengths, "what the channels are called, a,b,c [um]");
    writes(verb->add_option("--output,-o", options->output, "material file to write (JSON)"));
    writes(verb->add_option("--csv", options->csv, "the BRDF on a grid of angles, as CSV"));
    verb->add_flag("--json", options->json, "what it holds as JSON");
    verb->footer(import_help());
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
