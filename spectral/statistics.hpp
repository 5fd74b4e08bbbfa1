/// Averages and order statistics of a list; 0 of an empty one. Private to the libraries and the command.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace hts::spectral {

/// The value at a place of the sorted list.
///   place   from 0, the least; beyond the last place, the greatest
template <class Number>
[[nodiscard]] Number in_order(std::vector<Number> values, std::size_t place) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(place, values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The value that a share of the list is not above: at place floor(share (n - 1)), never between two values.
///   share   0 … 1
template <class Number>
[[nodiscard]] Number quantile(std::vector<Number> values, double share) {
    const auto last = static_cast<double>(values.size()) - 1;
    return in_order(std::move(values), last > 0 ? static_cast<std::size_t>(share * last) : 0);
}

/// The middle value, or the mean of the two in the middle.
[[nodiscard]] inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const std::size_t half = values.size() / 2;
    const double above = in_order(values, half);
    return values.size() % 2 == 1 ? above : (in_order(std::move(values), half - 1) + above) / 2;
}

[[nodiscard]] inline double root_mean_square(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) sum += x * x;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace hts::spectral
