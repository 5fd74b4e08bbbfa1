#include "hts/phi/phi_sum.hpp"

#include <cmath>
#include <numbers>

#include <boost/math/special_functions/gamma.hpp>

#include "hts/phi/lambert.hpp"

// The summand is exp(E(m)) with E(m) = m ln g - ln m! - ln m - t/m - g. For large m its maximum is at m* = g
// exp(w), w = W_0(2t/g^2)/2, where t = w m*^2, and its curvature there gives the width s = sqrt(m* / (1 +
// 2w)).

namespace hts::phi_detail {
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

/// E(m*) but for factorial's and 1/m's own logarithms: m* (1 - 2w) - g, which cancels for small w.
double exponent_at(const Peak& peak, double g) {
    const double w = peak.log_ratio;
    return w < 1 ? g * (std::expm1(w) - 2 * w * std::exp(w)) : peak.m * (1 - 2 * w) - g;
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

/// The sums of terms, of terms times m, of terms over m, and of terms times 1 - 1/m.
struct Totals {
    double phi = 0, psi = 0, chi = 0, rest = 0;

    void add(double term, double m) {
        phi += term;
        psi += term * m;
        chi += term / m;
        rest += term * ((m - 1) / m);
    }
};

/// Terms relative to the one at the integer nearest the peak, by their ratios, upwards and downwards until
/// they stop counting in any of the sums.
PhiSum plain_sum(double g, double t, const Peak& peak) {
    const double centre = std::fmax(1, std::round(peak.m));
    Totals total;
    total.add(1, centre);
    double term = 1;
    for (double m = centre; term * m > negligible * total.psi; ++m) {
        const double root = std::exp(t / (2 * m * (m + 1)));  // the root, since the whole may overflow
        term *= root * (g * m / ((m + 1) * (m + 1))) * root;
        total.add(term, m + 1);
    }
    term = 1;
    for (double m = centre; m > 1 && term > negligible * m * total.chi; --m) {
        const double root = std::exp(-t / (2 * m * (m - 1)));
        term *= root * (m * m / (m - 1)) / g * root;
        total.add(term, m - 1);
    }
    const double largest =
        centre * std::log(g) - boost::math::lgamma(centre + 1) - std::log(centre) - t / centre - g;
    return {largest + std::log(total.phi), total.psi / total.phi - g, total.chi / total.phi,
            total.rest / total.phi, PhiMethod::sum};
}

/// The sum over every integer equals, to exp(-2 pi^2 s^2), the integral over m, and that equals, to
/// exp(-2 pi^2 (s/stride)^2), the trapezoidal rule with any stride (Poisson summation).
PhiSum trapezoidal_rule(double g, const Peak& peak) {
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
    double total_y = 0;  // of y times the term: <m> = m* (1 + <y>), and <m> - g must not cancel
    double total_inverse = 1;
    for (int j = 1;; ++j) {
        const double y = j * step;
        const double above = term(y);
        const double below = y < 1 ? term(-y) : 0;
        total += above + below;
        total_y += y * (above - below);
        total_inverse += above / (1 + y) + (y < 1 ? below / (1 - y) : 0);
        if (above + below < negligible * total) break;
    }
    const double log = exponent_at(peak, g) - correction_at_peak + std::log(total * stride / peak.m) -
                       std::log(peak.m) / 2 - half_log_two_pi;
    const double peak_excess = w < 1 ? g * std::expm1(w) : peak.m - g;
    const double inverse_mean = total_inverse / total / peak.m;
    return {log, peak_excess + peak.m * (total_y / total), inverse_mean, 1 - inverse_mean,
            PhiMethod::trapezoid};
}

}  // namespace

PhiSum phi_sum(double g, double t) noexcept {
    const Peak peak = peak_of_summand(g, t);
    // Below 50 the summand is not yet small at m = 0, where the integral starts; below a width of 3 the
    // stride would save nothing.
    if (peak.m < 50 || peak.width < 3) return plain_sum(g, t, peak);
    return trapezoidal_rule(g, peak);
}

double log_phi_bound(double g, double t) noexcept {
    // Each term is at most exp(exponent_at) since m! >= m^m e^-m sqrt(2 pi m), m >= 1; the terms that count
    // are fewer than m*, and the factor 1/m takes that away again.
    return exponent_at(peak_of_summand(g, t), g) + 3;
}

}  // namespace hts::phi_detail
