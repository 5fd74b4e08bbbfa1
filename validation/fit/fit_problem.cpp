#include "validation/fit/fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hts/error.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t most_starts = 512;
/// Step of a difference: what central differences lose and what the last bits lose meet near it.
constexpr double difference = 1e-3;
/// A model this far below the data is as far as none.
constexpr double least_ratio = 1e-30;
/// A weight of exactly 0 would hide what its lobe could do.
constexpr double least_linear_start = 1e-4;

double coordinate(const ParameterRange& range, double value) {
    return range.motion == Motion::factors ? std::log(value) : value;
}

double value_at(const ParameterRange& range, double coordinate) {
    const double value = range.motion == Motion::factors ? std::exp(coordinate) : coordinate;
    return std::clamp(value, range.lowest, range.highest);
}

void require_within(const FitParameter& parameter, const char* what, double value) {
    const ParameterRange& range = parameter.range;
    if (value >= range.lowest && value <= range.highest) return;
    const std::string unit = range.unit == "1" ? "" : " " + range.unit;
    throw RequestError{parameter.name + ": " + what + " " + shortest(value) + unit + ": must be " +
                       shortest(range.lowest) + " ... " + shortest(range.highest) + unit};
}

/// sign(r) s sqrt(rho((r/s)^2)), whose square is what r counts for.
double robust(double residual, Loss loss, double scale) {
    const double r = std::abs(residual) / scale;
    double rho = r * r;
    if (loss == Loss::huber && r > 1) rho = 2 * r - 1;
    if (loss == Loss::cauchy) rho = std::log1p(rho);
    return std::copysign(scale * std::sqrt(rho), residual);
}

/// Its derivative.
double robust_slope(double residual, Loss loss, double scale) {
    const double r = std::abs(residual) / scale, squared = r * r;
    if (loss == Loss::huber && r > 1) return 1 / std::sqrt(2 * r - 1);
    if (loss == Loss::cauchy && squared > 0) return r / ((1 + squared) * std::sqrt(std::log1p(squared)));
    return 1;
}

FitLayout layout(const FitRequest& request, const FitData& data) {
    const auto um = data.wavelengths.micrometres();
    return {request.lobes, {um.begin(), um.end()}, data.channels, request.index, data.outside, request.films};
}

}  // namespace

FitProblem::FitProblem(const FitRequest& request, const FitData& data)
    : request_{request},
      data_{data},
      model_{request.model, layout(request, data)},
      separable_{data.instrument->is_affine() && request.residual != Residual::logarithmic &&
                 request.loss == Loss::squares && !request.conserve_energy} {
    if (!(request.loss_scale > 0))
        throw RequestError{"loss scale " + shortest(request.loss_scale) + ": must be > 0"};
    for (const FitParameter& parameter : model_.parameters()) places_.push_back({parameter});
    const ParameterRange scale{"scale",        "scale", "1", Motion::factors, 1e-3, 1e3, {1},
                               StartUnit::own, "",      true};
    places_.push_back({{scale, "", "scale"}});
    assign_roles();
    for (const Role role : {Role::searched, Role::separated}) {
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (places_[i].role == role) free_.push_back(i);
        if (role == Role::searched) searched_ = free_.size();
    }
    for (const std::size_t i : free_) {
        const ParameterRange& range = places_[i].parameter.range;
        bounds_.push_back({coordinate(range, range.lowest), coordinate(range, range.highest)});
    }
    if (data_.values.size() <= free_.size())
        throw Error{data_.name + ": " + std::to_string(data_.values.size()) + " values for " +
                    std::to_string(free_.size()) + " free parameters: must be more"};
    for (std::size_t i = 0; i < data_.values.size(); ++i) weights_.push_back(weight(i));
    if (request.conserve_energy) watch_.emplace(data_, weights_);
}

std::vector<std::size_t> FitProblem::named(const std::string& name) const {
    std::vector<std::size_t> found;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const FitParameter& parameter = places_[i].parameter;
        names.push_back(parameter.name);
        if (name == parameter.name || name == parameter.range.symbol || name == parameter.range.key)
            found.push_back(i);
    }
    if (!found.empty()) return found;
    if (!request_.index.empty() && (name == "n" || name == "k")) {
        throw RequestError{"parameter " + spectral::in_quotes(name) +
                           ": must not be asked for where the index is given, which holds it"};
    }
    throw RequestError{"parameter " + spectral::in_quotes(name) + " of model " +
                       spectral::in_quotes(request_.model) +
                       " is not known: " + spectral::must_be_one_of(name, names)};
}

