/// The lobe of a reflectance about the mirror direction, seen from outside: how wide it is, and where to look
/// for it. Private to the exchange formats and their round trip.
///
/// A facet of slopes (x, y) has the normal (x, y, 1)/sqrt(1 + x^2 + y^2).
#pragma once

#include <optional>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Slope, along the radius, at which the lobe of light along the normal has fallen to half between its value
/// at the mirror direction and the least value; the narrowest over all wavelengths and two azimuths.
///   range   1e-5 ... 1, 1 where there is no lobe
[[nodiscard]] double lobe_slope(const spectral::Reflectance& brdf);

/// The normal of a facet of given slopes.
[[nodiscard]] Vector3 facet_normal(double slope_x, double slope_y) noexcept;

/// Where the facet of normal m mirrors `in`: 2 (in.m) m - in, a unit vector that may point below the horizon.
[[nodiscard]] Vector3 mirrored(const Direction& in, Vector3 m) noexcept;

/// The bisecting facet's normal of a pair.
[[nodiscard]] Vector3 bisector(const DirectionPair& pair) noexcept;

/// Directions of view in the plane of incidence among which the largest BRDF is sought: every 3 degrees, and
/// about the mirror direction as finely as a lobe of the given slope needs.
///   largest_theta   polar angle up to which views are of interest [rad]
[[nodiscard]] std::vector<Direction> views_of_the_plane_of_incidence(const Direction& in, double slope,
                                                                     double largest_theta);

/// Per wavelength the largest BRDF [1/sr] over those views.
[[nodiscard]] std::vector<double> lobe_peaks(const spectral::Reflectance& brdf, const Direction& in,
                                             double slope, double largest_theta);

}  // namespace hts::tables
