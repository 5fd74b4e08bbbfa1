#include <algorithm>
#include <cmath>

#include "spectral/text/text.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/curves/prediction.hpp"
#include "validation/fit/sections/case_result.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

constexpr double most_deviations = 2;

/// A fitted material beside the reflectances of its surface.
struct Energy {
    std::string label;
    std::vector<double> theta, measured, deviation, computed;
    double scale;
    bool judged;

    /// Root mean square of computed - measured, in standard deviations of the measurement.
    [[nodiscard]] double off() const {
        double sum = 0;
        for (std::size_t i = 0; i < theta.size(); ++i)
            sum += std::pow((computed[i] - measured[i]) / deviation[i], 2);
        return std::sqrt(sum / static_cast<double>(theta.size()));
    }
    [[nodiscard]] double mean(const std::vector<double>& values) const {
        double sum = 0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    }
    /// Number of angles within so many standard deviations.
    [[nodiscard]] std::size_t within(double deviations) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < theta.size(); ++i)
            if (std::abs(computed[i] - measured[i]) <= deviations * deviation[i]) ++count;
        return count;
    }
};

Energy energy_of(const CaseResult& result, const CurveSet& hemispherical) {
    Energy energy{result.asked.label, {}, {}, {}, {}, result.fit.parameter("scale").value,
                  result.asked.judged};
    energy.computed =
        Prediction{hemispherical, {4, 1}}.values(fitted_material(result.fit), spectral::OutsideRange::hold);
    for (const CurvePoint& point : hemispherical.curves.front().points) {
        energy.theta.push_back(point.theta_i);
        energy.measured.push_back(point.value);
        energy.deviation.push_back(point.uncertainty);
    }
    return energy;
}

ReportTable table_of(const std::vector<Energy>& energies) {
    ReportTable table{
        "hemispherical-reflectance",
        "Light into all directions: 1 less the measured emissivity, 2 to 5.7 um (MT-MRT, CC0-1.0), "
        "beside the hemispherical reflectance of the fitted He-Torrance material, its factor "
        "\"scale\" left out. Standard deviations are the measurement's.",
        {"fit", "scale of the fit"},
        {}};
    for (const double theta : energies.front().theta) {
        const std::string at = spectral::brief(theta) + " deg";
        table.columns.push_back("measured at " + at);
        table.columns.push_back("fit at " + at);
    }
    table.columns.insert(table.columns.end(), {"rms of the difference [standard deviations]",
                                               "angles within 2 standard deviations"});
    for (const Energy& energy : energies) {
        auto& row = table.rows.emplace_back();
        row = {energy.label, spectral::brief(energy.scale, 3)};
        for (std::size_t i = 0; i < energy.theta.size(); ++i) {
            row.push_back(spectral::brief(energy.measured[i], 3));
            row.push_back(spectral::brief(energy.computed[i], 3));
        }
        row.push_back(spectral::brief(energy.off(), 3));
        row.push_back(std::to_string(energy.within(most_deviations)) + " of " +
                      std::to_string(energy.theta.size()));
    }
    return table;
}

}  // namespace

Section emissivity_section(const std::vector<CaseResult>& results) {
    std::vector<Energy> energies;
    for (const CaseResult& result : results) {
        const auto names = built_in_curve_names();
        const std::string name = result.asked.set + "-emissivity";
        if (std::ranges::find(names, name) == names.end()) continue;
        energies.push_back(energy_of(result, built_in_curves(name)));
    }
    Section section{.stem = "emissivity",
                    .title = "Energy: the fits beside measured emissivity",
                    .text = prose("emissivity"),
                    .checks = {},
                    .figures = {},
                    .images = {},
                    .tables = {table_of(energies)},
                    .not_available = {}};
    std::size_t met = 0;
    for (const Energy& energy : energies) {
        if (!energy.judged) continue;
        section.checks.push_back({energy.label + ": hemispherical reflectance within " +
                                      spectral::brief(most_deviations) +
                                      " standard deviations of 1 - emissivity, rms over angles",
                                  spectral::brief(energy.off(), 3) + ", means " +
                                      spectral::brief(energy.mean(energy.computed), 3) + " and measured " +
                                      spectral::brief(energy.mean(energy.measured), 3),
                                  energy.off() <= most_deviations, "", 0.1});
        if (section.checks.back().passed) ++met;
    }
    section.learned =
        "Of " + std::to_string(section.checks.size()) +
        " surfaces whose curves were fitted in the plane of incidence, " + std::to_string(met) +
        " reflect as much in all as their measured emissivity says, to twice its standard deviation.";
    return section;
}

}  // namespace hts::validation
