#include "validation/scattering/dielectric_scattering.hpp"

#include <array>
#include <string>
#include <utility>

#include "hts/error.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

constexpr double index = 1.5;

std::vector<RoughnessStatistics> surfaces(Effort effort) {
    if (effort == Effort::quick) return {{0.25, 2}};
    return {{0.1, 1}, {0.25, 2}, {0.25, 1}, {0.5, 2}};
}

MomentSettings settings(Effort effort) {
    MomentSettings settings;
    settings.realisations = effort == Effort::quick ? 20 : 160;
    settings.length = effort == Effort::quick ? 24 : 40;
    settings.points_per_wavelength = 12;
    settings.index = RefractiveIndex{index, 0};
    return settings;
}

Section dielectric_section() {
    return {"dielectric-scattering",
            "Exact scattering by glass: the method of moments",
            prose("dielectric-scattering"),
            {},
            {},
            {},
            {},
            {}};
}

struct Column {
    const char* name;
    int digits;
};

/// What a reader wants of the map.
ReportTable distance_table(const FigureTable& map) {
    constexpr std::array columns{
        Column{"sigma0_over_lambda", 2}, Column{"tau_over_lambda", 0},   Column{"theta_i_deg", 0},
        Column{"energy_te", 4},          Column{"energy_tm", 4},         Column{"transmitted_te", 3},
        Column{"transmitted_tm", 3},     Column{"he_torrance_te_db", 2}, Column{"he_torrance_tm_db", 2},
        Column{"he_torrance_db", 2},     Column{"kirchhoff_db", 2},      Column{"smith_db", 2},
        Column{"chance_db", 2}};
    ReportTable table{
        "dielectric-distance",
        "Power accounted for and transmitted, and distances from the exact lobe [dB]: this model in TE, TM "
        "and unpolarised light, Kirchhoff and correlated Smith unpolarised, and what is chance.",
        {},
        {}};
    for (const Column& column : columns) table.columns.emplace_back(column.name);
    for (const auto& row : map.rows) {
        table.rows.emplace_back();
        for (const Column& column : columns)
            table.rows.back().push_back(rounded(row[column_of(map, column.name)], column.digits));
    }
    return table;
}

void add_dielectric_results(Section& section, const std::vector<FigureTable>& tables,
                            const std::string& provenance) {
    for (Check& check : dielectric_checks(tables)) section.checks.push_back(std::move(check));
    Figure figure = moment_lobe_figure(
        tables[1], {"of refractive index 1.5", {{0.1, 1}, {0.25, 2}, {0.25, 1}, {0.5, 2}}, {20, 60}, true});
    figure.caption.append(" ").append(provenance);
    section.figures.push_back(std::move(figure));
    section.tables = {distance_table(tables[0])};
}

}  // namespace

std::vector<Check> dielectric_checks(const std::vector<FigureTable>& tables) {
    std::vector<Check> checks = energy_checks(tables[0]);
    checks.push_back(nearer_check(tables[0], "on glass this model",
                                  "light that meets glass a second time is mostly transmitted, and so "
                                  "missing, as in the model"));
    checks.push_back(trend_check(tables, {"this model on glass", "he_torrance", 20}));
    return checks;
}

GroundTruth dielectric_scattering_study(Effort effort, const std::string& unfinished) {
    const MomentSettings settings = validation::settings(effort);
    std::vector<LitSurface> lit;
    for (const RoughnessStatistics& surface : surfaces(effort)) lit.push_back({surface, {20, 40, 60}});
    const auto results = moment_results(lit, settings, unfinished);
    return ground_truth(
        moment_provenance("of refractive index " + shortest(index), settings) +
            regenerating("dielectric", effort),
        {moment_map_table(results, "dielectric-map"), moment_lobe_table(results, "dielectric-lobes")},
        dielectric_section(), add_dielectric_results);
}

Section dielectric_scattering_section(Effort effort) {
    return section_of(dielectric_scattering_study(effort), effort, add_dielectric_results);
}

}  // namespace hts::validation
