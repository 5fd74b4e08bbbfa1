#include "hts/unified/return_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/unified/return_factor_table.hpp"

namespace hts {
namespace {

/// Sum of coefficients times Chebyshev polynomials, by Clenshaw's recurrence.
template <std::size_t size, class Coefficient>
double chebyshev_sum(double x, Coefficient&& coefficient) {
    double next = 0, after = 0;
    for (std::size_t i = size; i-- > 1;) {
        const double here = 2 * x * next - after + coefficient(i);
        after = next;
        next = here;
    }
    return x * next - after + coefficient(0);
}

}  // namespace

ReturnFactor::ReturnFactor(double slope) noexcept : slope_{std::min(slope, 1.0)} {
    const double x = 2 * slope_ - 1;
    for (std::size_t j = 0; j < terms; ++j)
        coefficients_[j] =
            chebyshev_sum<return_factor_slopes>(x, [j](std::size_t i) { return return_factor_table[i][j]; });
    single_reflection_ = std::min(1.0, chebyshev_sum<return_factor_slopes>(
                                           x, [](std::size_t i) { return single_reflection_table[i]; }));
}

ReturnFactor::ReturnFactor(const Surface& surface) noexcept : ReturnFactor{surface.slope_width() / 2} {
    if (surface.isotropic()) return;
    constexpr int azimuths = 64;  // of half a turn, after which everything is the same again
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const double azimuth = std::numbers::pi * (i + 0.5) / azimuths;
        const Direction along = Direction::from_unit_vector({std::cos(azimuth), std::sin(azimuth), 0});
        sum += ReturnFactor{surface.slope_width(along) / 2}.single_reflection_;
    }
    single_reflection_ = sum / azimuths;
}

double ReturnFactor::operator()(const Direction& direction) const noexcept {
    const double width_sine = 2 * slope_ * direction.sin_theta();
    const double sum = width_sine + direction.cos_theta();
    const double y = sum > 0 ? width_sine / sum : 0;
    return chebyshev_sum<terms>(2 * y - 1, [this](std::size_t i) { return coefficients_[i]; });
}

}  // namespace hts
