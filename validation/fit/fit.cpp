#include "validation/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"
#include "spectral/text/text.hpp"
#include "validation/fit/fit_estimate.hpp"
#include "validation/fit/fit_problem.hpp"

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
    return request;
}

/// For several lobes: the best fit with one less and another lobe of hardly any weight, from
/// where it only gets better.
// NOLINTNEXTLINE(misc-no-recursion): a lobe less each time
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

constexpr Stopping first_stage{100, 1e-6};
constexpr double worth_finishing = 1.05;

/// Follows all starts a little and the best to their end.
///   made   the fit with a lobe less, where there is one
// NOLINTNEXTLINE(misc-no-recursion): a lobe less each time
std::vector<Minimum> minima(const FitProblem& problem, const FitRequest& request, const FitData& data,
                            const Fit* made) {
    auto starts = promising_starts(problem, std::max<std::size_t>(request.followed_starts, 1));
    for (auto& start : nested_starts(problem, request, data, made)) starts.push_back(std::move(start));
    const Residuals residuals = problem.residuals_to_search();
    const auto bounds = problem.searched_bounds();
    std::vector<Minimum> result(starts.size());
    const spectral::Job job{"following starts", 2};
    const auto follow = [&](std::size_t i, const Stopping& stopping) {
        Minimum next = local_minimum(residuals, starts[i], bounds, stopping);
        next.iterations += result[i].iterations;
        result[i] = std::move(next);
        starts[i] = result[i].x;
    };
    spectral::parallel_for(starts.size(), [&](std::size_t i) {
        follow(i, {std::min(first_stage.most_iterations, request.most_iterations), first_stage.least_gain});
    });
    job.done();
    const double enough = worth_finishing * best_of(result).cost;
    std::vector<std::size_t> promising;
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (result[i].cost <= enough) promising.push_back(i);
    }
    spectral::parallel_for(promising.size(), [&](std::size_t i) {
        follow(promising[i], {request.most_iterations, 1e-12});
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
        if (const auto log = log_ratio(predicted[i], data.values[i], data.noise_floor))
            logs.push_back(std::abs(*log));
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

std::vector<FittedParameter> listed(const FitProblem& problem, const std::vector<double>& values) {
    std::vector<FittedParameter> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Place& place = problem.places()[i];
        const ParameterRange& range = place.parameter.range;
        const Outcome outcome = place.role == Role::fixed  ? Outcome::fixed
                                : place.role == Role::tied ? Outcome::tied
                                                           : Outcome::fitted;
        const bool own = !place.parameter.pointer.empty() && !place.parameter.channel;
        result.push_back({place.parameter.name, range.unit, values[i], 0, range.lowest, range.highest,
                          outcome, own ? place.parameter.pointer.substr(1) : ""});
    }
    return result;
}

// ---- all of it

void add_uncertainty(Fit& fit, const Estimate& found, const FitProblem& problem,
                     const std::vector<double>& coordinates) {
    for (std::size_t k = 0; k < problem.free().size(); ++k) {
        if (at_bound(coordinates[k], problem.bounds()[k]))
            fit.parameters[problem.free()[k]].outcome = Outcome::at_bound;
    }
    for (const FittedParameter& parameter : fit.parameters) {
        if (parameter.outcome == Outcome::at_bound)
            fit.statements.push_back(parameter.name + ": ended at its bound");
    }
    for (std::size_t k = 0; k < found.places.size(); ++k) {
        fit.parameters[found.places[k]].standard_error = found.uncertainty.standard_errors[k];
        fit.correlated.push_back(found.parameters[k].name);
    }
    fit.correlation = found.uncertainty.correlation;
    fit.statistics.gain_error = std::sqrt(found.noise.gain_variance);
}

/// sigma0/tau with its error, from one or both of them.
Ratio slope_of(const Fit& fit, const Estimate& found) {
    const FittedParameter &sigma0 = fit.parameter("sigma0"), &tau = fit.parameter("tau");
    const auto place = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(fit.correlated, name) - fit.correlated.begin());
    };
    const std::size_t i = place("sigma0"), j = place("tau"), count = fit.correlated.size();
    double relative = 0;
    if (i < count && j < count)
        relative = found.uncertainty.of_ratios[i][j];
    else
        relative = sigma0.standard_error / sigma0.value + tau.standard_error / tau.value;
    return {sigma0.value / tau.value, sigma0.value / tau.value * relative};
}

