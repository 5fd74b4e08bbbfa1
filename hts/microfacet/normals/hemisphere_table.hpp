/// A smooth function of a direction above the surface, tabulated by its symmetry and interpolated bilinearly.
///
/// Rows are even in y (1 + w)/(y + w), y = cos theta/(1 + sin theta), so that they crowd at the horizon over
/// the width w(phi); columns are even in the quarter turns' own coordinate s w_y/(c w_x + s w_y), of |cos
/// phi|, |sin phi|. Only what the symmetry leaves is kept: one column, a quarter, a half or the whole turn.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "hts/direction.hpp"
#include "hts/microfacet/normals/normal_density.hpp"

namespace hts {

class HemisphereTable {
  public:
    /// Where a direction lies in all tables of a density.
    struct Position {
        double up;      ///< from the horizon, 0 ... 1
        double around;  ///< in quarter turns from the first column
    };

    /// The value of `function` at every node; the density says symmetry and widths.
    ///   rows   >= 2     columns_per_quarter   >= 1
    HemisphereTable(const NormalDensity& density, std::size_t rows, std::size_t columns_per_quarter,
                    const std::function<double(Vector3)>& function);

    /// Of a direction.    k   unit vector, k.z >= 0
    [[nodiscard]] Position position(Vector3 k) const noexcept;
    /// Interpolated.    at   by this table or another of the same density
    [[nodiscard]] double operator()(const Position& at) const noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }

  private:
    /// Position::around; x and y stretched by the widths, not both 0.
    [[nodiscard]] double turn(double x, double y) const noexcept;
    [[nodiscard]] Vector3 node(std::size_t row, std::size_t column) const;

    NormalSymmetry symmetry_;
    double width_x_, width_y_;
    std::size_t rows_, columns_per_quarter_, columns_;
    std::vector<double> values_;  // column by column, each from the horizon up
};

}  // namespace hts
