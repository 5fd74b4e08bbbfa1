/// Least squares within bounds: linear ones exactly, others by Ceres Solver. Private to the fits.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "spectral/jobs/progress.hpp"

namespace hts::validation {

struct Bounds {
    double lowest, highest;
};

/// Columns of a matrix, all of one length.
using Columns = std::vector<std::vector<double>>;

/// The x within bounds that minimises |sum_j x_j columns_j - target|^2, the global minimum. Columns that are
/// 0 or depend on others leave x at a bound.
[[nodiscard]] std::vector<double> bounded_linear_solution(const Columns& columns,
                                                          std::span<const double> target,
                                                          const std::vector<Bounds>& bounds);

/// What is left of columns beside others: each less its projection on the space that the others span.
[[nodiscard]] Columns beside(const Columns& columns, const Columns& others);

/// Residuals at a point, always as many, and their derivatives, a column per coordinate.
struct Linearised {
    std::vector<double> residuals;
    Columns jacobian;  ///< empty where it was not asked for
};
/// Must be total within the bounds.
using Residuals = std::function<Linearised(std::span<const double> x, bool with_jacobian)>;

struct Minimum {
    std::vector<double> x;
    double cost;  ///< sum of squares / 2
    int iterations;
    bool converged;
};

/// When a search ends.
struct Stopping {
    int most_iterations;
    double least_gain;                                  ///< of a step, relative to the sum of squares
    bool (*asked_to_stop)() = spectral::asked_to_stop;  ///< before a step; the point is then no minimum
};

/// Half the sum of squares.
[[nodiscard]] inline double half_sum_of_squares(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum / 2;
}

/// A local minimum of the sum of squares within bounds, by Levenberg and Marquardt's method from a start
/// within them. The same bits for the same start.
[[nodiscard]] Minimum local_minimum(const Residuals& residuals, std::vector<double> start,
                                    const std::vector<Bounds>& bounds, const Stopping& stopping);

/// The type of `local_minimum`, and of what the module of Ceres Solver has.
using LocalMinimum = Minimum(const Residuals&, std::vector<double>, const std::vector<Bounds>&,
                             const Stopping&);

}  // namespace hts::validation
