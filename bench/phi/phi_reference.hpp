/// Phi(g, t) by sums in 50-digit arithmetic, against which the charts measure every method.
///
/// Shares nothing with the engine. `chart_test` compares it with the 80-digit values of
/// hts/tests/reference/phi.csv.
#pragma once

#include <cmath>

namespace hts::bench {

/// Phi to 32 digits, as a sum of two doubles, so that comparing adds no rounding of its own.
struct PhiReference {
    double value, remainder;

    /// |computed - Phi| / Phi; infinity for NaN, an infinity, and 0, which are failures of another kind.
    [[nodiscard]] double relative_error(double computed) const noexcept {
        const double error = std::fabs((computed - value) - remainder) / value;
        return std::isfinite(error) && computed != 0 ? error : HUGE_VAL;
    }
};

/// Least Phi that the charts ask for: below, doubles lose digits.
inline constexpr double least_phi = 1e-300;

///   g, t     positive, t possibly 0       value   0 where Phi < least_phi
///   method   every term about the largest; where there are many, the trapezoidal rule in m with Stirling's
///            series, by Poisson's sum formula as exact as the arithmetic
///   error    1e-30 relative
///   cost     about 1 ms
[[nodiscard]] PhiReference phi_reference(double g, double t);

}  // namespace hts::bench
