#include "validation/dielectric_scattering.hpp"

#include <array>
#include <string>
#include <utility>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

constexpr double index = 1.5;

std::vector<RoughnessStatistics> surfaces(Effort effort) {
    if (effort == Effort::quick) return {{0.1, 1}};
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

Section section() {
    return {
        "dielectric-scattering",
        "Exact scattering by glass: the method of moments",
        "The same random profiles as a ground of refractive index 1.5: coupled integral equations above and "
        "below it, TE and TM. The closed forms are those of the conductor times Fresnel's reflectance at "
        "theta_d, as in the model.",
        {},
        {},
        {},
        {},
        {}};
}

void add_results(Section& section, const std::vector<FigureTable>& tables, const std::string& provenance) {
    for (Check& check : energy_checks(tables[0])) section.checks.push_back(std::move(check));
    Figure figure = moment_lobe_figure(
        tables[1], {"of refractive index 1.5", {{0.1, 1}, {0.25, 2}, {0.25, 1}, {0.5, 2}}, {20, 60}});
    figure.caption.append(" ").append(provenance);
    section.figures.push_back(std::move(figure));
}

}  // namespace

GroundTruth dielectric_scattering_study(Effort effort) {
    const MomentSettings settings = validation::settings(effort);
    std::vector<MomentResult> results;
    for (const RoughnessStatistics& surface : surfaces(effort)) {
        const auto some = moment_results(surface, {20, 40, 60}, settings);
        results.insert(results.end(), some.begin(), some.end());
    }
    GroundTruth truth{
        moment_provenance("of refractive index " + shortest(index), settings) +
            regenerating("dielectric", effort),
        {moment_map_table(results, "dielectric-map"), moment_lobe_table(results, "dielectric-lobes")},
        section()};
    add_results(truth.section, truth.tables, truth.provenance);
    return truth;
}

Section dielectric_scattering_section(Effort effort) {
    return section_of(dielectric_scattering_study(effort), effort, add_results);
}

}  // namespace hts::validation
