// hts table lookup: values of a table at points.

#include <atomic>
#include <cstdint>
#include <iostream>
#include <memory>

#include "cli/answers/point_evaluator.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/transform.hpp"
#include "cli/verbs/table/table.hpp"
#include "hts/error.hpp"
#include "tables/table/between_wavelengths.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

constexpr auto lookup_help = R"(
Columns of the points, in any order: wavelength_um (or wavelength_nm), theta_i_deg,
phi_i_deg, theta_r_deg, phi_r_deg. Added: directional_diffuse, uniform_diffuse,
brdf [1/sr], specular_reflectance and diffuse_albedo [1], the last the share of light that
both diffuse terms reflect.
Between two wavelengths of the table ln f is taken as linear in ln wavelength; hts table
check measures what that costs. A wavelength beyond those of the table, or a polar angle
above 88 degrees, stops the run.

Examples:
  hts table build --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:4 --tolerance 0.02 \
      --output m.htst
  hts table lookup m.htst --points cli/data/points.csv --output values.csv)";

struct LookupOptions {
    std::string table, points;
    OutputOptions output;
};

struct Value {
    double lobe, uniform, specular, albedo;
    bool between;  // wavelengths of the table
};

Value value_at(const tables::Table& table, const DirectionPair& pair, double um) {
    if (!tables::Table::covers(pair))
        throw Error{"polar angle: must be at most 88 deg, where the table ends"};
    const tables::WavelengthPlace place = tables::place_among(table.wavelengths(), um);
    std::vector<double> values(table.wavelengths().size());
    const auto read = [&](auto&& write) {
        write();
        return place(values);
    };
    return {read([&] { table.directional_diffuse(pair, values); }),
            read([&] { table.uniform_diffuse(values); }),
            read([&] { table.specular_reflectance(pair.in, values); }),
            read([&] { table.diffuse_albedo(pair.in, values); }), place.between()};
}

void run(const LookupOptions& options) {
    const auto table = tables::Table::open(options.table);
    CsvReader input{options.points};
    const PairColumns directions{input};
    const spectral::WavelengthColumn wavelength = input.wavelength();
    std::vector<std::string> columns = input.columns();
    for (const char* added :
         {"directional_diffuse", "uniform_diffuse", "brdf", "specular_reflectance", "diffuse_albedo"}) {
        columns.emplace_back(added);
    }
    Output output{options.output.path};
    TableWriter writer{output, format_of(options.output.path, options.output.json), columns};
    std::atomic<std::uint64_t> between = 0;  // rows are written by many threads
    const Summary summary = Transform<Value>{input, writer, 1}.run(
        [&](const CsvRow& row, std::span<Value> value) {
            const double um = wavelength.micrometres(row.number(wavelength.place, wavelength.name()));
            value[0] = value_at(table, directions.pair(row), um);
        },
        [&](TableWriter::Row& row, const Value& value) {
            if (value.between) ++between;
            row.number(value.lobe).number(value.uniform).number(value.lobe + value.uniform);
            row.number(value.specular).number(value.albedo);
        });
    output.commit();
    std::cerr << summary.text() << '\n';
    if (between > 0) {
        std::cerr << options.table << ": " << between
                  << " values between its wavelengths: hts table check measures their error\n";
    }
}

}  // namespace

void add_table_lookup(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("lookup", "values of a table at points");
    auto options = std::make_shared<LookupOptions>();
    reads(verb->add_option("table", options->table, "file to read"))->required();
    reads(verb->add_option("--points", options->points, "CSV with a header, - for standard input"))
        ->required();
    options->output.add_to(*verb);
    verb->footer(lookup_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
