#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/output/script.hpp"
#include "validation/report/prose.hpp"
#include "validation/scattering/fourier/fourier_integral.hpp"

namespace hts::validation {
namespace {

std::vector<FourierCase> cases(Effort effort) {
    if (effort == Effort::quick) return {{1, 1, 0}, {5, 2, 30}};
    return {{0.1, 1, 30}, {1, 1, 0}, {1, 2, 60}, {5, 2, 30}, {20, 3, 30}, {5, 3, 70}};
}

double degrees_theta(const Direction& direction) {
    return std::acos(direction.cos_theta()) * 180 / std::numbers::pi;
}

double degrees_phi(const Direction& direction) {
    return std::atan2(direction.sin_phi(), direction.cos_phi()) * 180 / std::numbers::pi;
}

FigureTable table_of(const std::vector<FourierResult>& results, int realisations) {
    FigureTable table{
        "fourier-integral",
        {"phase_variance", "tau_over_lambda", "theta_i_deg", "sigma0_over_lambda", "realisations",
         "theta_r_deg", "phi_r_deg", "computed_brdf", "standard_error", "closed_form_brdf", "deviation"},
        {}};
    for (const FourierResult& result : results) {
        for (const FourierPoint& point : result.points)
            table.rows.push_back({result.of.phase_variance, result.of.correlation_length,
                                  degrees_theta(point.in), result.surface.rms_roughness,
                                  static_cast<double>(realisations), degrees_theta(point.out),
                                  degrees_phi(point.out), point.computed, point.standard_error,
                                  point.closed_form, point.deviation()});
    }
    return table;
}

/// Rows of one surface and incidence after the other.
std::vector<std::vector<std::vector<double>>> groups(const FigureTable& table) {
    std::vector<std::vector<std::vector<double>>> all;
    for (const auto& row : table.rows) {
        if (all.empty() || !std::equal(row.begin(), row.begin() + 3, all.back()[0].begin()))
            all.emplace_back();
        all.back().push_back(row);
    }
    return all;
}

std::string case_text(const std::vector<double>& row) {
    return "g = " + shortest(row[0]) + ", τ = " + shortest(row[1]) + " λ, " + rounded(row[2], 0) + "°";
}

std::vector<Check> checks(const FigureTable& table) {
    const std::size_t deviation = column_of(table, "deviation");
    std::vector<Check> found;
    double within = 0, squares = 0;
    for (const auto& row : table.rows) {
        within += std::fabs(row[deviation]) <= 3 ? 1 : 0;
        squares += row[deviation] * row[deviation];
    }
    const auto count = static_cast<double>(table.rows.size());
    std::string remark;
    for (const auto& group : groups(table)) {
        const auto inside = std::count_if(group.begin(), group.end(),
                                          [&](const auto& row) { return std::fabs(row[deviation]) <= 3; });
        remark.append(remark.empty() ? "" : "; ").append(case_text(group[0]));
        remark.append(": ")
            .append(std::to_string(inside))
            .append(" of ")
            .append(std::to_string(group.size()));
    }
    found.push_back(
        {"directional-diffuse term before shadowing within 3 standard errors of the Fourier integral in at "
         "least 95 % of directions",
         rounded(100 * within / count, 1) + " % of " + std::to_string(table.rows.size()),
         within >= 0.95 * count, remark});
    const double rms = std::sqrt(squares / count);
    found.push_back({"the deviations are those of chance: rms 0.8 to 1.2 standard errors", rounded(rms, 2),
                     rms > 0.8 && rms < 1.2});
    return found;
}

Figure figure(const FigureTable& table, const std::string& provenance) {
    std::vector<std::string> names;
    std::vector<output::Rows> ratios;
    std::vector<double> deviations;
    for (const auto& group : groups(table)) {
        names.push_back(case_text(group[0]));
        ratios.emplace_back();
        for (const auto& row : group) {
            ratios.back().push_back({row[9], row[7] / row[9], row[8] / row[9]});
            deviations.push_back(row[10]);
        }
    }
    std::sort(deviations.begin(), deviations.end());
    output::Rows steps;
    for (std::size_t i = 0; i < deviations.size(); ++i)
        steps.push_back(
            {deviations[i], (static_cast<double>(i) + 0.5) / static_cast<double>(deviations.size())});
    output::Script script;
    script.set("surface", names).data("ratios", ratios).data("deviations", steps);
    return {"fourier-integral",
            {},
            script.with("fourier-integral"),
            "Kirchhoff's integral over explicit surfaces. " + provenance};
}

void add_fourier_results(Section& section, const std::vector<FigureTable>& tables,
                         const std::string& provenance) {
    for (Check& check : checks(tables[0])) section.checks.push_back(std::move(check));
    section.figures.push_back(figure(tables[0], provenance));
}

Section fourier_section() {
    return {"fourier-integral",
            "The Fourier integral of explicit surfaces",
            prose("fourier-integral"),
            {},
            {},
            {},
            {},
            {}};
}

}  // namespace

GroundTruth fourier_study(Effort effort) {
    FourierSettings settings;
    if (effort == Effort::quick) settings.realisations = 100;
    std::vector<FourierResult> results;
    const auto all = cases(effort);
    const spectral::Job job{"", all.size()};
    for (const FourierCase& of : all) {
        results.push_back(fourier_result(of, settings));
        job.done();
    }
    return ground_truth("Fourier integral of random surfaces 12 tau by 12 tau, periodic: " +
                            std::to_string(settings.realisations) + " realisations, " +
                            std::to_string(settings.directions) + " directions each, seeds from " +
                            std::to_string(settings.study) + regenerating("fourier", effort),
                        {table_of(results, settings.realisations)}, fourier_section(), add_fourier_results);
}

Section fourier_section(Effort effort) {
    return section_of(fourier_study(effort), effort, add_fourier_results);
}

}  // namespace hts::validation
