#include "validation/scattering/vector/vector_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "validation/report/prose.hpp"
#include "validation/scattering/vector/vector_distances.hpp"

namespace hts::validation {
namespace {

/// The models that say how much a mirror keeps.
constexpr std::array mirror_models{VectorModel::kirchhoff, VectorModel::he, VectorModel::he_unified};
constexpr double degree = std::numbers::pi / 180, drawn_theta_i_deg = 40;

/// The short correlation lengths by more points.
std::vector<VectorSurface> surfaces() {
    return {{0.05, {0.5, 0.5}, 6}, {0.15, {0.5, 0.5}, 6}, {0.2, {1, 1}, 5},
            {0.3, {1, 1}, 5},      {0.5, {2, 2}, 5},      {0.2, {2, 1}, 5}};
}

VectorSettings settings_of(double side) {
    VectorSettings settings;
    settings.length = side;
    return settings;
}

VectorSettings quick_settings() {
    VectorSettings settings = settings_of(10);
    settings.theta_i_deg = {40};
    return settings;
}

std::vector<VectorRealisation> solved(const std::filesystem::path& parts, const VectorSurface& surface,
                                      const VectorSettings& settings, std::size_t most) {
    std::vector<VectorRealisation> all;
    for (std::size_t number = 0; number < most; ++number) {
        const RealisationFile file{parts, surface, settings, number};
        if (file.exists()) all.push_back(file.read());
    }
    return all;
}

FigureTable map_table(const std::vector<VectorResult>& results, const VectorSettings& settings) {
    FigureTable table{"vector-map", case_columns(), {}};
    table.columns.insert(
        table.columns.end(),
        {"points_per_wavelength", "realisations", "iterations", "energy_s", "energy_p", "energy_error_s",
         "energy_error_p", "mirror_s", "mirror_p", "kirchhoff_against_closed_form_db", "gain_of_control"});
    for (const VectorModel model : mirror_models) {
        for (const char* state : {"_s", "_p"})
            table.columns.push_back("mirror_" + std::string{name(model)} + state);
    }
    for (const VectorResult& result : results) {
        const VectorSurface& surface = result.of.surface;
        std::vector<double> row = case_row(result.of, settings);
        row.insert(row.end(), {static_cast<double>(surface.points_per_wavelength),
                               static_cast<double>(result.realisations), result.iterations, result.energy[0],
                               result.energy[1], result.energy_error[0], result.energy_error[1],
                               result.mirror[0], result.mirror[1], result.kirchhoff_db, result.gain});
        const double width = settings.beam_width();
        const PlaneWaveBeam beam{result.of.theta_i_deg * degree, result.of.azimuth_deg * degree, width,
                                 4 * width, 0.03};
        const auto mirrors = ClosedForms{surface.surface()}.mirrors(beam);
        for (const VectorModel model : mirror_models) {
            const auto& of = mirrors[static_cast<std::size_t>(model)];
            row.insert(row.end(), of.begin(), of.end());
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Check energy_check(const FigureTable& map) {
    double worst = 0;
    for (const char* column : {"energy_s", "energy_p"}) {
        for (const auto& row : map.rows) worst = std::max(worst, std::fabs(row[column_of(map, column)] - 1));
    }
    return {"what a rough surface scatters upwards is all that falls in, to 1 %",
            rounded(100 * worst, 2) + " % at worst", worst <= 0.01,
            "the rest runs along the surface and passes the edges of the patch", 0.05};
}

/// In how many cases one model is nearer than another.
Check nearer_check(const std::vector<ComparedLobe>& lobes, VectorLight light) {
    std::size_t nearer = 0;
    for (const ComparedLobe& lobe : lobes) {
        if (lobe.distance_of(VectorModel::he_unified, light, VectorRegion::all).rms <
            lobe.distance_of(VectorModel::he, light, VectorRegion::all).rms)
            ++nearer;
    }
    return {"he_unified is nearer to exact scattering by rough surfaces than he, " +
                std::string{name(light)} + " light",
            "in " + std::to_string(nearer) + " of " + std::to_string(lobes.size()) + " cases",
            nearer == lobes.size()};
}

void add_results(Section& section, const std::vector<FigureTable>& tables, const std::string& provenance) {
    const auto lobes = compared(tables[1]);
    section.checks.push_back(energy_check(tables[0]));
    for (const VectorLight light : vector_lights) section.checks.push_back(nearer_check(lobes, light));
    section.tables = {vector_summary_table(lobes), vector_case_table(lobes)};
    for (Figure figure : {vector_map_figure(lobes), vector_lobe_figure(lobes, drawn_theta_i_deg)}) {
        figure.caption.append(" ").append(provenance);
        section.figures.push_back(std::move(figure));
    }
}

Section empty_section() {
    return {"vector-scattering",
            "Exact scattering by rough surfaces, polarised",
            prose("vector-scattering"),
            {},
            {},
            {},
            {},
            {}};
}

GroundTruth study(const std::vector<VectorResult>& results, const VectorSettings& settings, Effort effort) {
    int fewest = results[0].realisations, most = fewest;
    for (const VectorResult& result : results) {
        fewest = std::min(fewest, result.realisations);
        most = std::max(most, result.realisations);
    }
    const std::string count =
        fewest == most ? std::to_string(most) : std::to_string(fewest) + " to " + std::to_string(most);
    const bool other = effort == Effort::full && settings.length != vector_side;
    const std::string side = other ? " --side " + shortest(settings.length) : "";
    return ground_truth(
        "Exact scattering by rough surfaces of a perfect conductor: magnetic-field integral equation, " +
            count + " realisations, a square of " + shortest(settings.length) +
            " wavelengths, Gaussian beam of a sixth, Kirchhoff's currents as control variate, seeds from " +
            std::to_string(settings.study) + regenerating("vector" + side, effort),
        {map_table(results, settings), vector_lobe_table(results, settings)}, empty_section(), add_results);
}

}  // namespace

void solve_vector_realisations(const std::filesystem::path& parts, const tables::TableShard& shard,
                               double side, std::size_t realisations) {
    std::filesystem::create_directories(parts);
    const VectorSettings settings = settings_of(side);
    const auto all = surfaces();
    const auto own = shard.slices(all.size() * realisations);
    const spectral::Job job{"solving realisations", own.size()};
    for (const std::size_t i : own) {
        const std::size_t number = i / all.size();
        // every shard has its turn at every surface
        const VectorSurface& surface = all[(i + number) % all.size()];
        const RealisationFile file{parts, surface, settings, number};
        if (!file.exists()) file.write(realisation(surface, settings, number));
        job.done();
    }
}

GroundTruth vector_study(const std::filesystem::path& parts, double side) {
    constexpr std::size_t most = 10000;
    const VectorSettings settings = settings_of(side);
    std::vector<VectorResult> results;
    for (const VectorSurface& surface : surfaces()) {
        const auto all = solved(parts, surface, settings, most);
        if (all.size() < fewest_vector_realisations)
            throw Error{parts.string() + ": " + std::to_string(all.size()) +
                        " realisations of the surface sigma0 " + shortest(surface.rms_roughness) + ", tau " +
                        shortest(surface.lengths.along) + " x " + shortest(surface.lengths.across) +
                        ": must be at least " + std::to_string(fewest_vector_realisations)};
        for (VectorResult& each : vector_results(surface, settings, all)) results.push_back(std::move(each));
    }
    return study(results, settings, Effort::full);
}

GroundTruth quick_vector_study() {
    const VectorSettings settings = quick_settings();
    const VectorSurface surface{0.2, {1, 1}};
    std::vector<VectorRealisation> all;
    for (std::size_t number = 0; number < 6; ++number) all.push_back(realisation(surface, settings, number));
    return study(vector_results(surface, settings, all), settings, Effort::quick);
}

Section vector_section(Effort effort) {
    if (effort == Effort::quick) return section_of(quick_vector_study(), effort, add_results);
    const std::vector<FigureTable> kept{kept_table("vector-map"), kept_table("vector-lobes")};
    Section section = empty_section();
    add_results(section, kept, kept_provenance("vector-map"));
    return section;
}

KeptVectorDistances kept_vector_distances() {
    const auto lobes = compared(kept_table("vector-lobes"));
    return {vector_distance_table(lobes), {vector_summary_table(lobes), vector_case_table(lobes)}};
}

}  // namespace hts::validation
