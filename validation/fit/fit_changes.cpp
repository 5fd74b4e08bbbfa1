#include "validation/fit/fit_changes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hts::validation {
namespace {

using Answers = std::vector<Prediction::Answer>;  // one per job

Prediction::Answer nothing(const Prediction::Job& job) {
    const std::size_t count = job.wavelengths.size();
    return {std::vector<double>(job.pairs.size() * count),
            std::vector<double>(job.incidences.size() * count)};
}

Prediction::Answer slope(const Prediction::Answer& above, const Prediction::Answer& below, double step) {
    const auto over = [&](const std::vector<double>& a, const std::vector<double>& b) {
        std::vector<double> result(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) result[i] = (a[i] - b[i]) / step;
        return result;
    };
    return {over(above.brdf, below.brdf), over(above.specular_reflectance, below.specular_reflectance)};
}

CurveSet hemispheres(const FitData& data) {
    const auto um = data.wavelengths.micrometres();
    CurveSet watched;
    watched.quantity = Quantity::hemispherical_reflectance;
    std::map<std::size_t, std::vector<double>> channels;
    for (std::size_t i = 0; i < um.size(); ++i) channels[data.channels[i]].push_back(um[i]);
    for (const auto& [channel, of_channel] : channels) {
        const double middle = of_channel[of_channel.size() / 2];
        Curve curve{{middle, middle}, Sweep::incident, {}};
        for (const double theta : {0.0, 45.0, 75.0})
            curve.points.push_back(in_plane_point(Sweep::incident, 0, theta, 0, 0));
        watched.curves.push_back(std::move(curve));
    }
    return watched;
}

/// What the root of the sum of squares changes by when all values double.
double size_of(const FitData& data, const std::vector<double>& weights) {
    double squares = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) squares += std::pow(weights[i] * data.values[i], 2);
    return std::sqrt(squares);
}

}  // namespace

Columns averages(const FitModel& model, const Prediction& instrument,
                 const std::vector<std::vector<double>>& values) {
    std::vector<FitTrial> trials;
    trials.reserve(values.size());
    for (const auto& each : values) trials.push_back({each});
    std::vector<Answers> answers(trials.size());
    for (const Prediction::Job& job : instrument.jobs()) {
        auto of_job = model.answers(trials, job);
        for (std::size_t i = 0; i < of_job.size(); ++i) answers[i].push_back(std::move(of_job[i]));
    }
    Columns result;
    for (const Answers& each : answers) result.push_back(instrument.average(each));
    return result;
}

Changes changes(const FitModel& model, const Prediction& instrument, const std::vector<double>& values,
                std::span<const Move> moves) {
    Answers all;
    std::vector<Answers> by_move(moves.size());
    for (const Prediction::Job& job : instrument.jobs()) {
        std::vector<FitTrial> trials{{values}};
        std::vector<bool> concerned;
        for (const Move& move : moves) {
            const FitParameter& parameter = model.parameters()[move.parameter];
            concerned.push_back(model.concerns(parameter, job));
            if (!concerned.back()) continue;
            trials.push_back({move.above, parameter.lobe});
            trials.push_back({move.below, parameter.lobe});
        }
        Answers answers = model.answers(trials, job);
        std::size_t next = 1;
        for (std::size_t m = 0; m < moves.size(); ++m) {
            by_move[m].push_back(concerned[m] ? slope(answers[next], answers[next + 1], moves[m].step)
                                              : nothing(job));
            next += concerned[m] ? 2U : 0U;
        }
        all.push_back(std::move(answers.front()));
    }
    Changes result{instrument.average(all), {}};
    for (const Answers& answers : by_move) result.by.push_back(instrument.average(answers));
    return result;
}

EnergyWatch::EnergyWatch(const FitData& data, const std::vector<double>& weights)
    : hemispheres_{hemispheres(data)}, weight_{20 * size_of(data, weights)}, absolute_{data.absolute} {}

void EnergyWatch::add(Linearised& result, const FitModel& model, const std::vector<double>& values,
                      std::span<const Move> moves, std::span<const std::size_t> free) const {
    const std::vector<double> of_model{values.begin(), values.end() - 1};
    const bool with_columns = !result.jacobian.empty();
    const auto [reflectances, columns] = with_columns
                                             ? changes(model, hemispheres_, of_model, moves)
                                             : Changes{averages(model, hemispheres_, {of_model}).front(), {}};
    // a surface brighter than its material reflects its multiple, where the data are absolute
    const double scale = absolute_ ? std::max(1.0, values.back()) : 1;
    const std::size_t count = reflectances.size();
    const auto exceeds = [&, &all = reflectances](std::size_t r) { return scale * all[r] > 1; };
    for (std::size_t r = 0; r < count; ++r)
        result.residuals.push_back(exceeds(r) ? weight_ * (scale * reflectances[r] - 1) : 0);
    if (!with_columns) return;
    auto column = columns.begin();
    for (std::size_t k = 0; k < free.size(); ++k) {
        const bool of_scale = free[k] >= of_model.size();
        std::vector<double> change(count);
        if (!of_scale) change = *column++;
        if (of_scale && scale > 1) change = reflectances;
        for (std::size_t r = 0; r < count; ++r)
            result.jacobian[k].push_back(exceeds(r) ? weight_ * scale * change[r] : 0);
    }
}

}  // namespace hts::validation
