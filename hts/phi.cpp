#include "hts/phi.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/gamma.hpp>

#include "hts/lambert.hpp"

// The summand is exp(E(m)) with E(m) = m ln g - ln m! - ln m - t/m - g. For large m its maximum is at m* = g
// exp(w), w = W_0(2t/g^2)/2, where t = w m*^2, and its curvature there gives the width s = sqrt(m* / (1 +
// 2w)).

namespace hts {
namespace {

constexpr double negligible = 1e-18;  // a term this small beside the total ends a sum
constexpr double half_log_two_pi = 0.91893853320467274178;

/// Where the summand peaks.
struct Peak {
    double m;          ///< m*
    double log_ratio;  ///< w = ln(m*/g)
    double width;      ///< s
};

Peak peak_of_summand(double g, double t) {
    const double ratio = std::numbers::sqrt2 * std::sqrt(t) / g;
    const double w =
        (std::isfinite(ratio) ? lambert_w0_of_square(ratio)
                              : lambert_w0_of_exp(std::log(2.0) + std::log(t) - 2 * std::log(g))) /
        2;
    // g exp(w) where w is small; sqrt(t/w) elsewhere, since exp(w) may overflow
    const double m = w < 1 ? g * std::exp(w) : std::sqrt(t / w);
    return {m, w, std::sqrt(m / (1 + 2 * w))};
}

/// ln(m!) - (m + 1/2) ln m + m - ln(2 pi)/2, Stirling's series; relative to 1 better than 1e-17 for m >= 10.
double stirling_remainder(double m) {
    const double r = 1 / m;
    const double q = r * r;
    return r * (1.0 / 12 - q * (1.0 / 360 - q * (1.0 / 1260 - q * (1.0 / 1680 - q * (1.0 / 1188)))));
}

/// (1 + y) ln(1 + y) - y without cancellation.
double entropy_excess(double y) {
    if (std::abs(y) > 0.05) return (1 + y) * std::log1p(y) - y;
    // sum_{j >= 2} (-y)^j / (j (j - 1))
    double sum = 0;
    for (int j = 13; j >= 2; --j) sum = 1.0 / (j * (j - 1)) - y * sum;
    return y * y * sum;
}

Phi from_log(double log, PhiMethod method) {
    return {std::exp(log), log, method};
}

/// Terms relative to the one at the integer nearest the peak, by their ratios, upwards and downwards until
/// they stop counting.
Phi plain_sum(double g, double t, const Peak& peak) {
    const double centre = std::fmax(1, std::round(peak.m));
    double total = 1;
    double term = 1;
    for (double m = centre; term > negligible * total; ++m) {
        const double root = std::exp(t / (2 * m * (m + 1)));  // the root, since the whole may overflow
        term *= root * (g * m / ((m + 1) * (m + 1))) * root;
        total += term;
    }
    term = 1;
    for (double m = centre; m > 1 && term > negligible * total; --m) {
        const double root = std::exp(-t / (2 * m * (m - 1)));
        term *= root * (m * m / (m - 1)) / g * root;
        total += term;
    }
    const double largest =
        centre * std::log(g) - boost::math::lgamma(centre + 1) - std::log(centre) - t / centre - g;
    return from_log(largest + std::log(total), PhiMethod::sum);
}

/// The sum over every integer equals, to exp(-2 pi^2 s^2), the integral over m, and that equals, to
/// exp(-2 pi^2 (s/stride)^2), the trapezoidal rule with any stride (Poisson summation).
Phi trapezoidal_rule(double g, const Peak& peak) {
    const double w = peak.log_ratio;
    const double stride = peak.width / 1.5;
    const double correction_at_peak = stirling_remainder(peak.m);
    const auto term = [&](double y) {  // relative to the peak, at m = m* (1 + y)
        const double growth = 1 + y;
        const double exponent = -peak.m * (entropy_excess(y) + w * y * y / growth);
        return std::exp(exponent + correction_at_peak - stirling_remainder(peak.m * growth)) /
               (growth * std::sqrt(growth));
    };
    const double step = stride / peak.m;
    double total = 1;
    for (int j = 1;; ++j) {
        const double above = term(j * step);
        const double below = j * step < 1 ? term(-j * step) : 0;
        total += above + below;
        if (above + below < negligible * total) break;
    }
    // m* (1 - 2w) - g, which cancels for small w
    const double exponent = w < 1 ? g * (std::expm1(w) - 2 * w * std::exp(w)) : peak.m * (1 - 2 * w) - g;
    const double log = exponent - correction_at_peak + std::log(total * stride / peak.m) -
                       std::log(peak.m) / 2 - half_log_two_pi;
    return from_log(log, PhiMethod::trapezoid);
}

}  // namespace

const char* name(PhiMethod method) noexcept {
    switch (method) {
        case PhiMethod::zero:
            return "zero";
        case PhiMethod::sum:
            return "sum";
        case PhiMethod::trapezoid:
            return "trapezoid";
    }
    return "";
}

Phi phi(double g, double t) noexcept {
    if (g == 0 || std::isinf(t)) return {0, -std::numeric_limits<double>::infinity(), PhiMethod::zero};
    const Peak peak = peak_of_summand(g, t);
    // Below 50 the summand is not yet small at m = 0, where the integral starts; below a width of 3 the
    // stride would save nothing.
    if (peak.m < 50 || peak.width < 3) return plain_sum(g, t, peak);
    return trapezoidal_rule(g, peak);
}

}  // namespace hts
