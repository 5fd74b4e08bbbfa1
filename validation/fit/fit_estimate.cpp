#include "validation/fit/fit_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hts::validation {
namespace {

/// Places in the list, as its numbers rise.
std::vector<std::size_t> in_order(const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> result(numbers.size());
    std::iota(result.begin(), result.end(), std::size_t{0});
    std::ranges::sort(result, {}, [&](std::size_t i) { return numbers[i]; });
    return result;
}

}  // namespace

bool at_bound(double coordinate, const Bounds& bounds) {
    const auto near = [&](double bound) {
        return std::abs(coordinate - bound) <= 1e-9 * std::max(1.0, std::abs(bound));
    };
    return near(bounds.lowest) || near(bounds.highest);
}

Estimate estimate(const FitProblem& problem, const FitData& data, const std::vector<double>& coordinates) {
    auto [residuals, all] = problem.residuals(coordinates, true);
    residuals.resize(data.values.size());  // those of energy are no data
    for (auto& column : all) column.resize(data.values.size());
    const auto values = problem.values(coordinates);
    Estimate result;
    Columns columns;
    for (const std::size_t k : in_order(problem.free())) {
        if (at_bound(coordinates[k], problem.bounds()[k])) continue;
        const std::size_t place = problem.free()[k];
        const FitParameter& parameter = problem.places()[place].parameter;
        result.places.push_back(place);
        result.parameters.push_back({parameter.name, parameter.range, values[place]});
        columns.push_back(all[k]);
    }
    result.scatter = {std::move(residuals), problem.change_with_gain(coordinates), data.curves};
    result.noise = noise(columns, result.scatter);
    result.uncertainty = uncertainty(result.parameters, columns, result.scatter, result.noise);
    return result;
}

std::optional<RoughPlaces> rough_places(const FitProblem& problem) {
    const auto sought = [&](const char* name) -> std::optional<std::size_t> {
        for (const std::size_t i : problem.free())
            if (problem.places()[i].parameter.name == name) return i;
        return std::nullopt;
    };
    const auto sigma0 = sought("sigma0"), tau = sought("tau");
    if (!sigma0 || !tau) return std::nullopt;
    return RoughPlaces{*sigma0, *tau};
}

RoughLimit rough_limit(const FitProblem& problem, const RoughPlaces& at, const FitRequest& request,
                       const FitData& data, const std::vector<double>& from) {
    constexpr double wavelengths = 20;  // so that phase variance is large up to grazing angles
    const auto& range = problem.places()[at.sigma0].parameter.range;
    const double sigma0 = std::min(
        std::max(wavelengths * data.wavelengths.micrometres().back(), from[at.sigma0]), range.highest);
    FitRequest held = request;
    held.fixed["sigma0"] = sigma0;
    held.starts.erase("sigma0");
    std::erase(held.freed, "sigma0");
    const FitProblem limit{held, data};
    auto start = from;
    start[at.sigma0] = sigma0;
    start[at.tau] *= sigma0 / from[at.sigma0];
    const auto found = local_minimum(limit.residuals_to_search(), limit.searched(start),
                                     limit.searched_bounds(), {request.most_iterations, 1e-12});
    const auto coordinates = limit.completed(found.x);
    RoughLimit result{found.cost, limit.values(coordinates), estimate(limit, data, coordinates), {}};
    const double tau = result.values[at.tau];
    const auto& [places, parameters, scatter, noise, uncertainty] = result.estimate;
    const auto place = static_cast<std::size_t>(std::ranges::find(places, at.tau) - places.begin());
    const double error =
        place < places.size() ? uncertainty.standard_errors[place] : std::numeric_limits<double>::infinity();
    result.slope = {sigma0 / tau, sigma0 / tau * error / tau};
    return result;
}

bool within_noise(const RoughLimit& rough, double cost, const Estimate& best) {
    const Noise &limit = rough.estimate.noise, &found = best.noise;
    const double spread = 3 * std::sqrt(2 / limit.freedom + 2 / found.freedom);  // of ln of their ratio
    if (limit.variance > std::exp(spread) * found.variance) return false;
    const Scatter& scatter = rough.estimate.scatter;
    std::vector<double> apart(best.scatter.residuals.size());
    for (std::size_t i = 0; i < apart.size(); ++i)
        apart[i] = scatter.residuals[i] - best.scatter.residuals[i];
    const double length = std::sqrt(std::inner_product(apart.begin(), apart.end(), apart.begin(), 0.0));
    if (!(length > 0)) return true;
    for (double& x : apart) x /= length;
    return 2 * (rough.cost - cost) <= 9 * limit.along(apart, scatter);
}

}  // namespace hts::validation
