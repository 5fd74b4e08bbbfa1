/// The coordinates in which lobes are tabulated: smooth in them, folded by every
/// symmetry. Private to the module.
///
/// With a the direction nearer to the horizon, b the other and phi the azimuth between them,
///   grazing   G(theta_a), G(theta) = asinh(k tan theta) / asinh(k tan 88 deg)
///   ratio     G(theta_b) / G(theta_a)
///   turn      asinh(m h c) / asinh(m h),  c = cos(phi/2),  h = 2 sqrt(sin theta_a sin theta_b) /
///             (cos theta_a + cos theta_b)
/// each 0 ... 1 for every pair up to 88 deg. They come from the slope of the half vector, on
/// which lobes depend most,
///   tan^2 theta_h = tan^2((theta_a - theta_b)/2) + h^2 c^2,
/// so turn is 0 in the mirror plane and the lobe's width fixes m; G makes steps of equal ratio in the cosine
/// near the horizon, where shadowing changes so. A lobe is even in grazing at 0 and in turn at 0.
#pragma once

#include <array>

#include "hts/he_torrance_spectrum.hpp"
#include "tables/table/table.hpp"

namespace hts::tables {

/// grazing, ratio, turn.
using Coordinates = std::array<double, 3>;

/// Directions to coordinates and back.
class CoordinateMap {
  public:
    explicit CoordinateMap(const TableSpacing& spacing) noexcept;

    /// Of a pair; directions nearer to the horizon than 88 deg as if at 88 deg.
    [[nodiscard]] Coordinates operator()(const DirectionPair& pair) const noexcept;
    /// Of one direction: its grazing.
    [[nodiscard]] double grazing(const Direction& direction) const noexcept;
    /// A pair with these coordinates.
    [[nodiscard]] DirectionPair pair(const Coordinates& coordinates) const noexcept;
    /// A direction with this grazing, azimuth 0.
    [[nodiscard]] Direction direction(double grazing) const noexcept;

  private:
    TableSpacing spacing_;
    double steepest_;  // asinh(k tan 88 deg)
};

}  // namespace hts::tables
