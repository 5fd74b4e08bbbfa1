#include "validation/fit_section.hpp"

#include <algorithm>
#include <cmath>

#include "spectral/text.hpp"
#include "validation/built_in_curves.hpp"
#include "validation/comparison.hpp"
#include "validation/fit_cases.hpp"
#include "validation/fit_curves.hpp"

namespace hts::validation {
namespace {

std::string brief(double value) {
    return spectral::brief(value, 3);
}

std::string with_error(double value, double error) {
    return std::isfinite(error) ? brief(value) + " +- " + brief(error) : brief(value) + ", open";
}

/// "0.31 +- 0.02", "1 (at bound)", "" where the model has no such parameter.
std::string cell(const Fit& fit, const std::string& name) {
    std::string text;
    for (const FittedParameter& p : fit.parameters) {
        if (p.name != name && !p.name.starts_with(name + "@")) continue;
        text += text.empty() ? "" : ", ";
        text += p.outcome == Outcome::fitted ? with_error(p.value, p.standard_error)
                                             : brief(p.value) + " (" + validation::name(p.outcome) + ")";
    }
    return text;
}

struct CaseResult {
    FitCase asked;
    CurveSet set;
    Fit fit;
    Comparison comparison;
};

CaseResult result_of(const FitCase& asked, Effort effort) {
    CurveSet set = built_in_curves(asked.set);
    FitSelection selection = asked.selection;
    if (effort == Effort::quick) selection.most_points = asked.quick_points;
    Fit fit = fitted(asked.request, fit_data(set, selection));
    auto predicted =
        Prediction{set, selection.nodes}.values(fitted_reflector(fit), spectral::OutsideRange::clamp);
    for (double& value : predicted) value *= fit.parameter("scale").value;
    Comparison compared =
        comparison(set, std::move(predicted), static_cast<int>(fit.statistics.free_parameters));
    return {asked, std::move(set), std::move(fit), std::move(compared)};
}

// ---- tables

std::vector<std::string> parameter_row(const CaseResult& result) {
    const Fit& fit = result.fit;
    const auto slope = ratio(fit, "sigma0", "tau");
    const auto& roughness = result.set.roughness;
    return {result.asked.label,
            cell(fit, "sigma0"),
            roughness ? brief(roughness->rms_um) : "",
            cell(fit, "tau"),
            slope.standard_error > 0 ? with_error(slope.value, slope.standard_error) : brief(slope.value),
            cell(fit, "a"),
            result.asked.request.index.empty() ? cell(fit, "n") : result.asked.request.index,
            cell(fit, "scale"),
            std::to_string(fit.statistics.data),
            brief(fit.statistics.median_abs_log),
            brief(fit.statistics.rms_log),
            fit.statistics.reduced_chi_squared ? brief(*fit.statistics.reduced_chi_squared) : "",
            std::to_string(fit.starts_at_best) + " of " + std::to_string(fit.starts.size())};
}

ReportTable parameter_table(const std::vector<CaseResult>& results) {
    ReportTable table{
        "fitted-parameters",
        "He-Torrance parameters fitted to measured curves, logarithmic residuals. Errors are one standard "
        "deviation, residuals taken as independent; k = 0 where n is fitted.",
        {"data", "sigma0 [um]", "measured rms roughness [um]", "tau [um]", "sigma0/tau", "a", "n or index",
         "scale", "values", "median |ln|", "rms ln", "reduced chi squared", "starts at best"},
        {}};
    for (const CaseResult& result : results) table.rows.push_back(parameter_row(result));
    return table;
}

ReportTable statement_table(const std::vector<CaseResult>& results) {
    ReportTable table{"not-determined",
                      "What the curves leave open, and which parameters ended at a bound.",
                      {"data", "statement"},
                      {}};
    for (const CaseResult& result : results) {
        for (const std::string& statement : result.fit.statements)
            table.rows.push_back({result.asked.label, statement});
    }
    return table;
}

// ---- the picture

Figure overlay(const CaseResult& result, const std::vector<double>& fixed_angles) {
    Figure figure{"fit-" + result.set.stem,
                  {},
                  "",
                  result.set.surface + ": points measured by " + result.set.by +
                      ", lines the fitted He-Torrance model. Camera angles on the right."};
    std::string plots;
    std::size_t at = 0;
    const char* const colours[] = {"#000000", "#0072b2", "#009e73", "#d55e00",
                                   "#cc79a7", "#e69f00", "#56b4e9"};
    for (const Curve& curve : result.set.curves) {
        FigureTable table{
            figure.stem + "-" + brief(curve.fixed_angle()), {"theta_i_deg", "measured", "fitted"}, {}};
        for (const CurvePoint& point : curve.points) {
            table.rows.push_back({curve.swept_angle(point), point.value, result.comparison.model[at++]});
        }
        if (std::ranges::find(fixed_angles, std::round(curve.fixed_angle())) == fixed_angles.end()) continue;
        const std::string file = "'" + table.stem + ".csv' every ::1 using 1:";
        const std::string colour = std::string{" lc rgb '"} + colours[figure.tables.size() % 7] + "'";
        plots += (plots.empty() ? "plot " : ", \\\n     ") + file + "2 with points pt 7 ps 0.3" + colour +
                 " notitle, \\\n     " + file + "3 with lines lw 1.8" + colour + " title '" +
                 brief(curve.fixed_angle()) + "°'";
        figure.tables.push_back(std::move(table));
    }
    figure.script =
        std::string{figure_style} +
        "set logscale y\nset format y '%g'\nset xrange [0:90]\nset xtics 15\nset key outside right top\n"
        "set xlabel 'angle of incidence [°]'\nset ylabel 'BRDF [1/sr]'\n" +
        plots + "\n";
    return figure;
}

// ---- checks

void add_checks(Section& section, const CaseResult& result) {
    if (!result.asked.judged) return;
    for (Check& check : criteria(result.set, result.comparison)) section.checks.push_back(std::move(check));
}

}  // namespace

Ratio ratio(const Fit& fit, const std::string& upper, const std::string& lower) {
    const FittedParameter &a = fit.parameter(upper), &b = fit.parameter(lower);
    const auto place = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(fit.correlated, name) - fit.correlated.begin());
    };
    const std::size_t i = place(upper), j = place(lower);
    const double sa = a.standard_error / a.value, sb = b.standard_error / b.value;
    const bool both = i < fit.correlated.size() && j < fit.correlated.size();
    const double r = both ? fit.correlation[i][j] : 0;
    return {a.value / b.value,
            a.value / b.value * std::sqrt(std::max(0.0, sa * sa + sb * sb - 2 * r * sa * sb))};
}

Section fits_section(Effort effort) {
    Section section{"fits", "The model fitted to measurements", fits_text(), {}, {}, {}, {}, {}};
    std::vector<CaseResult> results;
    for (const FitCase& asked : fit_cases()) results.push_back(result_of(asked, effort));
    for (const CaseResult& result : results) {
        add_checks(section, result);
        if (result.asked.set == "mwir-aluminium-sandblasted" && result.asked.judged) {
            section.figures.push_back(overlay(result, {15, 30, 45, 60, 70, 80, 85}));
        }
    }
    section.tables = {parameter_table(results), statement_table(results)};
    return section;
}

}  // namespace hts::validation
