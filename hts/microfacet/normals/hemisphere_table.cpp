#include "hts/microfacet/normals/hemisphere_table.hpp"

#include <algorithm>
#include <cmath>

namespace hts {
namespace {

std::size_t column_count(NormalSymmetry symmetry, std::size_t per_quarter) {
    if (symmetry.isotropic) return 1;
    const std::size_t quarters =
        std::size_t{symmetry.mirror_x ? 1U : 2U} * std::size_t{symmetry.mirror_y ? 1U : 2U};
    return quarters * per_quarter + 1;
}

}  // namespace

HemisphereTable::HemisphereTable(const NormalDensity& density, std::size_t rows,
                                 std::size_t columns_per_quarter,
                                 const std::function<double(Vector3)>& function)
    : symmetry_{density.symmetry()},
      width_x_{density.width_x()},
      width_y_{density.width_y()},
      rows_{rows},
      columns_per_quarter_{columns_per_quarter},
      columns_{column_count(symmetry_, columns_per_quarter)} {
    values_.reserve(rows_ * columns_);
    for (std::size_t column = 0; column < columns_; ++column) {
        for (std::size_t row = 0; row < rows_; ++row) values_.push_back(function(node(row, column)));
    }
}

double HemisphereTable::turn(double x, double y) const noexcept {
    const double quarter = std::fabs(y) / (std::fabs(x) + std::fabs(y));
    if (symmetry_.mirror_x) return symmetry_.mirror_y ? quarter : 1 + std::copysign(quarter, y);
    const double half = x < 0 ? 2 - quarter : quarter;
    return symmetry_.mirror_y || !(y < 0) ? half : 4 - half;
}

Vector3 HemisphereTable::node(std::size_t row, std::size_t column) const {
    if (row + 1 == rows_) return {0, 0, 1};
    const std::size_t first = symmetry_.mirror_x && !symmetry_.mirror_y ? 3 : 0;  // -90 deg
    const std::size_t quarter = (first + column / columns_per_quarter_) % 4;
    const double part =
        static_cast<double>(column % columns_per_quarter_) / static_cast<double>(columns_per_quarter_);
    // within a quarter the coordinate runs from the x axis to the y axis, or back
    const double along = quarter % 2 == 0 ? part : 1 - part;
    const double x = (1 - along) * width_y_, y = along * width_x_, length = std::hypot(x, y);
    const double cos_phi = (quarter == 1 || quarter == 2 ? -x : x) / length;
    const double sin_phi = (quarter >= 2 ? -y : y) / length;
    const double w = std::hypot(width_x_ * cos_phi, width_y_ * sin_phi);
    const double share = static_cast<double>(row) / static_cast<double>(rows_ - 1);
    const double up = w * share / (1 + w - share);
    const double scale = 1 / (1 + up * up), sine = (1 - up) * (1 + up) * scale;
    return {sine * cos_phi, sine * sin_phi, 2 * up * scale};
}

HemisphereTable::Position HemisphereTable::position(Vector3 k) const noexcept {
    const double x = width_x_ * k.x, y = width_y_ * k.y;
    const double sine = std::sqrt(k.x * k.x + k.y * k.y), w = std::sqrt(x * x + y * y);  // w(phi) sin theta
    if (!(w > 0)) return {1, 0};
    return {k.z * (sine + w) / (k.z * sine + w * (1 + sine)), symmetry_.isotropic ? 0 : turn(x, y)};
}

double HemisphereTable::operator()(const Position& at) const noexcept {
    const double up = at.up * static_cast<double>(rows_ - 1);
    const auto row = std::min(static_cast<std::size_t>(up), rows_ - 2);
    const double part = up - static_cast<double>(row);
    const double* const from = &values_[row];
    if (columns_ == 1) return from[0] + part * (from[1] - from[0]);
    const double around = at.around * static_cast<double>(columns_per_quarter_);
    const auto column = std::min(static_cast<std::size_t>(around), columns_ - 2);
    const double* const low = from + column * rows_;
    const double* const high = low + rows_;
    const double first = low[0] + part * (low[1] - low[0]), second = high[0] + part * (high[1] - high[0]);
    return first + (around - static_cast<double>(column)) * (second - first);
}

}  // namespace hts
