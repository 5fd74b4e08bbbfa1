/// How well a fit predicts what it has not seen: angles of incidence are left out one at a time, the rest is
/// fitted again, and what was left out is predicted.
///
///     const CrossValidation result = cross_validated(fit, {&set, 1}, selection);
///     result.all.median_abs_log;   // of every point, each predicted by a fit without its angle
///
/// The angle of a curve is that of the direction that stands still: of the light, or where the light moves,
/// that of the viewer, which by reciprocity is the same. Of scattered pairs it is theta_i. More than ten
/// angles are left out in ten groups of neighbours.
#pragma once

#include <span>
#include <vector>

#include "validation/fit/fit.hpp"
#include "validation/fit/fit_curves.hpp"

namespace hts::validation {

/// How far predictions are from data, as FitStatistics has it.
struct PredictionError {
    std::size_t data = 0;
    double median_abs_log = 0, rms_log = 0, rms = 0, l2 = 0;
};

/// What was left out together.
struct LeftOut {
    double first_angle, last_angle;  ///< [deg]
    PredictionError error;
};

struct CrossValidation {
    std::vector<LeftOut> parts;  ///< by increasing angle
    PredictionError all;         ///< of all parts together
};

/// A fit with each angle of the first set left out; other sets stay. Searches start at the parameters of the
/// fit.
///   fit         of these sets and this selection
/// hts::Error where the first set has one angle alone.
[[nodiscard]] CrossValidation cross_validated(const Fit& fit, std::span<const CurveSet> sets,
                                              const FitSelection& selection);

}  // namespace hts::validation
