/// The figure of distances from exact scattering: panels of coloured cells with the numbers in them. Private
/// to scattering/.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hts::validation {

/// A panel per row and column, all with the same cells.
struct DistanceMap {
    struct Cell {
        std::size_t row, column, x, y;
        double decibels;
    };
    std::string title, subtitle;
    std::vector<std::string> rows, columns;  ///< of panels, their titles
    std::vector<std::string> x, y;           ///< of cells, their names
    std::string x_label, y_label;
    std::vector<Cell> cells;

    /// For gnuplot.
    [[nodiscard]] std::string script() const;
};

}  // namespace hts::validation
