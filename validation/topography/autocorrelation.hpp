/// Autocorrelation of height maps, and that of the windows through which they are seen.
#pragma once

#include <vector>

#include "validation/topography/map_spectrum.hpp"

namespace hts::validation {

/// C(r) averaged over directions, from r = 0 to half of the shorter side, where it is 1 at r = 0.
struct Autocorrelation {
    std::vector<double> distance, value;  ///< [um], [1]
    /// Sums of C^3 and C^4 over all distances of the plane, per point of the map: skewness and kurtosis of
    /// Gaussian heights have the variances 6 cubes and 24 fourths.
    double cubes, fourths;

    /// Distance where it has fallen to 1/e; 0 where it does not.
    [[nodiscard]] double length() const;
    /// tau of C = exp(-(r/tau)^2) through the value at a distance, 0 where it is not below 1.
    [[nodiscard]] double gaussian_length_at(double r) const;
};

/// Of the heights about their mean. Each distance counts as many pairs of points as the map has there;
/// gaps have no part in it.
[[nodiscard]] Autocorrelation autocorrelation_of(const HeightMap& map);

/// Distances between points of a map, and how much of the window's energy they join.
struct Lag {
    double distance;  ///< [um], as the ellipse counts it
    double weight;    ///< [um^2]: step_x step_y sum w(r) w(r + lag) / sum w^2
};

/// Of all pairs. The spectrum that a map of autocorrelation C is expected to show through its window, mean
/// over the directions of frequency f, is sum weight C(distance) J0(2 pi f distance): leakage, gaps, the end
/// of the field and points that are a step apart are in it.
[[nodiscard]] std::vector<Lag> window_lags(const HeightMap& map, const MapWindow& window,
                                           const Ellipse& ellipse = {});

}  // namespace hts::validation
