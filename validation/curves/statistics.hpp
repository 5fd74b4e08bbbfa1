/// Averages of a list; 0 of an empty one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace hts::validation {

/// The middle value, or the mean of the two in the middle.
[[nodiscard]] inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

[[nodiscard]] inline double root_mean_square(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) sum += x * x;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace hts::validation
