// hts truth: the model against ground truth that knows nothing of its closed forms.

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "cli/answers/validation_parts.hpp"
#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "spectral/text/output.hpp"
#include "validation/report/recorded.hpp"
#include "validation/scattering/dielectric_scattering.hpp"
#include "validation/scattering/exact_scattering.hpp"
#include "validation/scattering/fourier/fourier_integral.hpp"
#include "validation/scattering/further_studies.hpp"
#include "validation/scattering/rays/ray_report.hpp"
#include "validation/scattering/twins/model_distances.hpp"
#include "validation/scattering/vector/vector_report.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto truth_help = R"(
Studies:
  moments        Exact scattering by random profiles: perfect conductors, TE and
                 TM, by the method of moments. Writes the map of the distance
                 [dB] of this model, of Kirchhoff and of Smith's shadowing, over
                 sigma0/lambda, tau/lambda and theta_i, and the lobes.
  dielectric     The same for glass, refractive index 1.5, on four surfaces.
  unseen         Conductors that no constant of a model was chosen by: 14
                 surfaces drawn by a seed, at three angles each, 150 profiles.
  k-correlation  8 K-correlated conductors drawn by a seed, nu 1/2 (exponential)
                 and 3/2, spectra cut beyond 2.5 per wavelength, at three angles
                 each, 100 profiles.
  metal          A metal, refractive index 0.16 + 3.6i, on three surfaces, 160
                 profiles.
  grazing        Smooth conductors at 60 and 70 degrees on profiles of 120
                 wavelengths.
  refinement     The same rough profiles by twice the points per wavelength.
  vector         Exact scattering by surfaces that are rough in both directions,
                 perfect conductors, polarised: s and p into s and p, in the
                 plane of incidence and out of it, on six surfaces at 20, 40 and
                 60 degrees. Takes hours.
  models         What is kept of the studies above, in seconds: he beside
                 he_unified, in TE, TM and unpolarised light; where he_unified
                 is further off; the mirrors; then all models against the
                 surfaces of vector.
  fourier        Kirchhoff's integral summed over explicit surfaces and
                 averaged, against the directional-diffuse term before
                 shadowing.
  rays           Rays through explicit surfaces of mirrors: shadowing, the lobe
                 of the rough limit, and the light reflected more than once.

Into the folder go the tables (.csv, with the command that writes them) and the pictures
(.svg, .gnuplot). On one core metal takes some 10 minutes, moments 8, grazing 5, dielectric,
unseen and k-correlation 4, the others one or two; with --quick each takes some seconds.
The numbers are the same for any number of threads. A study by moments that is stopped goes
on where it ended: what is solved stands in STUDY.unfinished until the tables do.

vector keeps every realisation in a file of the folder vector.parts, so that it goes on where
it was stopped. --shard k/N solves every N-th of them, on as many machines as one likes; the
files of all go into one folder. --collect makes the tables of what is there, and solves
nothing. --side 24 takes a wider square and a wider beam, in 3 times the time.

A check that the model misses is a finding; exit code 1 if a result contradicts the one
recorded with the program (see hts validate --help).

Examples:
  hts truth rays --quick --output out/truth
  hts truth models --output out/truth
  hts truth vector --quick --output out/truth)";

using validation::Effort;

struct Truth {
    const char* name;
    /// The file that takes what is solved is for the studies that take long.
    validation::GroundTruth (*study)(Effort, const std::string& unfinished);
};

constexpr std::array studies{
    Truth{"moments", validation::exact_scattering_study},
    Truth{"dielectric", validation::dielectric_scattering_study},
    Truth{"unseen", validation::unseen_study},
    Truth{"k-correlation", validation::k_correlation_study},
    Truth{"metal", validation::metal_study},
    Truth{"grazing", validation::grazing_study},
    Truth{"vector", [](Effort, const std::string&) { return validation::quick_vector_study(); }},
    Truth{"models",
          [](Effort effort, const std::string&) { return validation::model_distance_study(effort); }},
    Truth{"refinement",
          [](Effort effort, const std::string&) { return validation::refinement_study(effort); }},
    Truth{"fourier", [](Effort effort, const std::string&) { return validation::fourier_study(effort); }},
    Truth{"rays", [](Effort effort, const std::string&) { return validation::rays_study(effort); }}};

struct TruthOptions {
    std::string study, folder;
    bool quick = false;
    std::string shard;
    std::size_t realisations = 100;
    double side = validation::vector_side;
    bool collect = false;

    /// Whether the long study of surfaces is meant, whose options no other study has.
    [[nodiscard]] bool long_vector() const { return study == "vector" && !quick; }
    /// Whether what comes out is what the program is recorded to find.
    [[nodiscard]] bool is_recorded() const { return side == validation::vector_side; }
};

