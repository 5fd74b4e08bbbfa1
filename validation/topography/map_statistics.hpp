/// What a map's heights are distributed like.
#pragma once

#include "validation/topography/autocorrelation.hpp"

namespace hts::validation {

/// Of the heights about their level. Errors are those that a map of so few correlation lengths leaves, of a
/// Gaussian surface of its autocorrelation [Lomnicki 1961].
struct HeightStatistics {
    double rms, mean_absolute, lowest, highest;  ///< [um]
    double skewness, skewness_error;
    double kurtosis, kurtosis_error;  ///< 3 of a Gaussian
    double slope_x, slope_y;          ///< rms of differences of neighbours over their distance
    std::size_t points;

    /// Whether skewness and kurtosis are those of Gaussian heights, within three errors each.
    [[nodiscard]] bool gaussian() const noexcept;
};

[[nodiscard]] HeightStatistics statistics_of(const HeightMap& map, const Autocorrelation& autocorrelation);

/// Of several maps of one surface, each point counting alike.
[[nodiscard]] HeightStatistics pooled(const std::vector<HeightStatistics>& maps);

}  // namespace hts::validation
