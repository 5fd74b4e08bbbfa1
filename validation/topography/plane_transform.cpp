#include "validation/topography/plane_transform.hpp"

#include <algorithm>
#include <unsupported/Eigen/FFT>

namespace hts::validation {
namespace {

/// Columns are gathered so many at a time, since a cache line holds some of them.
constexpr std::size_t block = 8;

template <class Transform>
void along_both(ComplexField& field, std::size_t columns, std::size_t rows, const Transform& transform) {
    Eigen::FFT<double> fft;
    ComplexField line(columns), transformed(columns);
    for (std::size_t j = 0; j < rows; ++j) {
        const auto first = field.begin() + static_cast<std::ptrdiff_t>(j * columns);
        std::copy_n(first, columns, line.begin());
        transform(fft, transformed, line);
        std::ranges::copy(transformed, first);
    }
    std::vector<ComplexField> lines(block, ComplexField(rows));
    transformed.resize(rows);
    for (std::size_t i = 0; i < columns; i += block) {
        const std::size_t count = std::min(block, columns - i);
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t k = 0; k < count; ++k) lines[k][j] = field[j * columns + i + k];
        }
        for (std::size_t k = 0; k < count; ++k) {
            transform(fft, transformed, lines[k]);
            lines[k].swap(transformed);
        }
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t k = 0; k < count; ++k) field[j * columns + i + k] = lines[k][j];
        }
    }
}

}  // namespace

void transform_forward(ComplexField& field, std::size_t columns, std::size_t rows) {
    along_both(field, columns, rows, [](auto& fft, auto& to, const auto& from) { fft.fwd(to, from); });
}

void transform_inverse(ComplexField& field, std::size_t columns, std::size_t rows) {
    along_both(field, columns, rows, [](auto& fft, auto& to, const auto& from) { fft.inv(to, from); });
}

}  // namespace hts::validation
