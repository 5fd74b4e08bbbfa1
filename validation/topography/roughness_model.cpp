#include "validation/topography/roughness_model.hpp"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double least_nu = 0.05, greatest_nu = 8;  // above, no map tells it from the Gaussian

// Bessel functions of long doubles take five times as long.
using DoubleAlone = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

double correlation(const RoughnessScale& scale, double r) {
    const double x = r / scale.length;
    if (std::isinf(scale.nu)) return std::exp(-x * x);
    if (scale.nu == 0.5) return std::exp(-x);
    if (x < 1e-9) return 1;
    if (x > 100) return 0;  // below e^-80, whatever nu
    const double log_factor = (1 - scale.nu) * std::numbers::ln2 -
                              boost::math::lgamma(scale.nu, DoubleAlone{}) + scale.nu * std::log(x);
    return std::exp(log_factor) * boost::math::cyl_bessel_k(scale.nu, x, DoubleAlone{});
}

double spectrum(const RoughnessScale& scale, double f) {
    const double q = 2 * pi * f * scale.length;
    if (std::isinf(scale.nu)) return pi * scale.length * scale.length * std::exp(-q * q / 4);
    return 4 * pi * scale.nu * scale.length * scale.length * std::pow(1 + q * q, -scale.nu - 1);
}

double share_below(const RoughnessScale& scale, double f) {
    const double q = 2 * pi * f * scale.length;
    return std::isinf(scale.nu) ? -std::expm1(-q * q / 4) : -std::expm1(-scale.nu * std::log1p(q * q));
}

template <class Of>
double sum_over(const RoughnessScales& scales, const Of& of) {
    double sum = 0;
    for (const RoughnessScale& scale : scales) sum += scale.weight * of(scale);
    return sum;
}

// ---- coordinates: logarithms of lengths and nu, ln(w/(1 - w)) of a weight

std::vector<std::vector<double>> one_length(double length) {
    return {{std::log(length)}};
}
std::vector<Bounds> bounds_of_length(double shortest, double longest) {
    return {{std::log(shortest), std::log(longest)}};
}
RoughnessScales gaussian(std::span<const double> x) {
    return {{1, std::exp(x[0]), HUGE_VAL}};
}
RoughnessScales exponential(std::span<const double> x) {
    return {{1, std::exp(x[0]), 0.5}};
}
std::vector<RoughnessValue> correlation_length(const RoughnessScales& scales) {
    return {{"correlation_length_um", scales[0].length}};
}

std::vector<std::vector<double>> k_starts(double length) {
    return {{std::log(length), std::log(0.5)}, {std::log(length / 3), std::log(2.0)}};
}
std::vector<Bounds> k_bounds(double shortest, double longest) {
    return {{std::log(shortest), std::log(longest)}, {std::log(least_nu), std::log(greatest_nu)}};
}
RoughnessScales k_correlation(std::span<const double> x) {
    return {{1, std::exp(x[0]), std::exp(x[1])}};
}
std::vector<RoughnessValue> k_values(const RoughnessScales& scales) {
    return {{"length_um", scales[0].length},
            {"nu", scales[0].nu},
            {"B_um", 2 * pi * scales[0].length},
            {"C", 2 * scales[0].nu + 1}};
}

std::vector<std::vector<double>> two_starts(double length) {
    return {{std::log(1.3 * length), std::log(0.4 * length), 1},
            {std::log(1.1 * length), std::log(length / 6), 2}};
}
std::vector<Bounds> two_bounds(double shortest, double longest) {
    return {{std::log(shortest), std::log(longest)}, {std::log(shortest), std::log(longest)}, {-7, 7}};
}
RoughnessScales two_scales(std::span<const double> x) {
    const double first = 1 / (1 + std::exp(-x[2]));
    RoughnessScales scales{{first, std::exp(x[0]), HUGE_VAL}, {1 - first, std::exp(x[1]), HUGE_VAL}};
    if (scales[0].length < scales[1].length) std::swap(scales[0], scales[1]);
    return scales;
}
std::vector<RoughnessValue> two_values(const RoughnessScales& scales) {
    return {{"longer_length_um", scales[0].length},
            {"shorter_length_um", scales[1].length},
            {"weight_of_longer", scales[0].weight}};
}

constexpr std::array models{
    RoughnessModel{"gaussian", "Gaussian", 1, one_length, bounds_of_length, gaussian, correlation_length},
    RoughnessModel{"exponential", "exponential", 1, one_length, bounds_of_length, exponential,
                   correlation_length},
    RoughnessModel{"k_correlation", "K-correlation", 1, k_starts, k_bounds, k_correlation, k_values},
    RoughnessModel{"two_scales", "two Gaussian scales", 2, two_starts, two_bounds, two_scales, two_values}};

}  // namespace

double correlation(const RoughnessScales& scales, double r) {
    return sum_over(scales, [r](const RoughnessScale& scale) { return correlation(scale, r); });
}
double spectrum(const RoughnessScales& scales, double f) {
    return sum_over(scales, [f](const RoughnessScale& scale) { return spectrum(scale, f); });
}
double share_below(const RoughnessScales& scales, double f) {
    return sum_over(scales, [f](const RoughnessScale& scale) { return share_below(scale, f); });
}

std::span<const RoughnessModel> roughness_models() noexcept {
    return models;
}

}  // namespace hts::validation
