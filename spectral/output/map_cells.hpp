/// Maps of coloured cells.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "spectral/output/script.hpp"

namespace hts::output {

/// A row of numbers left, right, bottom, top, colour per cell of a grid, from the lowest row up; neighbours
/// across that have one colour are one cell.
///   across, upwards   edges of the columns and rows
///   colour            "#d55e00" of a row and a column
[[nodiscard]] Rows map_cells(const std::vector<double>& across, const std::vector<double>& upwards,
                             const std::function<const char*(std::size_t row, std::size_t column)>& colour);

/// A colour "#d55e00" as gnuplot's `lc rgb variable` takes it.
[[nodiscard]] double colour_number(const char* colour);

}  // namespace hts::output
