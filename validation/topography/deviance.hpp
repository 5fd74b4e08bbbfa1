/// The likelihood of powers as a sum of squares. Private to the room.
#pragma once

#include <cmath>

namespace hts::validation {

/// sign(u - 1) (2 (u - 1 - ln u))^(1/2), u = power over its expected value: n times its square is what the
/// likelihood of a mean of n exponentially distributed powers loses.
[[nodiscard]] inline double deviance_root(double u) noexcept {
    const double e = u - 1;
    if (std::fabs(e) < 1e-4) return e * (1 - e / 3);
    return std::copysign(std::sqrt(2 * (e - std::log(u))), e);
}
/// Its derivative by the logarithm of the expected value.
[[nodiscard]] inline double deviance_slope(double u) noexcept {
    const double e = u - 1;
    return std::fabs(e) < 1e-4 ? -(1 + e / 3) : -e / deviance_root(u);
}

}  // namespace hts::validation
