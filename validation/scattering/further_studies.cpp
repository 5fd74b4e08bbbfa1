#include "validation/scattering/further_studies.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hts::validation {
namespace {

const RefractiveIndex metal{0.16, 3.6};

void add_energy_checks(Section& section, const std::vector<FigureTable>& tables, const std::string&) {
    for (Check& check : energy_checks(tables[0])) section.checks.push_back(std::move(check));
}

/// A study by the method of moments that is judged by its energy alone; models are compared with
/// what it found elsewhere.
struct MomentStudy {
    const char* name;
    std::string what;
    MomentSettings settings;
    std::vector<LitSurface> surfaces;
};

GroundTruth computed(const MomentStudy& study, Effort effort, const std::string& unfinished) {
    const auto results = moment_results(study.surfaces, study.settings, unfinished);
    const std::string stem = study.name;
    return ground_truth(
        moment_provenance(study.what, study.settings) + regenerating(stem, effort),
        {moment_map_table(results, stem + "-map"), moment_lobe_table(results, stem + "-lobes")},
        {stem, study.what, "", {}, {}, {}, {}, {}}, add_energy_checks);
}

/// Few and short for a quick look.
MomentSettings settings(Effort effort, int realisations, double length, int points_per_wavelength) {
    MomentSettings settings;
    settings.realisations = effort == Effort::quick ? 20 : realisations;
    settings.length = effort == Effort::quick ? std::min(length, 16.0) : length;
    settings.points_per_wavelength = points_per_wavelength;
    return settings;
}

std::vector<LitSurface> first_of(std::vector<LitSurface> surfaces, Effort effort, std::size_t quick) {
    if (effort == Effort::quick) surfaces.resize(quick);
    return surfaces;
}

double to_decimals(double value, double decimals) {
    const double scale = std::pow(10, decimals);
    return std::round(value * scale) / scale;
}

/// Even numbers from 0 to 1 of a surface, and what is made of them.
class Drawn {
  public:
    Drawn(std::uint64_t seed, std::size_t surface) : seed_{seed}, surface_{surface} {}

    [[nodiscard]] double uniform(std::uint64_t number) const {
        return static_cast<double>(seed_of(seed_, surface_, number) >> 11U) * 0x1p-53;
    }
    /// One in each third of 10 to 75 degrees, by the numbers 2 to 4.
    [[nodiscard]] std::vector<double> theta_i_deg() const {
        std::vector<double> angles;
        for (const int third : {0, 1, 2})
            angles.push_back(
                to_decimals(10 + 65 * (third + uniform(2 + static_cast<std::uint64_t>(third))) / 3, 1));
        return angles;
    }

  private:
    std::uint64_t seed_;
    std::size_t surface_;
};

/// A material whose discretisation is refined.
struct Refined {
    MomentSettings settings;
    RoughnessStatistics surface;
};

/// rms of the differences of two lobes [dB], weighted with the energy.
double lobe_difference(const MomentResult& a, const MomentResult& b) {
    double weight = 0, squares = 0;
    for (std::size_t i = 0; i < a.bins.size(); ++i) {
        const double one = a.bins[i].exact, other = b.bins[i].exact;
        if (!(one > 0 && other > 0)) continue;
        const double difference = 10 * std::log10(one / other);
        weight += other;
        squares += other * difference * difference;
    }
    return std::sqrt(squares / weight);
}

void add_refinement_checks(Section& section, const std::vector<FigureTable>& tables, const std::string&) {
    double worst = 0;
    for (const char* column : {"te_db", "tm_db"}) {
        for (const auto& row : tables[0].rows) worst = std::max(worst, row[column_of(tables[0], column)]);
    }
    section.checks.push_back(
        {"twice the points per wavelength move the exact lobe of a rough surface by at most 0.1 dB",
         rounded(worst, 3) + " dB at worst", worst <= 0.1});
}

}  // namespace

std::vector<LitSurface> drawn_surfaces(std::uint64_t seed, std::size_t count) {
    std::vector<LitSurface> surfaces;
    for (std::size_t i = 0; i < count; ++i) {
        const Drawn drawn{seed, i};
        const double length = to_decimals(0.5 * std::pow(12, drawn.uniform(0)), 3);
        const double roughness = to_decimals(0.05 * std::pow(8, drawn.uniform(1)) * length, 4);
        surfaces.push_back({{roughness, length}, drawn.theta_i_deg()});
    }
    return surfaces;
}

