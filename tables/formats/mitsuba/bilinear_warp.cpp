#include "tables/formats/mitsuba/bilinear_warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hts::tables {
namespace {

/// The cell of a coordinate that counts cells, the last one closed.
std::size_t cell_of(float coordinate, std::size_t nodes) noexcept {
    return std::min(static_cast<std::size_t>(std::max(0.0F, coordinate)), nodes - 2);
}

/// The largest i of 0 … count - 2 with sum(i) < s, 0 if there is none; sum rises.
template <class Sum>
std::size_t last_below(float s, std::size_t count, const Sum& sum) noexcept {
    std::size_t low = 0, high = count - 1;
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (sum(middle) < s ? low : high) = middle;
    }
    return low;
}

/// Where the integral of the line from a (at 0) to b (at 1) reaches s.
float line_inverse(float s, float a, float b) noexcept {
    if (std::abs(a - b) < 1e-4F * (a + b)) return 2 * s / (a + b);
    return (a - std::sqrt(std::max(a * a - 2 * s * (a - b), 0.0F))) / (a - b);
}

/// Integral of that line up to x.
float line_integral(float x, float a, float b) noexcept {
    return x * (a + 0.5F * x * (b - a));
}

/// Trapezoidal sums of `values`, from 0, into `sums`; returns the last.
double cumulate(const float* values, std::size_t count, float* sums) noexcept {
    double sum = 0;
    sums[0] = 0;
    for (std::size_t i = 1; i < count; ++i) {
        sum += 0.5 * (static_cast<double>(values[i - 1]) + static_cast<double>(values[i]));
        sums[i] = static_cast<float>(sum);
    }
    return sum;
}

float clamped(float s) noexcept {
    constexpr float epsilon = std::numeric_limits<float>::epsilon() / 2;
    return std::clamp(s, epsilon, 1 - epsilon);
}

}  // namespace

Between between(std::span<const float> nodes, float value) noexcept {
    if (nodes.size() < 2) return {0, 0};
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
    const auto index = static_cast<std::size_t>(above - nodes.begin()) - 1;
    const float weight = (value - nodes[index]) / (nodes[index + 1] - nodes[index]);
    return {index, std::clamp(weight, 0.0F, 1.0F)};
}

SliceMix slice_mix(Between first, Between second, std::size_t count0, std::size_t count1) noexcept {
    const std::size_t next0 = std::min(first.index + 1, count0 - 1);
    const std::size_t next1 = std::min(second.index + 1, count1 - 1);
    return {{first.index * count1 + second.index, first.index * count1 + next1, next0 * count1 + second.index,
             next0 * count1 + next1},
            {(1 - first.weight) * (1 - second.weight), (1 - first.weight) * second.weight,
             first.weight * (1 - second.weight), first.weight * second.weight}};
}

BilinearCell::BilinearCell(Point2 point, std::size_t rows, std::size_t columns) noexcept : stride_{columns} {
    const float x = point.x * static_cast<float>(columns - 1), y = point.y * static_cast<float>(rows - 1);
    const std::size_t column = cell_of(x, columns), row = cell_of(y, rows);
    const float right = x - static_cast<float>(column), up = y - static_cast<float>(row);
    first_ = row * columns + column;
    share_ = {(1 - up) * (1 - right), (1 - up) * right, up * (1 - right), up * right};
}

BilinearWarp::BilinearWarp(std::vector<float> densities, std::size_t rows, std::size_t columns)
    : rows_{rows},
      columns_{columns},
      densities_{std::move(densities)},
      conditional_(densities_.size()),
      marginal_(densities_.size() / columns) {
    for (std::size_t slice = 0; slice < densities_.size() / (rows * columns); ++slice) normalise(slice);
}

