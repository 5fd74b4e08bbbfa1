/// What an instrument averages of a model, and how that changes with the model's parameters. Private to the
/// fits.
#pragma once

#include <span>
#include <vector>

#include "validation/fit/fit_model.hpp"
#include "validation/fit/least_squares.hpp"

namespace hts::validation {

/// A parameter that moves, and those tied to it.
struct Move {
    std::size_t parameter;             ///< place in FitModel::parameters
    std::vector<double> above, below;  ///< values of all parameters on both sides
    double step;                       ///< of what moves it, from below to above
};

struct Changes {
    std::vector<double> averages;  ///< Prediction::average
    Columns by;                    ///< derivatives of them, a column per move
};

/// Prediction::average for each of some lists of values.
[[nodiscard]] Columns averages(const FitModel& model, const Prediction& instrument,
                               const std::vector<std::vector<double>>& values);

/// Differences between both sides of each move, a lobe's from that lobe alone. Of He-Torrance they come from the
/// vector kernels, which answer some ten times sooner than its exact derivatives (hts/he_torrance_gradient.hpp).
[[nodiscard]] Changes changes(const FitModel& model, const Prediction& instrument,
                              const std::vector<double>& values, std::span<const Move> moves);

}  // namespace hts::validation
