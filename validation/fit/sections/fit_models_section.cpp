#include <algorithm>
#include <cstdio>
#include <functional>

#include "validation/curves/built_in_curves.hpp"
#include "validation/fit/fit_table.hpp"
#include "validation/fit/sections/fit_cases.hpp"
#include "validation/fit/sections/fit_section.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

/// The isotropic models of [Kurt10], section 5.1, with one lobe each.
const std::vector<std::string> models_of_the_paper{
    "kurt", "ashikhmin_shirley", "blinn_phong", "cook_torrance", "lafortune", "ward", "ward_duer"};

/// All models fitted to one set.
struct SetResult {
    std::string set;
    std::vector<Fit> l2, log;
    std::vector<CrossValidation> unseen;  ///< of the fits to logarithms
};

std::string text_of(const char* format, double value) {
    std::string text(32, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), format, value)));
    return text;
}

SetResult result_of(const std::string& set, Effort effort) {
    const bool quick = effort == Effort::quick;
    const CurveSet curves = built_in_curves(set);
    ComparisonRequest request{.residual = Residual::cosine,
                              .selection = {80,
                                            quick ? std::size_t{40} : 0,
                                            {quick ? 3 : 4, quick ? 0 : 1},
                                            spectral::OutsideRange::hold},
                              .index = known_index(set),
                              .followed_starts = quick ? std::size_t{1} : 8};
    SetResult result{set, fits_of(compared_models(), curves, request), {}, {}};
    request.residual = Residual::logarithmic;
    result.log = fits_of(compared_models(), curves, request);
    result.unseen = cross_validations(result.log, curves, request.selection);
    return result;
}

using Number = std::function<double(const Fit&)>;

