#include "cli/answers/fit_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/io/table_writer.hpp"

namespace hts::cli {
namespace {

using nlohmann::ordered_json;
using validation::Fit;
using validation::FittedParameter;
using validation::Outcome;

/// JSON knows no infinity: null.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

std::string parameter_text(const FittedParameter& parameter) {
    std::string text{"  "};
    text.append(padded(parameter.name, 12)).append(" ").append(padded(brief(parameter.value), 10));
    if (parameter.outcome == Outcome::fitted) {
        const double error = parameter.standard_error;
        text.append(std::isfinite(error) ? " +- " + padded(brief(error, 2), 9) : padded(" open", 13));
    } else {
        text.append(" ").append(padded(name(parameter.outcome), 12));
    }
    return text + (parameter.unit == "1" ? "" : " " + parameter.unit) + "\n";
}

ordered_json parameter_json(const FittedParameter& parameter) {
    return {{"name", parameter.name},
            {"unit", parameter.unit},
            {"value", parameter.value},
            {"standard_error", number(parameter.standard_error)},
            {"lowest", parameter.lowest},
            {"highest", parameter.highest},
            {"outcome", name(parameter.outcome)}};
}

ordered_json statistics_json(const validation::FitStatistics& s) {
    return {{"values", s.data},
            {"free_parameters", s.free_parameters},
            {"rms_log", s.rms_log},
            {"median_abs_log", s.median_abs_log},
            {"rms", s.rms},
            {"l2_cosine", s.l2},
            {"reduced_chi_squared", s.reduced_chi_squared ? ordered_json(*s.reduced_chi_squared) : nullptr},
            {"gain_error", s.gain_error},
            {"cost", s.cost},
            {"aic", s.aic},
            {"bic", s.bic}};
}

ordered_json prediction_json(const validation::PredictionError& error) {
    return {{"values", error.data},
            {"median_abs_log", error.median_abs_log},
            {"rms_log", error.rms_log},
            {"rms", error.rms},
            {"l2_cosine", error.l2}};
}

ordered_json cross_validation_json(const validation::CrossValidation& result) {
    ordered_json parts = ordered_json::array();
    for (const validation::LeftOut& part : result.parts) {
        ordered_json of_part{{"angle_deg", {part.first_angle, part.last_angle}}};
        of_part.update(prediction_json(part.error));
        parts.push_back(std::move(of_part));
    }
    return {{"left_out", parts}, {"all", prediction_json(result.all)}};
}

/// Standard errors and correlations by the keys of the material; none where they do not hold, or where one is
/// open or of a number that the file does not hold alone.
std::optional<ordered_json> uncertainty_json(const Fit& fit) {
    if (!fit.errors_hold || fit.slope_alone) return std::nullopt;
    ordered_json result = ordered_json::object(), correlated = ordered_json::array();
    std::vector<std::pair<std::string, std::size_t>> known;  // key and place in the correlation
    for (const FittedParameter& parameter : fit.parameters) {
        if (parameter.name == "scale" || parameter.outcome == Outcome::fixed) continue;
        if (parameter.outcome == Outcome::at_bound) continue;  // as well known as a fixed one
        const auto place = std::ranges::find(fit.correlated, parameter.name) - fit.correlated.begin();
        if (parameter.outcome == Outcome::tied || parameter.key.empty() || !(parameter.standard_error > 0) ||
            !std::isfinite(parameter.standard_error) ||
            place == static_cast<std::ptrdiff_t>(fit.correlated.size()))
            return std::nullopt;
        result[parameter.key] = parameter.standard_error;
        for (const auto& [key, other] : known)
            correlated.push_back(
                {key, parameter.key, fit.correlation[other][static_cast<std::size_t>(place)]});
        known.emplace_back(parameter.key, static_cast<std::size_t>(place));
    }
    if (known.empty()) return std::nullopt;
    if (!correlated.empty()) result["correlated"] = correlated;
    return result;
}

ordered_json slope_json(const Fit& fit) {
    if (!fit.slope) return nullptr;
    return {{"value", fit.slope->value}, {"standard_error", number(fit.slope->standard_error)}};
}

}  // namespace

std::string material_file(const Fit& fit) {
    auto file = ordered_json::parse(fit.material);
    if (const auto uncertainty = uncertainty_json(fit)) file["uncertainty"] = *uncertainty;
    const double scale = fit.parameter("scale").value;
    if (scale != 1) file["fitted"] = {{"data", fit.data}, {"scale", scale}};
    return file.dump(2) + "\n";
}

std::string fit_text(const Fit& fit) {
    const auto& s = fit.statistics;
    std::string text = fit.data + ", " + fit.model + ", " + std::to_string(s.data) + " values, residuals " +
                       name(fit.request.residual) + ", loss " + name(fit.request.loss) + "\n";
    if (fit.slope_alone)
        text += "  sigma0/tau   " + padded(brief(fit.slope->value), 10) + " +- " +
                brief(fit.slope->standard_error, 2) + "\n";
    for (const FittedParameter& parameter : fit.parameters) text += parameter_text(parameter);
    text += "  median |ln(model/measured)| " + brief(s.median_abs_log) + ", rms " + brief(s.rms_log) +
            "; rms difference " + brief(s.rms) + ", L2 " + brief(s.l2) + "\n";
    text += s.reduced_chi_squared ? "  reduced chi squared " + brief(*s.reduced_chi_squared)
                                  : "  reduced chi squared not known: no uncertainties";
    text += fit.errors_hold ? "\n" : "; the standard errors are not valid\n";
    text += "  AIC " + brief(s.aic, 6) + ", BIC " + brief(s.bic, 6) + "; " +
            std::to_string(fit.starts_at_best) + " of " + std::to_string(fit.starts.size()) +
            " starts reached the best\n";
    for (const std::string& statement : fit.statements) text += "  note: " + statement + "\n";
    return text;
}

std::string cross_validation_text(const validation::CrossValidation& result) {
    const auto figures = [](const validation::PredictionError& error) {
        return padded(brief(error.median_abs_log), 10) + " " + padded(brief(error.rms_log), 10) + " " +
               padded(brief(error.rms), 10) + " " + brief(error.l2) + "\n";
    };
    std::string text = "  each angle predicted by a fit without it:\n    " + padded("angle [deg]", 14) +
                       padded("values", 8) + "median |ln| rms ln    rms diff.  L2\n";
    for (const validation::LeftOut& part : result.parts) {
        const std::string angle = brief(part.first_angle) +
                                  (part.last_angle > part.first_angle ? " to " + brief(part.last_angle) : "");
        text += "    " + padded(angle, 14) + padded(std::to_string(part.error.data), 8) + figures(part.error);
    }
    return text + "    " + padded("all", 14) + padded(std::to_string(result.all.data), 8) +
           figures(result.all);
}

std::string fit_json(const Fit& fit, const std::optional<validation::CrossValidation>& cross_validation) {
    ordered_json parameters = ordered_json::array(), starts = ordered_json::array();
    for (const FittedParameter& parameter : fit.parameters) parameters.push_back(parameter_json(parameter));
    for (const auto& start : fit.starts) {
        starts.push_back(
            {{"cost", number(start.cost)}, {"iterations", start.iterations}, {"converged", start.converged}});
    }
    ordered_json report{{"data", fit.data},
                        {"model", fit.model},
                        {"lobes", fit.request.lobes},
                        {"residual", name(fit.request.residual)},
                        {"loss", name(fit.request.loss)},
                        {"loss_scale", fit.request.loss_scale},
                        {"parameters", parameters},
                        {"sigma0_over_tau", slope_json(fit)},
                        {"sigma0_and_tau_apart", fit.slope_alone},
                        {"errors_hold", fit.errors_hold},
                        {"correlated", fit.correlated},
                        {"correlation", fit.correlation},
                        {"statistics", statistics_json(fit.statistics)},
                        {"statements", fit.statements},
                        {"starts", starts},
                        {"starts_at_best", fit.starts_at_best},
                        {"material", ordered_json::parse(fit.material)}};
    if (cross_validation) report["cross_validation"] = cross_validation_json(*cross_validation);
    return report.dump(2) + "\n";
}

}  // namespace hts::cli
