// hts table build: a table of a material, or one shard's part of it.

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/answers/validity_warning.hpp"
#include "cli/io/options.hpp"
#include "cli/io/summary.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/table/mpi.hpp"
#include "cli/verbs/table/table.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "tables/sharing/own_constants.hpp"
#include "tables/sharing/table_parts.hpp"

namespace hts::cli {
namespace {

constexpr auto build_help = R"(
The table keeps its error, |f - exact|/(exact + 1e-3 peak), within the tolerance at these
wavelengths and for polar angles up to 88 degrees, as measured on random directions.
Finished slices stand in FILE.slices meanwhile: a build that was interrupted goes on where
it ended. The bytes are the same for any number of threads, shards, ranks and interruptions.

Examples:
  hts table build --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:4 --tolerance 0.02 \
      --output m.htst
  hts table build --material cli/data/rough-aluminium.json --wavelengths 0.4:0.7:4 --tolerance 0.02 \
      --shard 1/2 --output part.1

--shard 2/2 makes the other part, and hts table merge joins them. In a build with -DHTS_MPI=ON:
  mpirun -n 4 hts table build ...
As a Slurm array, a shard for each task (tables/sharing/slurm.sh):
  sbatch --array=1-64 slurm.sh --material aluminium.json --wavelengths 0.38:0.78:31)";

struct BuildOptions {
    MaterialOptions material;
    std::string wavelengths = "0.38:0.78:41", output, shard = "1/1";
    tables::TableRequest request;
};

tables::TableShard shard_from_option(const std::string& text) {
    try {
        return tables::TableShard::from_text(text);
    } catch (const Error&) {
        throw UsageError{"--shard: " + spectral::in_quotes(text) + ": must be k/N, k from 1 to N"};
    }
}

/// Where a material that names files is found from any folder; others need no such place.
std::string path_for(const std::string& material, const std::string& path) {
    const bool names_files = material.find("\"file\"") != std::string::npos;
    return names_files ? std::filesystem::canonical(path).string() : path;
}

tables::TableJob job_from(const BuildOptions& options) {
    const auto grid = wavelengths_from_option(options.wavelengths);
    const auto reflector = options.material.read();
    if (options.material.policy() == spectral::OutsideRange::zero)
        throw UsageError{"--outside zero: must be error or hold, since a table holds logarithms"};
    const std::string& text = options.material.text();
    return {
        tables::with_own_constants(
            {reflector.name(), text, path_for(text, options.material.path), options.material.policy()}, grid),
        {grid.micrometres().begin(), grid.micrometres().end()},
        options.request};
}

void report(const std::string& path, double seconds) {
    const auto table = tables::Table::open(path);
    std::cerr << path << ": " << brief(static_cast<double>(table.bytes()) / 1048576.0, 3) << " MiB, error "
              << brief(table.info().error.largest, 3) << " of " << brief(table.info().tolerance) << ", "
              << brief(seconds, 3) << " s\n";
}

void run(const BuildOptions& options) {
    const tables::TableShard shard = shard_from_option(options.shard);
    const tables::TableJob job = job_from(options);
    const auto exact = tables::exact_model(job);
    Stopwatch watch;
    watch.start();
    Ranks ranks{exact, job};
    if (!ranks.first()) return;
    {
        constexpr std::size_t parts = 10'000;
        spectral::Job building{"", parts};
        std::string before;
        build_table_file(exact, job, options.output, shard, ranks.worker(),
                         [&](const std::string& step, double share) {
                             if (step != before) building.restart(before = step);
                             building.set_done(static_cast<std::size_t>(share * parts));
                         });
    }
    watch.stop();
    if (shard.count == 1) report(options.output, watch.seconds());
    warn_of_gain_of(exact, options.material.path);
}

}  // namespace

void add_table_build(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("build", "build a table of a material");
    auto options = std::make_shared<BuildOptions>();
    options->material.add_to(*verb)->required();
    verb->add_option(wavelengths_names, options->wavelengths, "first:last:count or a,b,c [um]")
        ->capture_default_str();
    verb->add_option("--tolerance", options->request.tolerance, "largest error, 1e-9 ... 0.5")
        ->check(number_within(1e-9, 0.5))
        ->capture_default_str();
    verb->add_flag("--mueller", options->request.polarised, "the Mueller matrix too (model he)");
    verb->add_option("--shard", options->shard, "compute part k of N only, as k/N");
    verb->add_option("--seed", options->request.seed, "of the directions it is measured on, 0 ... 2^52")
        ->check(whole_number(0, std::uint64_t{1} << 52))
        ->capture_default_str();
    verb->add_option("--largest-bytes", options->request.largest_bytes,
                     "stop where a table would be larger, 1024 ... 2^52")
        ->check(whole_number(1024, std::uint64_t{1} << 52))
        ->capture_default_str();
    writes(verb->add_option("--output,-o", options->output, "file to write"))
        ->each([](const std::string& path) {
            spectral::RunFiles::of_process()->will_continue(path + ".slices");
        })
        ->required();
    verb->footer(build_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
