// hts chart: speed against accuracy of every way to compute Phi, measured here and drawn.

#include <filesystem>
#include <iostream>
#include <memory>

#include "bench/charts/chart.hpp"
#include "bench/charts/chart_script.hpp"
#include "bench/charts/chart_tables.hpp"
#include "cli/answers/charts/model_chart.hpp"
#include "cli/answers/charts/truth_chart.hpp"
#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/output/gnuplot.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto chart_help = R"(
Measures every way to compute Phi(g, t) on this machine: fixed, adaptive and windowed
series, the rough limit (Beckmann's lobe), the saddle point of order 0, 1 and 2, the
spline of He et al. 1992, GGX, single precision, and this library at each tolerance, one
at a time and in batches. Errors are against 50 digits; the sweep of errors uses all
cores, the times one: keep the machine quiet. Some minutes, with --quick under one.

Into the folder go, each with .csv and .json (the numbers) and .gnuplot (the script):
  error-against-time.svg   worst, 99.9 % and energy-weighted error against time, in six
                           regimes; a method that fails stands in the grey band on top
  error-maps.svg           the error over the plane of g and t/g, a map per method
  cost-against-g.svg       the time against g
Nothing is written before all is measured.

--models measures something else: every model of the library, fitted to He-Torrance on four
surfaces, He-Torrance's own limits, and lookup tables of it; error against time, with marks
as large as the tables that a method reads, into models.svg. Minutes.

--truth shows what a finer tolerance, a cheaper method and another model bring: the distance
[dB] of each from the kept exact scattering of perfect conductors (hts truth models), in TE,
TM and unpolarised light, beside the time of an evaluation, into truth.svg. A minute.

Examples:
  hts chart --output out/charts --quick
  hts chart --output out/charts --seed 7
  hts chart --output out/models --models --quick
  hts chart --output out/truth --truth)";

struct ChartOptions {
    std::string folder;
    bool quick = false, models = false, truth = false;
    std::uint64_t seed = 1;
};

/// Each step by its name; those before it are done.
bench::ChartProgress progress(std::size_t steps) {
    return [job = std::make_shared<spectral::Job>("", steps),
            done = std::size_t{0}](const std::string& step) mutable {
        job->set_step(step);
        job->set_done(done++);
    };
}

/// The picture and what stands beside it.
void write_chart(const fs::path& path, const bench::ChartTable& table, const std::string& script) {
    output::require_gnuplot(path.string());
    write_file(fs::path{path}.replace_extension(".csv").string(), table.csv());
    write_file(fs::path{path}.replace_extension(".json").string(), table.json());
    output::draw(path.string(), script);
    std::cout << path.string() << '\n';
}

void run(const ChartOptions& options) {
    const fs::path folder{options.folder};
    if (options.models) {
        const ModelChart chart = measured_models(options.quick, options.seed, progress(model_chart_steps()));
        std::cout << write_figure(folder, model_figure(chart), true).string() << '\n';
        return;
    }
    if (options.truth) {
        const TruthChart chart = measured_truth(options.seed, progress(truth_chart_steps()));
        std::cout << write_figure(folder, truth_figure(chart), true).string() << '\n';
        return;
    }
    const auto settings =
        options.quick ? bench::ChartSettings::quick(options.seed) : bench::ChartSettings::full(options.seed);
    const bench::ChartData data = bench::measured_charts(settings, progress(bench::chart_steps));
    write_chart(folder / "error-against-time.svg", bench::accuracy_table(data),
                bench::error_time_script(data));
    write_chart(folder / "error-maps.svg", bench::map_table(data), bench::error_map_script(data));
    write_chart(folder / "cost-against-g.svg", bench::cost_table(data), bench::cost_script(data));
}

}  // namespace

void add_chart(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("chart", "speed against accuracy of every method, SVG by gnuplot");
    auto options = std::make_shared<ChartOptions>();
    fills(verb->add_option("-o,--output", options->folder, "folder for pictures and tables"))->required();
    verb->add_flag("--quick", options->quick, "fewer points, in less than a minute");
    verb->add_flag("--models", options->models, "instead: every model, fitted to He-Torrance");
    verb->add_flag("--truth", options->truth, "instead: the models against exact scattering")
        ->excludes("--models");
    verb->add_option("--seed", options->seed, "of the random points")
        ->capture_default_str()
        ->check(seed_number());
    verb->footer(chart_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