void FitProblem::assign_roles() {
    for (Place& place : places_) {
        const ParameterRange& range = place.parameter.range;
        place.value = range.starts.front();
        if (range.fixed) place.role = Role::fixed;
        if (!range.tied_to.empty()) {
            place.role = Role::tied;
            place.tied = named(range.tied_to).front();
        }
    }
    for (const std::string& name : request_.freed)
        for (const std::size_t i : named(name)) places_[i].role = Role::searched;
    std::map<std::size_t, std::string> fixed_as;
    for (const auto& [name, value] : request_.fixed) {
        for (const std::size_t i : named(name)) {
            require_within(places_[i].parameter, "fixed at", value);
            for (const std::string& freed : request_.freed)
                if (std::ranges::count(named(freed), i) > 0)
                    throw RequestError{name + ": freed and fixed: must be one of both"};
            if (const auto [other, fresh] = fixed_as.emplace(i, name); !fresh)
                throw RequestError{other->second + " and " + name + " are one parameter: must be fixed once"};
            places_[i].role = Role::fixed;
            places_[i].value = value;
        }
    }
    for (const auto& [name, value] : request_.starts) {
        for (const std::size_t i : named(name)) {
            require_within(places_[i].parameter, "start", value);
            places_[i].parameter.range.starts = {value};
            places_[i].parameter.range.start_unit = StartUnit::own;
            places_[i].start_given = true;
        }
    }
    for (Place& place : places_) {
        const bool linear = place.parameter.range.motion == Motion::linear;
        if (separable_ && linear && place.role == Role::searched) place.role = Role::separated;
    }
}

double FitProblem::weight(std::size_t datum) const {
    switch (request_.residual) {
        case Residual::logarithmic:
        case Residual::relative:
            if (data_.values[datum] > 0) break;
            if (data_.noise_floor > 0 && request_.residual == Residual::logarithmic) return 1;
            throw Error{data_.name + ": value " + std::to_string(datum + 1) + " is " +
                        shortest(data_.values[datum]) + ": must be > 0 for " + name(request_.residual) +
                        " residuals"};
        case Residual::weighted:
            if (!data_.uncertainties.empty()) return 1 / data_.uncertainties[datum];
            throw Error{data_.name + ": no uncertainties: must be there for weighted residuals"};
        case Residual::cosine:
            return data_.cosines[datum];
    }
    return 1 / data_.values[datum];
}

double FitProblem::start_unit(std::size_t place, const std::vector<double>& values) const {
    const auto um = data_.wavelengths.micrometres();
    switch (places_[place].parameter.range.start_unit) {
        case StartUnit::wavelength:
            return std::sqrt(um.front() * um.back());
        case StartUnit::previous:
            return values[place - 1];
        case StartUnit::own:
            break;
    }
    return 1;
}

std::size_t FitProblem::choices(std::size_t place) const {
    const ParameterRange& range = places_[place].parameter.range;
    return range.motion == Motion::linear ? 1 : range.starts.size();
}

std::vector<std::vector<double>> FitProblem::starts() const {
    std::size_t all = 1;
    for (std::size_t k = 0; k < searched_; ++k) all *= choices(free_[k]);
    const std::size_t count = std::min(all, most_starts);
    std::vector<std::vector<double>> result;
    for (std::size_t s = 0; s < count; ++s) {
        result.push_back(start(all <= most_starts ? s : s * all / count + s % 7));
    }
    return result;
}

std::vector<double> FitProblem::start(std::size_t combination) const {
    auto values = this->values(std::vector<double>(free_.size(), 0));
    std::vector<std::size_t> linear;
    for (std::size_t k = 0; k < searched_; ++k) {
        const std::size_t i = free_[k];
        const ParameterRange& range = places_[i].parameter.range;
        const double start = range.starts[combination % choices(i)] * start_unit(i, values);
        values[i] = std::clamp(start, range.lowest, range.highest);
        combination /= choices(i);
        const bool follows = range.motion == Motion::linear && !places_[i].start_given;
        if (follows && data_.instrument->is_affine()) linear.push_back(i);
    }
    set_tied(values);
    if (!linear.empty()) values = best_linear(values, linear);
    for (const std::size_t i : linear) values[i] = std::max(values[i], least_linear_start);
    return searched(values);
}

