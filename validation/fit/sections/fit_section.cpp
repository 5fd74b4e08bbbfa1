#include "validation/fit/sections/fit_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spectral/text/text.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/curves/comparison_section.hpp"
#include "validation/fit/fit_curves.hpp"
#include "validation/fit/fit_findings.hpp"
#include "validation/fit/sections/case_result.hpp"
#include "validation/report/prose.hpp"

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

CaseResult result_of(const FitCase& asked, Effort effort) {
    CurveSet set = built_in_curves(asked.set);
    FitSelection selection = asked.selection;
    if (effort == Effort::quick) selection.most_points = asked.quick_points;
    selection.outside = spectral::OutsideRange::hold;
    Fit fit = fitted(asked.request, set, selection);
    return {asked, std::move(set), std::move(fit)};
}

// ---- tables

std::vector<std::string> parameter_row(const CaseResult& result) {
    const Fit& fit = result.fit;
    const Ratio slope = *fit.slope;
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

/// The fitted model beside the whole set, fitted points and others.
Section section_of(const CaseResult& result) {
    const double scale = result.fit.parameter("scale").value;
    std::string model = "fitted He-Torrance: σ₀ " + brief(result.fit.parameter("sigma0").value) + " µm, τ " +
                        brief(result.fit.parameter("tau").value) + " µm";
    const std::string& index = result.asked.request.index;  // in quotation marks, or an object
    if (!index.empty())
        model += ", index " + (index.starts_with('"') ? index.substr(1, index.size() - 2) : index);
    if (scale != 1) model += ", times " + brief(scale);
    return comparison_section(result.set, fitted_material(result.fit),
                              {.model = model,
                               .free_parameters = static_cast<int>(result.fit.statistics.free_parameters),
                               .policy = spectral::OutsideRange::hold,
                               .nodes = result.asked.selection.nodes,
                               .scale = scale,
                               .in_report = true});
}

/// How many surfaces are met, and which is farthest.
std::string surfaces_text(const std::vector<Section>& surfaces) {
    const auto median = [](const Section& section) {
        return spectral::number_in(spectral::words(section.checks[0].measured)[0]);
    };
    const auto met =
        std::ranges::count_if(surfaces, [](const Section& section) { return section.checks[0].passed; });
    const auto worst = std::ranges::max_element(surfaces, {}, median);
    return std::to_string(met) + " of " + std::to_string(surfaces.size()) +
           " measured surfaces have a median |ln(model / measured)| of at most 0.25; the farthest is " +
           worst->title + ", " + worst->checks[0].measured + ".";
}

}  // namespace

std::vector<Section> fits_sections(Effort effort) {
    std::vector<CaseResult> results;
    for (const FitCase& asked : fit_cases()) results.push_back(result_of(asked, effort));
    std::vector<Section> sections{{.stem = "fits",
                                   .title = "The model fitted to measurements",
                                   .text = prose("fits"),
                                   .checks = {},
                                   .figures = {},
                                   .images = {},
                                   .tables = {parameter_table(results), statement_table(results)},
                                   .not_available = {}}};
    std::vector<Section> surfaces;
    for (const CaseResult& result : results) {
        if (!result.asked.judged) continue;
        surfaces.push_back(section_of(result));
        surfaces.back().part_of_another = true;
        if (effort == Effort::quick) mark_as_quick(surfaces.back().checks);
    }
    sections.front().learned = surfaces_text(surfaces);
    std::ranges::move(surfaces, std::back_inserter(sections));
    for (Section& section : std::vector{predicted_section(results), emissivity_section(results)}) {
        if (effort == Effort::quick) mark_as_quick(section.checks);
        sections.push_back(std::move(section));
    }
    return sections;
}

}  // namespace hts::validation
