/// What an instrument averages of a model, how that changes with the model's parameters, and what of it must
/// not exceed 1. Private to the fits.
#pragma once

#include <span>
#include <vector>

#include "validation/fit/fit_data.hpp"
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

/// Differences between both sides of each move, a lobe's from that lobe alone. Of He-Torrance they come from
/// the vector kernels, which answer some ten times sooner than its exact derivatives
/// (hts/he_torrance_gradient.hpp).
[[nodiscard]] Changes changes(const FitModel& model, const Prediction& instrument,
                              const std::vector<double>& values, std::span<const Move> moves);

// ---- what is no datum

/// Reflectances into all directions, of light at 0, 45 and 75 deg at the middle wavelength of each channel.
/// Each above 1 is a residual: so heavy that a thousandth too much costs what all
/// data do that are off by 2 %.
class EnergyWatch {
  public:
    ///   weights   of the data's differences
    EnergyWatch(const FitData& data, const std::vector<double>& weights);

    /// Adds rows to the residuals and, where there are columns, to each of those.
    ///   values   of all parameters, the scale last      moves   of the free parameters of the model
    ///   free     places of all free parameters, a column each
    void add(Linearised& result, const FitModel& model, const std::vector<double>& values,
             std::span<const Move> moves, std::span<const std::size_t> free) const;

  private:
    Prediction hemispheres_;
    double weight_;
    bool absolute_;
};

}  // namespace hts::validation