std::vector<LitSurface> drawn_k_correlated(std::uint64_t seed, std::size_t count) {
    std::vector<LitSurface> surfaces;
    for (std::size_t i = 0; i < count; ++i) {
        const Drawn drawn{seed, i};
        const double length = to_decimals(0.5 * std::pow(8, drawn.uniform(0)), 3);
        const double roughness = to_decimals(0.05 * std::pow(5, drawn.uniform(1)), 4);
        surfaces.push_back({{roughness, length, i % 2 == 0 ? 0.5 : 1.5}, drawn.theta_i_deg()});
    }
    return surfaces;
}

GroundTruth unseen_study(Effort effort, const std::string& unfinished) {
    MomentSettings chosen = settings(effort, 150, 50, 10);
    chosen.study = 2026;
    return computed({"unseen", "perfectly conducting, surfaces drawn by chance", chosen,
                     first_of(drawn_surfaces(2026, 14), effort, 2)},
                    effort, unfinished);
}

GroundTruth k_correlation_study(Effort effort, const std::string& unfinished) {
    MomentSettings chosen = settings(effort, 100, 40, 16);
    chosen.study = 2027;
    return computed(
        {"k-correlation",
         "perfectly conducting, K-correlated, nu 1/2 and 3/2, spectra cut beyond 2.5 per wavelength, "
         "surfaces drawn by chance",
         chosen, first_of(drawn_k_correlated(2027, 8), effort, 2)},
        effort, unfinished);
}

GroundTruth metal_study(Effort effort, const std::string& unfinished) {
    MomentSettings chosen = settings(effort, 160, 24, 30);
    chosen.index = metal;
    const std::vector<double> angles{20, 40, 60};
    return computed({"metal", "a metal of refractive index 0.16 + 3.6i", chosen,
                     first_of({{{0.1, 1}, angles}, {{0.25, 1}, angles}, {{0.25, 2}, angles}}, effort, 1)},
                    effort, unfinished);
}

GroundTruth grazing_study(Effort effort, const std::string& unfinished) {
    const std::vector<double> angles{60, 70};
    return computed({"grazing", "perfectly conducting, long profiles", settings(effort, 60, 120, 10),
                     first_of({{{0.05, 2}, angles}, {{0.1, 2}, angles}, {{0.1, 4}, angles}}, effort, 1)},
                    effort, unfinished);
}

GroundTruth refinement_study(Effort effort) {
    MomentSettings conductor = settings(effort, 20, 24, 10), glass = settings(effort, 20, 24, 12),
                   gold = settings(effort, 20, 12, 30);
    glass.index = RefractiveIndex{1.5, 0};
    gold.index = metal;
    std::vector<Refined> all{{conductor, {0.5, 1}}, {glass, {0.25, 1}}, {glass, {0.5, 2}}, {gold, {0.25, 1}}};
    if (effort == Effort::quick) all.resize(1);
    FigureTable table{"refinement",
                      {"index_n", "index_k", "sigma0_over_lambda", "tau_over_lambda", "theta_i_deg",
                       "points_per_wavelength", "te_db", "tm_db", "energy_te", "energy_tm", "fine_energy_te",
                       "fine_energy_tm", "mirror_te", "mirror_tm", "fine_mirror_te", "fine_mirror_tm"},
                      {}};
    for (const auto& [coarse, surface] : all) {
        MomentSettings fine = coarse;
        fine.points_per_wavelength *= 2;
        MomentSettings skipped = coarse;
        skipped.drawn_between = 2;
        const std::vector<LitSurface> lit{{surface, {20, 60}}};
        const auto few = moment_results(lit, skipped), many = moment_results(lit, fine);
        for (std::size_t i = 0; i + 2 < few.size(); i += 3) {
            const RefractiveIndex index = coarse.index.value_or(RefractiveIndex{1e20, 1e20});
            table.rows.push_back({index.n(), index.k(), surface.rms_roughness, surface.correlation_length,
                                  few[i].of.theta_i_deg, static_cast<double>(coarse.points_per_wavelength),
                                  lobe_difference(few[i], many[i]), lobe_difference(few[i + 1], many[i + 1]),
                                  few[i].energy, few[i + 1].energy, many[i].energy, many[i + 1].energy,
                                  few[i].mirror, few[i + 1].mirror, many[i].mirror, many[i + 1].mirror});
        }
    }
    return ground_truth(
        "Exact scattering by the same random profiles at the points of the studies and at twice as many, 20 "
        "realisations" +
            regenerating("refinement", effort),
        {table}, {"refinement", "What twice the points change", "", {}, {}, {}, {}, {}},
        add_refinement_checks);
}

}  // namespace hts::validation
