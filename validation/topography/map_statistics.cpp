#include "validation/topography/map_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace hts::validation {
namespace {

/// Root of the mean square of differences between points `apart` from one another.
double rms_slope(const HeightMap& map, std::size_t across, std::size_t down) {
    double sum = 0, count = 0;
    for (std::size_t j = down; j < map.rows(); ++j) {
        for (std::size_t i = across; i < map.columns(); ++i) {
            const double difference = map.at(i, j) - map.at(i - across, j - down);
            if (std::isnan(difference)) continue;
            sum += difference * difference;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / count) / (across > 0 ? map.step_x() : map.step_y()) : 0;
}

}  // namespace

bool HeightStatistics::gaussian() const noexcept {
    return std::fabs(skewness) <= 3 * skewness_error && std::fabs(kurtosis - 3) <= 3 * kurtosis_error;
}

HeightStatistics statistics_of(const HeightMap& map, const Autocorrelation& autocorrelation) {
    HeightStatistics result{};
    double mean = 0;
    for (const double z : map.heights()) mean += std::isnan(z) ? 0 : z;
    const auto count = static_cast<double>(map.value_count());
    mean /= count;
    double second = 0, third = 0, fourth = 0;
    result.lowest = HUGE_VAL, result.highest = -HUGE_VAL;
    for (const double z : map.heights()) {
        if (std::isnan(z)) continue;
        const double h = z - mean;
        second += h * h;
        third += h * h * h;
        fourth += h * h * h * h;
        result.mean_absolute += std::fabs(h) / count;
        result.lowest = std::min(result.lowest, h);
        result.highest = std::max(result.highest, h);
    }
    const double variance = second / count;
    result.rms = std::sqrt(variance);
    result.skewness = third / count / (variance * result.rms);
    result.kurtosis = fourth / count / (variance * variance);
    result.skewness_error = std::sqrt(6 * std::max(autocorrelation.cubes, 1 / count));
    result.kurtosis_error = std::sqrt(24 * std::max(autocorrelation.fourths, 1 / count));
    result.slope_x = rms_slope(map, 1, 0);
    result.slope_y = rms_slope(map, 0, 1);
    result.points = map.value_count();
    return result;
}

HeightStatistics pooled(const std::vector<HeightStatistics>& maps) {
    HeightStatistics result{};
    double points = 0, variance = 0, third = 0, fourth = 0, slope_x = 0, slope_y = 0;
    for (const HeightStatistics& map : maps) points += static_cast<double>(map.points);
    for (const HeightStatistics& map : maps) {
        const double share = static_cast<double>(map.points) / points, square = map.rms * map.rms;
        variance += share * square;
        third += share * map.skewness * square * map.rms;
        fourth += share * map.kurtosis * square * square;
        slope_x += share * map.slope_x * map.slope_x;
        slope_y += share * map.slope_y * map.slope_y;
        result.mean_absolute += share * map.mean_absolute;
        result.lowest = std::min(result.lowest, map.lowest);
        result.highest = std::max(result.highest, map.highest);
        result.skewness_error += share * share * map.skewness_error * map.skewness_error;
        result.kurtosis_error += share * share * map.kurtosis_error * map.kurtosis_error;
        result.points += map.points;
    }
    result.rms = std::sqrt(variance);
    result.skewness = third / (variance * result.rms);
    result.kurtosis = fourth / (variance * variance);
    result.skewness_error = std::sqrt(result.skewness_error);
    result.kurtosis_error = std::sqrt(result.kurtosis_error);
    result.slope_x = std::sqrt(slope_x);
    result.slope_y = std::sqrt(slope_y);
    return result;
}

}  // namespace hts::validation
