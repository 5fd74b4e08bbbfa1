#include "validation/fit/fit_changes.hpp"

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

}  // namespace

Columns averages(const FitModel& model, const Prediction& instrument,
                 const std::vector<std::vector<double>>& values) {
    std::vector<FitTrial> trials;
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

}  // namespace hts::validation
