/// Heights of a surface on a grid, as a profilometer measured them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hts/error.hpp"

namespace hts::validation {

/// Heights [um] by rows from the top, so that y falls from row to row; NaN where there is no value.
class HeightMap {
  public:
    /// Fewest and most points along a side: fewer hold no spectrum, more no computer's memory.
    static constexpr std::size_t fewest = 16, most = 8192, most_points = 4096UL * 4096UL;

    /// hts::Error "12 by 3 points: must be …" before anything is allocated.
    static void require_size(double columns, double rows);

    ///   name     what stands for the map in messages and tables
    ///   step_x   between neighbours of a row, step_y of a column [um], > 0
    ///   heights  [um]; of the points at least a quarter must have a value, and not all the same
    HeightMap(std::string name, std::size_t columns, std::size_t rows, double step_x, double step_y,
              std::vector<double> heights);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
    [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
    [[nodiscard]] double step_x() const noexcept { return step_x_; }
    [[nodiscard]] double step_y() const noexcept { return step_y_; }
    /// Of the field [um].
    [[nodiscard]] double width() const noexcept { return static_cast<double>(columns_) * step_x_; }
    [[nodiscard]] double height() const noexcept { return static_cast<double>(rows_) * step_y_; }
    [[nodiscard]] std::span<const double> heights() const noexcept { return heights_; }
    [[nodiscard]] double at(std::size_t column, std::size_t row) const {
        return heights_[row * columns_ + column];
    }
    /// How many points have a value.
    [[nodiscard]] std::size_t value_count() const noexcept { return value_count_; }

    /// The same points with other heights.
    [[nodiscard]] HeightMap with(std::vector<double> heights) const;

  private:
    std::string name_;
    std::size_t columns_, rows_, value_count_ = 0;
    double step_x_, step_y_;
    std::vector<double> heights_;
};

}  // namespace hts::validation
