#include "hts/phi/lambert.hpp"

#include <cmath>

#include <boost/math/special_functions/lambert_w.hpp>

namespace hts {

double lambert_w0_of_square(double a) noexcept {
    constexpr double largest_to_square = 1e140;
    return a < largest_to_square ? boost::math::lambert_w0(a * a) : lambert_w0_of_exp(2 * std::log(a));
}

double lambert_w0_of_exp(double logarithm) noexcept {
    // Newton's method for w + ln w = logarithm, which is almost linear there.
    double w = logarithm - std::log(logarithm);
    for (int step = 0; step < 4; ++step) w -= (w + std::log(w) - logarithm) / (1 + 1 / w);
    return w;
}

}  // namespace hts