void BilinearWarp::normalise(std::size_t slice) {
    const std::size_t nodes = rows_ * columns_;
    float* const density = densities_.data() + slice * nodes;
    float* const conditional = conditional_.data() + slice * nodes;
    float* const marginal = marginal_.data() + slice * rows_;
    std::vector<float> totals(rows_);
    for (std::size_t row = 0; row < rows_; ++row)
        totals[row] =
            static_cast<float>(cumulate(density + row * columns_, columns_, conditional + row * columns_));
    const double total = cumulate(totals.data(), rows_, marginal);
    const auto scale = static_cast<float>(1 / total);
    for (std::size_t i = 0; i < nodes; ++i) {
        density[i] *= scale;
        conditional[i] *= scale;
    }
    for (std::size_t row = 0; row < rows_; ++row) marginal[row] *= scale;
}

bool BilinearWarp::has_integral(std::span<const float> slice, std::size_t rows, std::size_t columns) {
    std::vector<float> sums(columns), totals(rows), marginal(rows);
    for (std::size_t row = 0; row < rows; ++row)
        totals[row] = static_cast<float>(cumulate(slice.data() + row * columns, columns, sums.data()));
    const auto total = static_cast<float>(cumulate(totals.data(), rows, marginal.data()));
    return std::isfinite(total) && total >= std::numeric_limits<float>::min();
}

float BilinearWarp::mixed(const std::vector<float>& table, std::size_t slice_size, std::size_t at,
                          const SliceMix& mix) const noexcept {
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        if (mix.share[i] != 0) sum += mix.share[i] * table[mix.slice[i] * slice_size + at];
    return sum;
}

WarpedPoint BilinearWarp::sample(Point2 uniform, const SliceMix& mix) const noexcept {
    float s = clamped(uniform.y);
    const std::size_t row = last_below(s, rows_, [&](std::size_t i) { return below_row(i, mix); });
    const float total0 = row_total(row, mix), total1 = row_total(row + 1, mix);
    const float up = line_inverse(s - below_row(row, mix), total0, total1);
    s = clamped(uniform.x) * ((1 - up) * total0 + up * total1);
    const auto along = [&](std::size_t i) {
        return (1 - up) * along_row(row, i, mix) + up * along_row(row + 1, i, mix);
    };
    const std::size_t column = last_below(s, columns_, along);
    const float left = (1 - up) * node(row, column, mix) + up * node(row + 1, column, mix);
    const float right = (1 - up) * node(row, column + 1, mix) + up * node(row + 1, column + 1, mix);
    const float across = line_inverse(s - along(column), left, right);
    const auto columns = static_cast<float>(columns_ - 1), rows = static_cast<float>(rows_ - 1);
    return {{(static_cast<float>(column) + across) / columns, (static_cast<float>(row) + up) / rows},
            ((1 - across) * left + across * right) * columns * rows};
}

WarpedPoint BilinearWarp::inverse(Point2 point, const SliceMix& mix) const noexcept {
    const auto columns = static_cast<float>(columns_ - 1), rows = static_cast<float>(rows_ - 1);
    const float x = point.x * columns, y = point.y * rows;
    const std::size_t column = cell_of(x, columns_), row = cell_of(y, rows_);
    const float across = x - static_cast<float>(column), up = y - static_cast<float>(row);
    const float left = (1 - up) * node(row, column, mix) + up * node(row + 1, column, mix);
    const float right = (1 - up) * node(row, column + 1, mix) + up * node(row + 1, column + 1, mix);
    const float total0 = row_total(row, mix), total1 = row_total(row + 1, mix);
    const float before = (1 - up) * along_row(row, column, mix) + up * along_row(row + 1, column, mix);
    return {{(line_integral(across, left, right) + before) / ((1 - up) * total0 + up * total1),
             line_integral(up, total0, total1) + below_row(row, mix)},
            ((1 - across) * left + across * right) * columns * rows};
}

float BilinearWarp::density(Point2 point, const SliceMix& mix) const noexcept {
    const BilinearCell cell{point, rows_, columns_};
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        if (mix.share[i] != 0)
            sum += mix.share[i] * cell.value(densities_.data() + mix.slice[i] * rows_ * columns_);
    return sum * static_cast<float>(columns_ - 1) * static_cast<float>(rows_ - 1);
}

}  // namespace hts::tables
