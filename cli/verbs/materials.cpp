// hts materials: the optical constants that come with the library, or those of a file.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {
namespace {

using spectral::OpticalConstants;

constexpr int sample_size = 11;

constexpr auto materials_help = R"(
Without a name: all built-in materials with their range and source. With a name, or with
a file (.yml of refractiveindex.info, .csv, .json): source and range on standard error
and n, k over the range, or at --wavelengths, as data.

Examples:
  hts materials
  hts materials Al --wavelengths 0.4:0.7:7
  hts materials spectral/materials/data/Al.yml --json)";

struct MaterialsOptions {
    std::string name, wavelengths;
    OutsideOption outside;
    OutputOptions output;
};

/// "author, title (year)" of a longer source.
std::string short_source(const std::string& source) {
    static const std::regex year{R"(\([0-9]{4}\))"};
    std::smatch found;
    if (!std::regex_search(source, found, year)) return source;
    return source.substr(0, static_cast<std::size_t>(found.position() + found.length()));
}

void list(TableWriter& table) {
    for (const std::string& name : spectral::optical_constants_names()) {
        const OpticalConstants material = spectral::built_in_optical_constants(name);
        std::string text;
        TableWriter::Row row{table, text};
        row.field(name).field(shortest(material.range().shortest)).field(shortest(material.range().longest));
        row.field(short_source(material.source())).end();
        table.add(text);
    }
    table.finish();
}

/// No built-in name has a point or a slash.
bool looks_like_a_path(const std::string& name) {
    return name.find_first_of("./") != std::string::npos || std::filesystem::exists(name);
}

OpticalConstants material_of(const std::string& name) {
    const auto names = spectral::optical_constants_names();
    if (std::find(names.begin(), names.end(), name) != names.end())
        return spectral::built_in_optical_constants(name);
    if (looks_like_a_path(name)) return spectral::read_optical_constants(name);
    return from_option("material", [&] { return spectral::built_in_optical_constants(name); });
}

/// Equal ratios over the range of a table, rounded between its ends; the visible for a constant.
spectral::WavelengthGrid sample_grid(const OpticalConstants& material) {
    const auto [first, last] = material.range();
    if (last >= longest_length) return spectral::WavelengthGrid::linear(0.4, 0.7, sample_size);
    std::vector<double> um{first};
    for (int i = 1; i < sample_size; ++i) {
        const double exact = first * std::pow(last / first, static_cast<double>(i) / (sample_size - 1));
        const double next = spectral::number_in(brief(exact));
        if (next > um.back() && next < last) um.push_back(next);
    }
    if (last > first) um.push_back(last);
    return spectral::WavelengthGrid::from_micrometres(std::move(um));
}

void sample(TableWriter& table, const OpticalConstants& material, const spectral::WavelengthGrid& grid,
            spectral::OutsideRange policy) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const RefractiveIndex index = material.index(grid[i], policy);
        std::string text;
        TableWriter::Row row{table, text};
        row.field(shortest(grid.micrometres()[i]))
            .field(shortest(index.n()))
            .field(shortest(index.k()))
            .end();
        table.add(text);
    }
    table.finish();
}

void describe(Output& output, Format format, const MaterialsOptions& options) {
    const OpticalConstants material = material_of(options.name);
    for (const std::string& warning : material.warnings()) std::cerr << "hts: " << warning << '\n';
    const auto grid =
        options.wavelengths.empty() ? sample_grid(material) : wavelengths_from_option(options.wavelengths);
    const std::string shortest_um = shortest(material.range().shortest);
    const std::string longest_um = shortest(material.range().longest);
    if (format == Format::json) {
        output.write("{\"name\": " + json_string(material.name()) + ",\n \"source\": " +
                     json_string(material.source()) + ",\n \"shortest_um\": " + shortest_um +
                     ",\n \"longest_um\": " + longest_um + ",\n \"index\": ");
    }
    TableWriter table{output, format, {"wavelength_um", "n", "k"}};
    sample(table, material, grid, options.outside.policy);
    if (format == Format::json) {
        output.write("}\n");
    } else {
        std::cerr << material.name() << ": " << material.source() << "\nrange " << shortest_um << " to "
                  << longest_um << " um\n";
    }
}

void run(const MaterialsOptions& options) {
    Output output{options.output.path};
    const Format format = format_of(options.output.path, options.output.json);
    if (!options.name.empty()) {
        describe(output, format, options);
    } else {
        TableWriter table{output, format, {"name", "shortest_um", "longest_um", "source"}};
        list(table);
    }
    output.commit();
}

}  // namespace

void add_materials(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("materials", "optical constants: list, or source, range and n, k of one");
    auto options = std::make_shared<MaterialsOptions>();
    auto* name = offers(reads_whole(verb->add_option("name", options->name, "built-in name or file")),
                        spectral::optical_constants_names());
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")->needs(name);
    options->outside.add_to(*verb);
    options->output.add_to(*verb);
    verb->footer(materials_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
