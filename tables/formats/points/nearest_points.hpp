/// Scattered points as a BRDF by nearness: at a pair of directions the eight nearest points count by the
/// inverse square of their distance in
///
///   4 theta_h,  theta_d,  2 sin theta_h sin theta_d cos 2 phi_d
///
/// of Rusinkiewicz' half and difference angles [Rusinkiewicz98]. These are the same for swapped directions
/// and on both sides of the plane of incidence: the surface is taken to be isotropic and reciprocal. Half
/// directions count most, since lobes depend on them. A pair is known within three times the middle distance
/// of neighbours. Private to the readers of points.
#pragma once

#include "tables/formats/points/scatter_points.hpp"

namespace hts::tables {

///   points   checked, at least one
[[nodiscard]] spectral::Reflectance nearest_points_brdf(const std::string& name, const ScatterPoints& points);

}  // namespace hts::tables