std::vector<double> FitProblem::searched(std::span<const double> values) const {
    std::vector<double> coordinates;
    for (std::size_t k = 0; k < searched_; ++k) {
        coordinates.push_back(coordinate(places_[free_[k]].parameter.range, values[free_[k]]));
    }
    return coordinates;
}

void FitProblem::set_tied(std::vector<double>& values) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (places_[i].role == Role::tied) values[i] = values[places_[i].tied];
    }
}

std::vector<double> FitProblem::values(std::span<const double> coordinates) const {
    std::vector<double> result(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) result[i] = places_[i].value;
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
        result[free_[k]] = value_at(places_[free_[k]].parameter.range, coordinates[k]);
    }
    set_tied(result);
    return result;
}

Columns FitProblem::predictions(const std::vector<std::vector<double>>& values) const {
    auto of_model = values;
    for (auto& each : of_model) each.pop_back();  // the scale
    Columns result;
    for (const auto& column : averages(model_, *data_.instrument, of_model)) {
        const double scale = values[result.size()].back();
        result.push_back(data_.instrument->seen(column));
        for (std::size_t i = 0; i < result.back().size(); ++i) result.back()[i] *= scale_of(i, scale);
    }
    return result;
}

std::vector<double> FitProblem::predicted(const std::vector<double>& values) const {
    return predictions({values}).front();
}

std::vector<double> FitProblem::best_linear(std::vector<double> values,
                                            const std::vector<std::size_t>& linear) const {
    for (const std::size_t i : linear) values[i] = 0;
    std::vector<std::vector<double>> trials(linear.size() + 1, values);
    std::vector<Bounds> bounds;
    for (std::size_t k = 0; k < linear.size(); ++k) {
        trials[k + 1][linear[k]] = 1;
        const ParameterRange& range = places_[linear[k]].parameter.range;
        bounds.push_back({range.lowest, range.highest});
    }
    Columns columns = predictions(trials);
    const auto at_zero = std::move(columns.front());
    columns.erase(columns.begin());
    std::vector<double> target(at_zero.size());
    for (std::size_t j = 0; j < target.size(); ++j)
        target[j] = importance(j) * weights_[j] * (data_.values[j] - at_zero[j]);
    for (auto& column : columns) {
        for (std::size_t j = 0; j < column.size(); ++j)
            column[j] = importance(j) * weights_[j] * (column[j] - at_zero[j]);
    }
    const auto solution = bounded_linear_solution(columns, target, bounds);
    for (std::size_t k = 0; k < linear.size(); ++k) values[linear[k]] = solution[k];
    return values;
}

std::vector<double> FitProblem::completed(std::span<const double> searched) const {
    std::vector<double> result{searched.begin(), searched.end()};
    if (searched_ == free_.size()) return result;
    const std::vector<std::size_t> linear{free_.begin() + static_cast<std::ptrdiff_t>(searched_),
                                          free_.end()};
    const auto values = best_linear(this->values(searched), linear);
    for (const std::size_t i : linear) result.push_back(values[i]);
    return result;
}

double FitProblem::residual(double predicted, std::size_t datum) const {
    const double value = data_.values[datum], floor = data_.noise_floor;
    double plain = weights_[datum] * (predicted - value);
    if (request_.residual == Residual::logarithmic) {
        plain = floor > 0 ? *log_ratio(predicted, value, floor)
                          : std::log(std::max(predicted * weights_[datum], least_ratio));
    }
    return importance(datum) * robust(plain, request_.loss, request_.loss_scale);
}

