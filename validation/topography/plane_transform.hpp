/// Discrete Fourier transforms of a rectangle of samples, by Eigen. Private to validation.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace hts::validation {

using ComplexField = std::vector<std::complex<double>>;

/// In place, rows and then columns; sizes of products of 2, 3 and 5 are quick. The forward one has no factor,
/// the inverse one 1/(columns rows).
///   field   by rows, columns * rows samples
void transform_forward(ComplexField& field, std::size_t columns, std::size_t rows);
void transform_inverse(ComplexField& field, std::size_t columns, std::size_t rows);

/// Index of a frequency in cycles per rectangle: 0, 1, …, then the negative ones to -1.
[[nodiscard]] inline double signed_frequency(std::size_t index, std::size_t samples) noexcept {
    return static_cast<double>(index) - (2 * index > samples ? static_cast<double>(samples) : 0);
}

}  // namespace hts::validation