/// A row per set, a column per model; `marked` says which cells get a star.
ReportTable table_of(std::string stem, std::string caption, const std::vector<SetResult>& results,
                     std::vector<Fit> SetResult::*fits, const char* format, const Number& number) {
    ReportTable table{std::move(stem), std::move(caption), {"data", "values"}, {}};
    for (const ModelChoice& model : compared_models()) table.columns.push_back(model.label());
    for (const SetResult& result : results) {
        const std::vector<Fit>& all = result.*fits;
        double lowest = number(all.front());
        for (const Fit& fit : all) lowest = std::min(lowest, number(fit));
        std::vector<std::string> row{result.set, std::to_string(all.front().statistics.data)};
        for (const Fit& fit : all)
            row.push_back(text_of(format, number(fit)) + (number(fit) <= lowest ? " *" : ""));
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Which fit of a set predicts best.
std::size_t best_predictor(const SetResult& result) {
    const auto best = std::ranges::min_element(result.unseen, {},
                                               [](const CrossValidation& each) { return each.all.rms_log; });
    return static_cast<std::size_t>(best - result.unseen.begin());
}

/// Of each set and model, what a fit says of angles that it has not seen.
ReportTable predicted_table(const std::vector<SetResult>& results) {
    ReportTable table{
        "predicted-errors",
        "Rms of ln(model/measured) where each angle of incidence is predicted by a fit to the others' "
        "logarithms; * the lowest",
        {"data", "values"},
        {}};
    for (const ModelChoice& model : compared_models()) table.columns.push_back(model.label());
    for (const SetResult& result : results) {
        std::vector<std::string> row{result.set, std::to_string(result.log.front().statistics.data)};
        const double lowest = result.unseen[best_predictor(result)].all.rms_log;
        for (const CrossValidation& each : result.unseen)
            row.push_back(text_of("%.3f", each.all.rms_log) + (each.all.rms_log <= lowest ? " *" : ""));
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// In how many sets the model that fits best is not the one that predicts best.
std::string predictors_text(const std::vector<SetResult>& results) {
    std::size_t others = 0;
    for (const SetResult& result : results) {
        const auto fits_best =
            std::ranges::min_element(result.log, {}, [](const Fit& fit) { return fit.statistics.rms_log; });
        const auto predicts = static_cast<std::ptrdiff_t>(best_predictor(result));
        if (fits_best - result.log.begin() != predicts) ++others;
    }
    return "Fitting is not predicting: with one angle of incidence left out at a time, another model than "
           "the one that fits best predicts what was left out best in " +
           std::to_string(others) + " of " + std::to_string(results.size()) + " sets.";
}

double lowest_aic(const SetResult& result) {
    return std::ranges::min_element(result.log, {}, [](const Fit& fit) { return fit.statistics.aic; })
        ->statistics.aic;
}

const Fit& fit_of(const std::vector<Fit>& fits, const std::string& model, int lobes = 1) {
    return *std::ranges::find_if(
        fits, [&](const Fit& fit) { return fit.model == model && fit.request.lobes == lobes; });
}

/// In how many sets a model of the paper's seven has the lowest L2 error; ties within 1e-3 count for each.
std::size_t wins(const std::vector<SetResult>& results, const std::string& model) {
    const auto won = std::ranges::count_if(results, [&](const SetResult& result) {
        const double own = fit_of(result.l2, model).statistics.l2;
        return std::ranges::all_of(models_of_the_paper, [&](const std::string& other) {
            return own <= fit_of(result.l2, other).statistics.l2 * (1 + 1e-3);
        });
    });
    return static_cast<std::size_t>(won);
}

std::string wins_text(const std::vector<SetResult>& results) {
    std::string text =
        "Lowest L2 error of the seven models that Kurt et al. compare, one lobe each, in how many of " +
        std::to_string(results.size()) + " sets (ties within 0.1 % count for each): ";
    for (const std::string& model : models_of_the_paper) {
        text += (model == models_of_the_paper.front() ? "" : ", ") + model + " " +
                std::to_string(wins(results, model));
    }
    return text +
           ". The paper finds its own model lowest for 25 of 30 isotropic materials of Matusik et al., which "
           "are other materials, measured in all directions.";
}

/// Median over sets of how much of the one-lobe L2 error more lobes take away.
std::string lobes_text(const std::vector<SetResult>& results) {
    std::string text;
    for (const int lobes : {2, 3}) {
        std::vector<double> gains;
        gains.reserve(results.size());
        for (const SetResult& result : results) {
            gains.push_back(1 - fit_of(result.l2, "kurt", lobes).statistics.l2 /
                                    fit_of(result.l2, "kurt").statistics.l2);
        }
        std::ranges::sort(gains);
        text += (lobes == 2 ? "Two lobes of Kurt's take " : ", three ") +
                text_of("%.0f", 100 * gains[gains.size() / 2]) + " %";
    }
    return text +
           " of its L2 error away, in the median over sets; the paper's 30 materials give 28 % on average "
           "for two.";
}

}  // namespace

Section models_section(Effort effort) {
    std::vector<SetResult> results;
    for (const std::string& set : built_in_curve_names()) {
        if (built_in_curves(set).quantity != Quantity::hemispherical_reflectance)
            results.push_back(result_of(set, effort));
    }
    const auto median = [](const Fit& fit) { return fit.statistics.median_abs_log; };
    const auto l2 = [](const Fit& fit) { return fit.statistics.l2; };
    Section section{"models", "All models fitted to all measurements", "", {}, {}, {}, {}, {}};
    section.text = prose("models") + "\n\n" + wins_text(results) + " " + lobes_text(results) + "\n\n" +
                   predictors_text(results);
    section.tables = {
        table_of("l2-errors",
                 "L2 error: rms of (model - measured) cos theta_i [1/sr] after a fit to it; * the lowest",
                 results, &SetResult::l2, "%.3g", l2),
        table_of("log-errors", "Median |ln(model/measured)| after a fit to logarithms; * the lowest", results,
                 &SetResult::log, "%.3f", median),
    };
    ReportTable aic = section.tables.back();
    aic.stem = "aic";
    aic.caption = "AIC of the fits to logarithms, less the lowest of the row";
    for (std::size_t i = 0; i < results.size(); ++i) {
        const double lowest = lowest_aic(results[i]);
        for (std::size_t j = 0; j < results[i].log.size(); ++j) {
            aic.rows[i][j + 2] = text_of("%.0f", results[i].log[j].statistics.aic - lowest);
        }
    }
    section.tables.push_back(std::move(aic));
    section.tables.push_back(predicted_table(results));
    return section;
}

}  // namespace hts::validation