/// The caption, then columns of equal width.
void print(const validation::ReportTable& table) {
    std::vector<std::size_t> widths(table.columns.size());
    auto rows = table.rows;
    rows.insert(rows.begin(), table.columns);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::cout << '\n' << table.caption << "\n\n";
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string blanks(widths[i] - row[i].size(), ' ');
            line += (i == 0 ? "" : "  ") + (i == 0 ? row[i] + blanks : blanks + row[i]);
        }
        std::cout << line << '\n';
    }
}

/// Every check on a line.
void report(const std::vector<validation::Check>& checks) {
    for (const validation::Check& check : checks) {
        std::cout << (check.passed ? "met     " : "missed  ") << check.claim << ": " << check.measured
                  << (check.remark.empty() ? "" : " (" + check.remark + ")") << '\n';
    }
}

/// What of the vector study is solved here.
tables::TableShard shard_of(const TruthOptions& options) {
    const TruthOptions unasked;
    const bool of_vector = options.collect || !options.shard.empty() || !options.is_recorded() ||
                           options.realisations != unasked.realisations;
    if (of_vector && !options.long_vector()) {
        throw UsageError{
            "--shard, --collect, --side and --realisations are of hts truth vector without --quick"};
    }
    if (!(options.side >= 9 && options.side <= 60))
        throw UsageError{"--side " + shortest(options.side) +
                         " wavelengths: must be from 9 to 60 wavelengths"};
    constexpr std::size_t fewest = validation::fewest_vector_realisations, most = 10000;
    if (options.realisations < fewest || options.realisations > most)
        throw UsageError{"--realisations " + std::to_string(options.realisations) + ": must be from " +
                         std::to_string(fewest) + " to " + std::to_string(most)};
    if (options.shard.empty()) return {};
    if (options.collect)
        throw UsageError{"--collect takes what all shards have solved, so it goes without --shard"};
    return from_option("--shard", [&] { return tables::TableShard::from_text(options.shard); });
}

void run(const TruthOptions& options) {
    const tables::TableShard shard = shard_of(options);
    const fs::path folder{options.folder};
    const auto effort = options.quick ? validation::Effort::quick : validation::Effort::full;
    validation::GroundTruth truth;
    const std::string unfinished =
        options.quick ? std::string{} : (folder / (options.study + ".unfinished")).string();
    if (!unfinished.empty()) fs::create_directories(folder);
    if (options.long_vector()) {
        const fs::path parts = folder / "vector.parts";
        if (!options.collect)
            validation::solve_vector_realisations(parts, shard, options.side, options.realisations);
        if (shard.count > 1) {
            std::cout << parts.string() << '\n';
            return;
        }
        truth = validation::vector_study(parts, options.side);
    } else {
        for (const Truth& each : studies) {
            if (options.study == each.name) truth = each.study(effort, unfinished);
        }
    }
    if (options.study == "models") {
        auto [by_case, of_all_models] = validation::kept_vector_distances();
        truth.tables.push_back(std::move(by_case));
        for (auto& table : of_all_models) truth.section.tables.push_back(std::move(table));
    }
    if (options.quick) mark_as_quick(truth.section.checks);
    for (const validation::FigureTable& table : truth.tables) {
        const auto path = (folder / (table.stem + ".csv")).string();
        spectral::write_file(path, validation::table_csv(table, truth.provenance));
        std::cout << path << '\n';
    }
    for (const validation::Figure& figure : truth.section.figures)
        std::cout << write_figure(folder, figure).string() << '\n';
    if (!unfinished.empty()) fs::remove(unfinished);
    for (const validation::ReportTable& table : truth.section.tables) print(table);
    if (!truth.section.tables.empty()) std::cout << '\n';
    report(truth.section.checks);
    if (!options.is_recorded()) return;
    require_as_recorded(validation::Record::kept().contradictions({truth.section}, effort),
                        "truth " + options.study);
}

}  // namespace

void add_truth(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("truth", "the model against exact and explicit scattering");
    auto options = std::make_shared<TruthOptions>();
    std::vector<std::string> names;
    names.reserve(studies.size());
    for (const Truth& each : studies) names.emplace_back(each.name);
    one_of(verb->add_option("study", options->study, "which"), names)->required();
    fills(verb->add_option("-o,--output", options->folder, "folder for tables and pictures"))->required();
    verb->add_flag("--quick", options->quick, "few cases and realisations");
    verb->add_option("--shard", options->shard, "of vector: the k-th of N shares, k/N");
    verb->add_option("--realisations", options->realisations, "of vector: of each surface")
        ->capture_default_str();
    verb->add_option("--side", options->side, "of vector: of the square, in wavelengths")
        ->capture_default_str();
    verb->add_flag("--collect", options->collect, "of vector: tables of what is solved so far");
    verb->footer(truth_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
