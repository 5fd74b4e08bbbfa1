/// Sines and cosines of directions in degrees for many directions at once, by vectors. Private to the
/// directions.
///
/// A vector's value is taken where it is certain to be the double that half_turns.hpp gives; the rest, some
/// in 100 directions, is left to that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hts::angles_detail {

/// sin and cos of pi i / 256, i = 0 ... 64, each as a double and what that leaves.
struct OctantTable {
    enum Column : std::size_t { sine, sine_rest, cosine, cosine_rest, columns };
    alignas(64) std::array<double, 65 * columns> values;
};
[[nodiscard]] const OctantTable& octant_table();

/// Directions side by side.
struct DirectionColumns {
    static constexpr std::size_t size = 64;

    template <class Value>
    using Column = std::array<Value, size>;
    alignas(64) Column<double> theta, phi;                              ///< [degrees]
    alignas(64) Column<double> cos_theta, sin_theta, cos_phi, sin_phi;  ///< results
};

/// Computes the results of all directions.
///   returns   a bit for each direction whose results are not certain
[[nodiscard]] std::uint64_t turn(const OctantTable& octant, DirectionColumns& columns) noexcept;

}  // namespace hts::angles_detail
