#include "hts/roughness.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hts/phi/lambert.hpp"

namespace hts {

double effective_roughness_ratio(double obstruction) noexcept {
    if (!(obstruction >= 0)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(obstruction)) return 0;
    constexpr double inverse_sqrt_8pi = std::numbers::inv_sqrtpi / (2 * std::numbers::sqrt2);
    return 1 / std::sqrt(1 + lambert_w0_of_square(obstruction * inverse_sqrt_8pi));
}

double effective_roughness_log_slope(double ratio) noexcept {
    return -ratio * ratio * (1 - ratio) * (1 + ratio);
}

double phase_variance(double effective_roughness, double vertical, const Wavelength& wavelength) noexcept {
    const double phase = wavelength.wave_number() * effective_roughness * vertical;
    return phase * phase;
}

}  // namespace hts
