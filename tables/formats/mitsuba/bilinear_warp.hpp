/// Densities over the unit square, bilinear between the nodes of a grid and linear in two parameters, with
/// the map that turns uniform points into points of that density, in single precision, step by step as the
/// readers of RGL files do it, so that a file written here means there what it means
/// here. Private to rgl.cpp.
///
/// Points are (x, y), x along the columns of a slice and y along its rows, from 0 to 1.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hts::tables {

struct Point2 {
    float x, y;
};

/// Between node `index` and the next, `weight` of the way; values outside the nodes belong to the end ones.
struct Between {
    std::size_t index;
    float weight;
};
///   nodes   increasing, at least one
[[nodiscard]] Between between(std::span<const float> nodes, float value) noexcept;

/// Up to four slices and the share of each.
struct SliceMix {
    std::array<std::size_t, 4> slice;
    std::array<float, 4> share;
};
/// Of slices that are laid out first by one parameter, then by the other.
///   count1   number of nodes of the second parameter
[[nodiscard]] SliceMix slice_mix(Between first, Between second, std::size_t count0,
                                 std::size_t count1) noexcept;

/// Where a point lies on a grid of rows x columns nodes, and its bilinear shares.
class BilinearCell {
  public:
    BilinearCell(Point2 point, std::size_t rows, std::size_t columns) noexcept;

    /// Of one slice.
    [[nodiscard]] float value(const float* slice) const noexcept {
        const float* upper = slice + first_ + stride_;
        return share_[0] * slice[first_] + share_[1] * slice[first_ + 1] + share_[2] * upper[0] +
               share_[3] * upper[1];
    }

  private:
    std::size_t first_, stride_;
    std::array<float, 4> share_;
};

/// A point, and the density there.
struct WarpedPoint {
    Point2 point;
    float density;
};

class BilinearWarp {
  public:
    ///   densities   slices of rows x columns nodes, >= 0; each slice has an integral > 0, and is normalised
    ///   rows, columns   >= 2
    BilinearWarp(std::vector<float> densities, std::size_t rows, std::size_t columns);

    /// From a uniform point to a point of the density.
    [[nodiscard]] WarpedPoint sample(Point2 uniform, const SliceMix& mix) const noexcept;
    /// Its inverse; the density is the one at `point`, before the inversion.
    [[nodiscard]] WarpedPoint inverse(Point2 point, const SliceMix& mix) const noexcept;
    [[nodiscard]] float density(Point2 point, const SliceMix& mix) const noexcept;

    /// Whether a slice can be normalised: its integral is a positive number.
    [[nodiscard]] static bool has_integral(std::span<const float> slice, std::size_t rows,
                                           std::size_t columns);

  private:
    [[nodiscard]] float mixed(const std::vector<float>& table, std::size_t slice_size, std::size_t at,
                              const SliceMix& mix) const noexcept;
    [[nodiscard]] float node(std::size_t row, std::size_t column, const SliceMix& mix) const noexcept {
        return mixed(densities_, rows_ * columns_, row * columns_ + column, mix);
    }
    /// Integral of a row up to a column.
    [[nodiscard]] float along_row(std::size_t row, std::size_t column, const SliceMix& mix) const noexcept {
        return mixed(conditional_, rows_ * columns_, row * columns_ + column, mix);
    }
    [[nodiscard]] float row_total(std::size_t row, const SliceMix& mix) const noexcept {
        return along_row(row, columns_ - 1, mix);
    }
    /// Integral of all rows up to one.
    [[nodiscard]] float below_row(std::size_t row, const SliceMix& mix) const noexcept {
        return mixed(marginal_, rows_, row, mix);
    }
    void normalise(std::size_t slice);

    std::size_t rows_, columns_;
    std::vector<float> densities_, conditional_, marginal_;
};

}  // namespace hts::tables