/// Says that sigma0 and tau are open, where they are.
void add_slope(Fit& fit, const Estimate& found, const std::optional<RoughLimit>& rough, double cost) {
    fit.slope = slope_of(fit, found);
    if (rough) fit.rough = RoughSurface{rough->slope, 2 * rough->cost};
    const std::string apart = "sigma0 and tau apart: only sigma0/tau = ";
    const auto said = std::ranges::find_if(found.uncertainty.statements,
                                           [&](const std::string& text) { return text.starts_with(apart); });
    // a model that misses the data tells no surfaces apart that it misses by about as much
    constexpr double about = 2;
    fit.slope_alone = said != found.uncertainty.statements.end() ||
                      (rough && within_noise(*rough, cost, found)) ||
                      (rough && !fit.errors_hold && rough->cost <= about * cost);
    if (!fit.slope_alone) return;
    if (rough) {
        const double off = fit.slope->value - rough->slope.value;
        fit.slope->standard_error =
            std::hypot(std::isfinite(fit.slope->standard_error) ? fit.slope->standard_error : 0, off);
        if (fit.parameter("sigma0").outcome == Outcome::at_bound) fit.slope = rough->slope;
    }
    for (FittedParameter& parameter : fit.parameters) {
        if (parameter.outcome == Outcome::fitted && (parameter.name == "sigma0" || parameter.name == "tau"))
            parameter.standard_error = std::numeric_limits<double>::infinity();
    }
    fit.statements.push_back(apart + spectral::brief(fit.slope->value, 3) + " +- " +
                             spectral::brief(fit.slope->standard_error, 3));
    std::ranges::copy_if(found.uncertainty.statements, std::back_inserter(fit.statements),
                         [&](const std::string& text) { return !text.starts_with(apart); });
}

/// What reduced chi squared says of the model and so of the errors, gains of the curves allowed for.
void add_validity(Fit& fit, const Estimate& found) {
    constexpr double most = 2;
    double squares = 0;
    for (const double r : found.scatter.residuals) squares += r * r;
    const double share = squares > 0 ? found.noise.variance * found.noise.freedom / squares : 1;
    const auto& reduced = fit.statistics.reduced_chi_squared;
    fit.errors_hold = !reduced || *reduced * share <= most;
}

void say_validity(Fit& fit) {
    if (const double gain = fit.statistics.gain_error; gain > 0)
        fit.statements.push_back("the curves are off by factors of their own, " +
                                 spectral::brief(100 * gain, 2) +
                                 " % (one standard deviation): the standard errors allow for it");
    if (!fit.errors_hold)
        fit.statements.push_back("reduced chi squared " +
                                 spectral::brief(*fit.statistics.reduced_chi_squared, 3) +
                                 ": the model misses the data by more than their uncertainties, so that the "
                                 "standard errors are not valid");
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
    auto followed = minima(problem, request, good, with_a_lobe_less);
    std::optional<RoughLimit> rough;
    if (const auto places = rough_places(problem)) {
        const auto from = problem.values(problem.completed(best_of(followed).x));
        rough = rough_limit(problem, *places, request, good, from);
        if (rough->cost < best_of(followed).cost)
            followed.push_back(local_minimum(problem.residuals_to_search(), problem.searched(rough->values),
                                             problem.searched_bounds(), {request.most_iterations, 1e-12}));
    }
    const Minimum& best = best_of(followed);
    const auto coordinates = problem.completed(best.x);
    const auto values = problem.values(coordinates);

    Fit fit{.model = request.model,
            .data = data.name,
            .request = request,
            .parameters = listed(problem, values),
            .correlated = {},
            .correlation = {},
            .predicted = problem.predicted(values),
            .statistics = {},
            .starts = {},
            .starts_at_best = 0,
            .statements = {},
            .material = {}};
    fit.statistics = statistics(good, fit.predicted, problem.free().size(), 2 * best.cost);
    for (const Minimum& minimum : followed) {
        fit.starts.push_back({2 * minimum.cost, minimum.iterations, minimum.converged});
        if (minimum.cost <= best.cost * (1 + 1e-4) + 1e-300) ++fit.starts_at_best;
    }
    const Estimate found = estimate(problem, good, coordinates);
    add_uncertainty(fit, found, problem, coordinates);
    add_validity(fit, found);
    if (std::ranges::find(problem.model().parameters(), "sigma0", &FitParameter::name) !=
        problem.model().parameters().end())
        add_slope(fit, found, rough, best.cost);
    if (!fit.slope_alone) std::ranges::copy(found.uncertainty.statements, std::back_inserter(fit.statements));
    say_validity(fit);
    fit.material = problem.model().material_text(std::span{values}.first(values.size() - 1),
                                                 data.name + ", fitted " + request.model);
    return fit;
}

}  // namespace hts::validation
