#include "validation/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"
#include "validation/fit/fit_problem.hpp"
#include "validation/fit/fit_uncertainty.hpp"

namespace hts::validation {
namespace {

double sum_of_squares(const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// The starts with the lowest sums of squares, lowest first.
std::vector<std::vector<double>> promising_starts(const FitProblem& problem, std::size_t count) {
    const auto starts = problem.starts();
    std::vector<double> costs(starts.size());
    spectral::parallel_for(starts.size(), [&](std::size_t i) {
        costs[i] = sum_of_squares(problem.projected_residuals(starts[i], false).residuals);
    });
    std::vector<std::size_t> order(starts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return costs[i]; });
    std::vector<std::vector<double>> result;
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) result.push_back(starts[order[i]]);
    return result;
}

std::vector<Minimum> minima(const FitProblem& problem, const FitRequest& request, const FitData& data,
                            const Fit* made);

std::vector<double> values_of(const Fit& fit) {
    std::vector<double> result;
    for (const FittedParameter& parameter : fit.parameters) result.push_back(parameter.value);
    return result;
}

const Minimum& best_of(const std::vector<Minimum>& followed) {
    return *std::ranges::min_element(followed, {}, &Minimum::cost);
}

/// Where a parameter stands in a material file, and for which channel.
std::string address(const FitParameter& parameter) {
    const auto channel = parameter.name.find('@');
    return parameter.pointer + (channel == std::string::npos ? "" : parameter.name.substr(channel));
}

/// The request for one lobe less; what it says of single lobes is left out.
FitRequest with_a_lobe_less(FitRequest request) {
    const auto of_one_lobe = [&](const std::string& name) {
        const FitFamily* family = find_family(request.model);
        const auto is_it = [&](const ParameterRange& range) {
            return name == range.key || name == range.symbol;
        };
        return name != "scale" && std::ranges::none_of(family->parameters, is_it) &&
               std::ranges::none_of(family->lobe, is_it);
    };
    std::erase_if(request.fixed, [&](const auto& entry) { return of_one_lobe(entry.first); });
    std::erase_if(request.starts, [&](const auto& entry) { return of_one_lobe(entry.first); });
    std::erase_if(request.freed, of_one_lobe);
    --request.lobes;
    request.progress = {};
    return request;
}

/// For several lobes: the best fit with one less and another lobe of hardly any weight, from where it only gets better.
std::vector<std::vector<double>> nested_starts(const FitProblem& problem, const FitRequest& request,
                                               const FitData& data, const Fit* made) {
    if (request.lobes < 2) return {};
    const FitRequest fewer = with_a_lobe_less(request);
    const FitProblem smaller{fewer, data};
    const auto found =
        made != nullptr ? values_of(*made)
                        : smaller.values(smaller.completed(best_of(minima(smaller, fewer, data, nullptr)).x));
    std::map<std::string, double> known;
    for (std::size_t i = 0; i < found.size(); ++i) known[address(smaller.places()[i].parameter)] = found[i];
    std::vector<std::vector<double>> result;
    for (const std::size_t variant : {1U, 3U}) {
        auto values = problem.values({});
        for (std::size_t i = 0; i < values.size(); ++i) {
            const FitParameter& parameter = problem.places()[i].parameter;
            const auto& starts = parameter.range.starts;
            const auto at = known.find(address(parameter));
            const bool weight = parameter.range.motion == Motion::linear;
            values[i] = at != known.end() ? at->second : weight ? 1e-4 : starts[variant % starts.size()];
        }
        result.push_back(problem.searched(values));
    }
    return result;
}

///   made   the fit with a lobe less, where there is one
std::vector<Minimum> minima(const FitProblem& problem, const FitRequest& request, const FitData& data,
                            const Fit* made) {
    auto starts = promising_starts(problem, std::max<std::size_t>(request.followed_starts, 1));
    for (auto& start : nested_starts(problem, request, data, made)) starts.push_back(std::move(start));
    const Residuals residuals = [&](std::span<const double> x, bool with_jacobian) {
        return problem.projected_residuals(x, with_jacobian);
    };
    const std::vector<Bounds> bounds{
        problem.bounds().begin(),
        problem.bounds().begin() + static_cast<std::ptrdiff_t>(problem.searched_count())};
    std::vector<Minimum> result(starts.size());
    std::size_t done = 0;
    spectral::parallel_for(starts.size(), [&](std::size_t i) {
        result[i] = local_minimum(residuals, starts[i], bounds, request.most_iterations);
#pragma omp critical(hts_fit_progress)
        if (request.progress) request.progress(++done, starts.size());
    });
    return result;
}

// ---- what came out

FitStatistics statistics(const FitData& data, const std::vector<double>& predicted, std::size_t free,
                         double cost) {
    std::vector<double> logs, differences, with_cosine, normalised;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        const double difference = predicted[i] - data.values[i];
        differences.push_back(difference);
        with_cosine.push_back(difference * data.cosines[i]);
        if (!data.uncertainties.empty()) normalised.push_back(difference / data.uncertainties[i]);
        if (predicted[i] > 0 && data.values[i] > 0)
            logs.push_back(std::abs(std::log(predicted[i] / data.values[i])));
    }
    const auto n = static_cast<double>(predicted.size()), k = static_cast<double>(free);
    FitStatistics result{};
    result.data = predicted.size();
    result.free_parameters = free;
    result.rms_log = spectral::root_mean_square(logs);
    result.median_abs_log = spectral::median(logs);
    result.rms = spectral::root_mean_square(differences);
    result.l2 = spectral::root_mean_square(with_cosine);
    if (!normalised.empty()) result.reduced_chi_squared = sum_of_squares(normalised) / (n - k);
    result.cost = cost;
    const double likelihood = n * std::log(std::max(cost / n, std::numeric_limits<double>::min()));
    result.aic = likelihood + 2 * (k + 1);
    result.bic = likelihood + (k + 1) * std::log(n);
    return result;
}

