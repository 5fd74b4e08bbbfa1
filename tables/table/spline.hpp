/// Interpolation by cubic B-splines on equally spaced nodes of [0, 1]. Private to the module.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace hts::tables {

/// How a spline ends at 0; at 1 it is always free, its last two pieces one polynomial.
enum class SplineStart {
    even,  ///< its function is even about 0
    free
};

/// A spline over n nodes has n + 2 coefficients.
inline constexpr std::size_t spline_ghosts = 2;
/// Fewest nodes of a spline.
inline constexpr std::size_t fewest_nodes = 5;

/// Turns values at nodes into coefficients, in place.
///   block   [outer][nodes + 2][inner]; values stand at 1 ... nodes of the middle index, the
///           places around them are free
///   nodes   from fewest_nodes
void to_spline_coefficients(std::span<double> block, std::size_t nodes, std::size_t inner,
                            SplineStart start) noexcept;

/// The four coefficients that a place needs and their weights.
struct SplinePlace {
    std::size_t first;
    std::array<double, 4> weights;
};

///   x   clamped to 0 ... 1
[[nodiscard]] SplinePlace spline_place(double x, std::size_t nodes) noexcept;

}  // namespace hts::tables
