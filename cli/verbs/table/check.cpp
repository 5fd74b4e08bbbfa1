// hts table check: the error of a table, measured anew against the exact model.

#include <algorithm>
#include <limits>
#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/table.hpp"
#include "hts/error.hpp"
#include "tables/sharing/table_parts.hpp"
#include "tables/table/between_wavelengths.hpp"

namespace hts::cli {
namespace {

constexpr auto check_help = R"(
The exact model is built from the material that the table holds, with the optical constants
it was built from, whatever has become of their file. Exit code 1 where the
largest error is above the tolerance that the table promises. between_median,
between_percentile_99 and between_largest are errors half-way between the table's
wavelengths, where hts table lookup interpolates and nothing is promised, measured on at
most 20000 of the pairs; nan of a table of one wavelength.

Example:
  hts table check m.htst --samples 200000 --seed 7)";

struct CheckOptions {
    std::string table;
    std::uint64_t samples = 200'000, seed = 7;
    OutputOptions output;
};

/// Half-way between the table's wavelengths.
tables::TableError error_between(const tables::Table& table, const CheckOptions& options) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto middles = tables::half_way(table.wavelengths());
    if (!middles) return {nan, nan, nan};
    const auto exact = tables::exact_model(table.info().source, middles->micrometres());
    return tables::table_error(tables::at_wavelengths(table.reflectance(), *middles), exact,
                               std::min<std::uint64_t>(options.samples, 20'000), options.seed);
}

void run(const CheckOptions& options) {
    const auto table = tables::Table::open(options.table);
    const auto& info = table.info();
    const auto exact = tables::exact_model(info.source, info.wavelengths.micrometres());
    const auto error = tables::table_error(table.reflectance(), exact, options.samples, options.seed);
    const auto between = error_between(table, options);
    Output output{options.output.path};
    TableWriter writer{output,
                       format_of(options.output.path, options.output.json),
                       {"table", "pairs", "wavelengths", "seed", "median", "percentile_99", "largest",
                        "tolerance", "bytes", "between_median", "between_percentile_99", "between_largest"}};
    std::string text;
    TableWriter::Row row{writer, text};
    row.field(options.table)
        .field(std::to_string(error.pairs))
        .field(std::to_string(info.wavelengths.size()));
    row.field(std::to_string(error.seed))
        .number(error.median)
        .number(error.percentile_99)
        .number(error.largest);
    row.number(info.tolerance).field(std::to_string(table.bytes()));
    row.number(between.median).number(between.percentile_99).number(between.largest).end();
    writer.add(text);
    writer.finish();
    output.commit();
    if (error.largest > info.tolerance) {
        throw CheckFailed{options.table + ": largest error " + brief(error.largest) +
                          ": must be at most the tolerance " + brief(info.tolerance)};
    }
}

}  // namespace

void add_table_check(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("check", "measure the error of a table against the exact model");
    auto options = std::make_shared<CheckOptions>();
    constexpr std::uint64_t most = 100'000'000;
    reads(verb->add_option("table", options->table, "file to check"))->required();
    verb->add_option(samples_names, options->samples, "pairs of directions, 1 ... 100000000")
        ->check(whole_number(1, most))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of the random directions")
        ->check(seed_number())
        ->capture_default_str();
    options->output.add_to(*verb);
    verb->footer(check_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
