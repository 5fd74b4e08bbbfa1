// hts table chart: size against error of ways to tabulate a lobe.

#include <iostream>
#include <memory>

#include "bench/charts/table_sizes.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/output/gnuplot.hpp"

namespace hts::cli {
namespace {

constexpr auto chart_help = R"(
Builds tables of the material in five ways, each at six sizes, and measures the largest
error of each on the same random directions. A minute or two.

Example:
  hts table chart --material cli/data/rough-aluminium.json --plot table-sizes.svg)";

struct ChartOptions {
    MaterialOptions material;
    std::string wavelengths = "0.38:0.78:31", plot;
    std::size_t pairs = 20'000;
    std::uint64_t seed = 7;
    OutputOptions output;
};

void run(const ChartOptions& options) {
    const auto exact = options.material.read().at(
        wavelengths_from_option(options.wavelengths),
        {.tolerance = Tolerance{hts::accuracy::finest_lane_tolerance}, .outside = options.material.policy()});
    if (!options.plot.empty()) output::require_gnuplot(options.plot);
    const auto sizes = bench::table_sizes(exact, options.pairs, options.seed);
    Output output{options.output.path};
    TableWriter writer{
        output, format_of(options.output.path, options.output.json), {"way", "bytes", "largest_error"}};
    for (const bench::TableSize& size : sizes) {
        std::string text;
        TableWriter::Row row{writer, text};
        row.field(size.way).number(size.bytes).number(size.error).end();
        writer.add(text);
    }
    writer.finish();
    output.commit();
    if (!options.plot.empty()) output::draw(options.plot, bench::table_sizes_script(sizes, exact.name()));
}

}  // namespace

void add_table_chart(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("chart", "size against error of ways to tabulate, SVG by gnuplot");
    auto options = std::make_shared<ChartOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    verb->add_option(samples_names, options->pairs, "pairs of directions, 100 ... 1000000")
        ->check(whole_number(100, 1'000'000))
        ->capture_default_str();
    verb->add_option("--seed", options->seed, "of the random directions")
        ->check(seed_number())
        ->capture_default_str();
    draws(verb->add_option("--plot", options->plot, "draw the sizes as SVG (needs gnuplot)"));
    options->output.add_to(*verb);
    verb->footer(chart_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