bool at_bound(double coordinate, const Bounds& bounds) {
    const auto near = [&](double bound) {
        return std::abs(coordinate - bound) <= 1e-9 * std::max(1.0, std::abs(bound));
    };
    return near(bounds.lowest) || near(bounds.highest);
}

std::vector<FittedParameter> listed(const FitProblem& problem, const std::vector<double>& values) {
    std::vector<FittedParameter> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Place& place = problem.places()[i];
        const ParameterRange& range = place.parameter.range;
        const Outcome outcome = place.role == Role::fixed  ? Outcome::fixed
                                : place.role == Role::tied ? Outcome::tied
                                                           : Outcome::fitted;
        result.push_back(
            {place.parameter.name, range.unit, values[i], 0, range.lowest, range.highest, outcome});
    }
    return result;
}

/// Places in the list, as its numbers rise.
std::vector<std::size_t> in_order(const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> result(numbers.size());
    std::iota(result.begin(), result.end(), std::size_t{0});
    std::ranges::sort(result, {}, [&](std::size_t i) { return numbers[i]; });
    return result;
}

/// Standard errors, correlation and statements, from the derivatives at the minimum.
void add_uncertainty(Fit& fit, const FitProblem& problem, const std::vector<double>& coordinates) {
    const Columns all = problem.residuals(coordinates, true).jacobian;
    std::vector<FreeParameter> parameters;
    std::vector<std::size_t> places;
    Columns columns;
    for (const std::size_t k : in_order(problem.free())) {
        FittedParameter& parameter = fit.parameters[problem.free()[k]];
        if (at_bound(coordinates[k], problem.bounds()[k])) {
            parameter.outcome = Outcome::at_bound;
            continue;
        }
        places.push_back(problem.free()[k]);
        parameters.push_back(
            {parameter.name, problem.places()[places.back()].parameter.range, parameter.value});
        columns.push_back(all[k]);
    }
    const double freedom = static_cast<double>(fit.predicted.size() - parameters.size());
    const Uncertainty found = uncertainty(parameters, columns, fit.statistics.cost / freedom);
    for (std::size_t k = 0; k < places.size(); ++k) {
        fit.parameters[places[k]].standard_error = found.standard_errors[k];
        fit.correlated.push_back(parameters[k].name);
    }
    fit.correlation = found.correlation;
    fit.statements = found.statements;
    for (const FittedParameter& parameter : fit.parameters) {
        if (parameter.outcome == Outcome::at_bound)
            fit.statements.push_back(parameter.name + ": ended at its bound");
    }
}

}  // namespace

const char* name(Residual residual) noexcept {
    switch (residual) {
        case Residual::logarithmic:
            return "log";
        case Residual::relative:
            return "relative";
        case Residual::weighted:
            return "weighted";
        case Residual::cosine:
            return "cosine";
    }
    return "";
}

const char* name(Loss loss) noexcept {
    return loss == Loss::squares ? "squares" : loss == Loss::huber ? "huber" : "cauchy";
}

const char* name(Outcome outcome) noexcept {
    switch (outcome) {
        case Outcome::fitted:
            return "fitted";
        case Outcome::at_bound:
            return "at bound";
        case Outcome::fixed:
            return "fixed";
        case Outcome::tied:
            return "tied";
    }
    return "";
}

const FittedParameter& Fit::parameter(const std::string& name) const {
    const auto found = std::ranges::find(parameters, name, &FittedParameter::name);
    if (found == parameters.end()) throw Error{"fit: no parameter \"" + name + "\""};
    return *found;
}

spectral::Material fitted_material(const Fit& fit) {
    return spectral::material_from_text(fit.material, "fit");
}

Fit fitted(const FitRequest& request, const FitData& data, const Fit* with_a_lobe_less) {
    const FitData good = checked(data);
    const FitProblem problem{request, good};
    const auto followed = minima(problem, request, good, with_a_lobe_less);
    const Minimum& best = best_of(followed);
    const auto coordinates = problem.completed(best.x);
    const auto values = problem.values(coordinates);

    Fit fit{request.model,
            data.name,
            request,
            listed(problem, values),
            {},
            {},
            problem.predicted(values),
            {},
            {},
            0,
            {},
            {}};
    fit.statistics = statistics(good, fit.predicted, problem.free().size(), 2 * best.cost);
    for (const Minimum& minimum : followed) {
        fit.starts.push_back({2 * minimum.cost, minimum.iterations, minimum.converged});
        if (minimum.cost <= best.cost * (1 + 1e-4) + 1e-300) ++fit.starts_at_best;
    }
    add_uncertainty(fit, problem, coordinates);
    fit.material = problem.model().material_text(std::span{values}.first(values.size() - 1),
                                                 data.name + ", fitted " + request.model);
    return fit;
}

}  // namespace hts::validation
