#include "hts/phi/phi_far.hpp"

#include <cmath>
#include <limits>

#include "hts/phi/phi_sum.hpp"

namespace hts::phi_detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double log_of_nothing = -700;  // below ln 1e-300

bool is_valid(double g, double t) {
    return g >= 0 && t >= 0;
}

bool is_zero(double g, double t) {
    return g == 0 || g == infinity || t == infinity;
}

}  // namespace

Phi far_phi(double g, double t) noexcept {
    if (!is_valid(g, t)) return {nan, nan, PhiMethod::zero};
    if (is_zero(g, t)) return {0, -infinity, PhiMethod::zero};
    const PhiSum sum = phi_sum(g, t);
    return {std::exp(sum.log), sum.log, sum.method};
}

double far_phi_value(double g, double t) noexcept {
    if (!is_valid(g, t)) return nan;
    if (is_zero(g, t) || log_phi_bound(g, t) < log_of_nothing) return 0;
    return std::exp(phi_sum(g, t).log);
}

}  // namespace hts::phi_detail

namespace hts {

PhiGradient phi_gradient(double g, double t) noexcept {
    using namespace phi_detail;
    if (!is_valid(g, t)) return {nan, nan, nan, nan, nan, nan};
    if (g == 0) return {0, std::exp(-t), 0, -infinity, infinity, -1};
    if (is_zero(g, t)) return {0, 0, 0, -infinity, 0, 0};
    const PhiSum sum = phi_sum(g, t);
    const double value = std::exp(sum.log);
    const double value_over_g = g > 1e-290 ? value / g : std::exp(sum.log - std::log(g));
    return {value,          value_over_g * sum.excess, -value * sum.inverse_mean, sum.log,
            sum.excess / g, -sum.inverse_mean};
}

}  // namespace hts