double FitProblem::residual_slope(double predicted, std::size_t datum) const {
    double plain = weights_[datum] * (predicted - data_.values[datum]), slope = weights_[datum];
    if (request_.residual == Residual::logarithmic) {
        const double ratio = predicted * weights_[datum], floor = data_.noise_floor;
        plain = floor > 0 ? *log_ratio(predicted, data_.values[datum], floor)
                          : std::log(std::max(ratio, least_ratio));
        slope = floor > 0 ? 1 / std::hypot(predicted, 2 * floor) : ratio > least_ratio ? 1 / predicted : 0;
    }
    return importance(datum) * slope * robust_slope(plain, request_.loss, request_.loss_scale);
}

Move FitProblem::move(std::span<const double> coordinates, std::size_t k) const {
    const auto [lowest, highest] = bounds_[k];
    const ParameterRange& range = places_[free_[k]].parameter.range;
    const double x = coordinates[k];
    double below = x, above = x;
    if (range.motion == Motion::linear) {
        (x < (lowest + highest) / 2 ? above : below) =
            x < (lowest + highest) / 2 ? std::min(highest, x + 1) : std::max(lowest, x - 1);
    } else {
        double step = difference * std::max(1.0, std::abs(x));
        if (lowest == 0 && x > 0) step = std::min(step, std::max(0.1 * x, 1e-6));  // no logarithm
        below = std::max(lowest, x - step);
        above = std::min(highest, x + step);
    }
    std::vector<double> moved{coordinates.begin(), coordinates.end()};
    const auto values_at = [&](double place) {
        moved[k] = place;
        auto result = values(moved);
        result.pop_back();
        return result;
    };
    return {free_[k], values_at(above), values_at(below), above - below};
}

std::vector<Move> FitProblem::moves(std::span<const double> coordinates) const {
    std::vector<Move> result;
    for (std::size_t k = 0; k < free_.size(); ++k) {
        if (free_[k] < model_.parameters().size()) result.push_back(move(coordinates, k));
    }
    return result;
}

Linearised FitProblem::residuals(std::span<const double> coordinates, bool with_jacobian) const {
    const auto values = this->values(coordinates);
    const std::vector<double> of_model{values.begin(), values.end() - 1};
    const Prediction& instrument = *data_.instrument;
    const auto [averages, columns] =
        with_jacobian ? changes(model_, instrument, of_model, moves(coordinates))
                      : Changes{validation::averages(model_, instrument, {of_model}).front(), {}};
    const auto seen = instrument.seen(averages);
    const double scale = values.back();
    Linearised result;
    for (std::size_t r = 0; r < seen.size(); ++r)
        result.residuals.push_back(residual(scale_of(r, scale) * seen[r], r));
    if (!with_jacobian && watch_) watch_->add(result, model_, values, {}, free_);
    if (!with_jacobian) return result;
    auto column = columns.begin();
    for (const std::size_t i : free_) {
        // the scale, which comes last, multiplies what is seen
        const bool of_scale = i >= of_model.size();
        auto change = of_scale ? seen : instrument.change(averages, *column++);
        for (std::size_t r = 0; r < change.size(); ++r) {
            const double factor = scale_of(r, scale);
            if (of_scale && !has_scale(r)) change[r] = 0;
            change[r] *= factor * residual_slope(factor * seen[r], r);
        }
        result.jacobian.push_back(std::move(change));
    }
    if (watch_) watch_->add(result, model_, values, moves(coordinates), free_);
    return result;
}

std::vector<double> FitProblem::change_with_gain(std::span<const double> coordinates) const {
    auto result = predicted(values(coordinates));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] *= residual_slope(result[i], i);
    return result;
}

Residuals FitProblem::residuals_to_search() const {
    return [this](std::span<const double> x, bool with_jacobian) {
        return projected_residuals(x, with_jacobian);
    };
}

Linearised FitProblem::projected_residuals(std::span<const double> searched, bool with_jacobian) const {
    const auto coordinates = completed(searched);
    Linearised result = residuals(coordinates, with_jacobian);
    if (!with_jacobian || searched_ == free_.size()) return result;
    Columns separated;
    for (std::size_t k = searched_; k < free_.size(); ++k) {
        if (coordinates[k] > bounds_[k].lowest && coordinates[k] < bounds_[k].highest)
            separated.push_back(std::move(result.jacobian[k]));
    }
    result.jacobian.resize(searched_);
    result.jacobian = beside(result.jacobian, separated);
    return result;
}

}  // namespace hts::validation
