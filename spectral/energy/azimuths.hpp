/// Means over azimuths of what a surface reflects.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "hts/error.hpp"

namespace hts::spectral {

/// Means of some quantities over azimuths, by the trapezoidal rule, twice as fine until that moves none of
/// them.
///   length     [rad] of azimuths, at whose ends the quantities mirror or repeat themselves: then the error
///              of the rule falls faster than any power of its step
///   coarsest   steps at least, a power of 2
///   error      absolute
///   of         the quantities at an azimuth, an array of doubles
/// hts::Error where 1024 azimuths do not suffice.
template <class Of>
[[nodiscard]] auto mean_over_azimuths(double first, double length, std::size_t coarsest, double error,
                                      Of&& of) {
    constexpr std::size_t most = 1024;
    auto mean = of(first);
    const auto last = of(first + length);
    for (std::size_t q = 0; q < mean.size(); ++q) mean[q] = (mean[q] + last[q]) / 2;
    for (std::size_t intervals = 1; intervals < most; intervals *= 2) {
        decltype(mean) between{};  // in the middle of each interval
        for (std::size_t i = 0; i < intervals; ++i) {
            const auto at =
                of(first + length * (static_cast<double>(i) + 0.5) / static_cast<double>(intervals));
            for (std::size_t q = 0; q < mean.size(); ++q)
                between[q] += at[q] / static_cast<double>(intervals);
        }
        double moved = 0;
        for (std::size_t q = 0; q < mean.size(); ++q) {
            moved = std::max(moved, std::abs(between[q] - mean[q]) / 2);
            mean[q] = (mean[q] + between[q]) / 2;
        }
        if (2 * intervals >= coarsest && moved <= error) return mean;
    }
    throw Error{"mean over azimuths: " + std::to_string(most) + " of them do not settle it to " +
                shortest(error) + ": the surface must not be so anisotropic"};
}

}  // namespace hts::spectral
