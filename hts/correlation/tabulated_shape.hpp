// Shapes of correlation from tables: of a power spectrum, of a correlation function. Not installed.
#pragma once

#include <span>
#include <vector>

#include "hts/correlation/height_shape.hpp"

namespace hts::correlation_detail {

/// A curve through points, by monotone cubic pieces between logarithms [Fritsch, Butland 1984]; a
/// power of x beyond either end.
class LogCurve {
  public:
    ///   x   increasing      values   > 0
    LogCurve(std::span<const double> x, std::span<const double> values);

    /// ln of the value, and its slope d ln(value)/d ln x.
    struct Value {
        double log, slope;
    };
    [[nodiscard]] Value operator()(double log_x) const noexcept;
    /// The power of x that fits the last points best, those within a factor of 3 of the end, two at least.
    [[nodiscard]] double last_power() const noexcept { return last_power_; }
    [[nodiscard]] double first_log_x() const noexcept { return log_x_.front(); }
    [[nodiscard]] double last_log_x() const noexcept { return log_x_.back(); }
    [[nodiscard]] const std::vector<double>& log_values() const noexcept { return log_values_; }

  private:
    std::vector<double> log_x_, log_values_, slopes_;
    double last_power_;
};

/// A shape that has been made of a table, with the scales its x and its variance are in.
struct ScaledShape {
    ShapePointer shape;
    double length;    ///< where C = 1/e: in units of the table
    double variance;  ///< of the heights, by the table and what continues it
};

/// A power spectrum over frequencies f: held below the first, beyond the last 0 (over a twentieth, in ln f)
/// or continued as the power of f that it ends with.
///   density   S2(f) > 0, with variance = integral of S2 2 pi f df
[[nodiscard]] ScaledShape spectrum_shape(std::span<const double> frequency, std::span<const double> density,
                                         bool continued);

/// S2 = 1/(1 + f^2)^(slope/2), which ends at f = periods as a table does.
[[nodiscard]] ScaledShape fractal_shape(double slope, double periods);

/// S2 from a profile's one-sided spectrum S1, by Abel's transform: S2(f) = -1/(2 pi) integral of S1'(f cosh
/// s) ds over s > 0, S1 continued beyond the last frequency as the power of f that it ends with. May be
/// negative where S1 rises.
[[nodiscard]] std::vector<double> abel_transform(std::span<const double> frequency,
                                                 std::span<const double> density);

/// A correlation function over distances > 0, beside C(0) = 1: 1 - C a power of the distance below the first;
/// beyond the last, C falls to 0 within a distance as long again.
/// hts::Error where its spectrum is negative by more than most_negative of its greatest
/// value; less is taken for 0.
[[nodiscard]] ScaledShape autocorrelation_shape(std::span<const double> distance,
                                                std::span<const double> correlation);
inline constexpr double most_negative = 1e-2;

}  // namespace hts::correlation_detail
