#include "validation/scattering/hankel.hpp"

#include <cmath>
#include <numbers>

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;
constexpr double least_tabulated = 1.5;
constexpr double intervals = 1500;

/// H_0 and H_1 near 0, J + iY with the power series of [NIST (10.2.2), (10.8.1)], q = z^2/4.
Hankel near(Complex z) {
    const Complex q = z * z / 4.0, logarithm = std::log(z / 2.0) + std::numbers::egamma;
    Complex j0 = 0, j1 = 0, y0 = 0, y1 = 0;
    Complex term = 1;  // (-q)^m/m!^2
    double harmonic = 0;
    for (int m = 0; m < 20; ++m) {
        const double next = harmonic + 1.0 / (m + 1);
        j0 += term;
        y0 -= harmonic * term;
        j1 += term / (m + 1.0);
        y1 += (harmonic + next) * term / (m + 1.0);
        term *= -q / ((m + 1.0) * (m + 1.0));
        harmonic = next;
    }
    const Complex half = z / 2.0;
    const Complex bessel_0 = 2 / pi * (logarithm * j0 + y0);
    const Complex bessel_1 = half / pi * (2.0 * logarithm * j1 - y1) - 2.0 / (pi * z);
    constexpr Complex i{0, 1};
    return {j0 + i * bessel_0, half * j1 + i * bessel_1};
}

/// h of both orders, away from 0: with w = -iz
///   K_nu(w) = sqrt(pi/2w) exp(-w)/Gamma(nu + 1/2) integral exp(-q^2) q^(2 nu) (1 + q^2/2w)^(nu - 1/2) dq,
///   over all q
/// [NIST (10.32.8)], where the trapezoidal rule's error falls as exp(-2 pi |z|^(1/2)/step), and H_nu from
/// K_nu [NIST (10.27.8)].
Hankel far(Complex z) {
    constexpr double step = 0.15;
    Complex k0 = 0.5, k1 = 0;
    for (double q = step; q < 6.5; q += step) {
        const double square = q * q, weight = std::exp(-square);
        const Complex root = std::sqrt(1.0 + Complex{0, square / 2} / z);
        k0 += weight / root;
        k1 += weight * square * root;
    }
    // sqrt(pi/2w)/Gamma(nu + 1/2), and 2/(pi i) exp(-i nu pi/2)
    const Complex common = 2 * step * std::sqrt(Complex{0, 0.5}) * (2 / pi);
    return {common * k0 * Complex{0, -1}, common * 2.0 * k1 * -1.0};
}

/// Cubic through two values and two slopes, at 0 <= x <= 1 between them.
template <class Value>
Value hermite(const Value& value, const Value& slope, const Value& next, const Value& next_slope, double x) {
    const Value rise = next - value;
    const Value bend = 3.0 * rise - 2.0 * slope - next_slope, twist = slope + next_slope - 2.0 * rise;
    return value + x * (slope + x * (bend + x * twist));
}

}  // namespace

Bessel bessel(Complex z) noexcept {
    const Complex q = z * z / 4.0;
    Complex order_0 = 0, order_1 = 0, term = 1;
    for (int m = 0; m < 24; ++m) {
        order_0 += term;
        order_1 += term / (m + 1.0);
        term *= -q / ((m + 1.0) * (m + 1.0));
    }
    return {order_0, z / 2.0 * order_1};
}

HankelTable::HankelTable(double largest, Complex wave_number)
    : wave_number_{wave_number},
      inverse_root_{1.0 / std::sqrt(wave_number)},
      first_{1 / (2 * std::fmax(largest, least_tabulated / std::abs(wave_number)))},
      per_inverse_{intervals / (std::abs(wave_number) / least_tabulated - first_)} {
    for (int i = 0; i <= static_cast<int>(intervals) + 1; ++i) {
        const double distance = 1 / (first_ + i / per_inverse_);
        const Complex z = wave_number * distance;
        const Hankel h = far(z);
        // h' by Bessel's recurrences: H0' = -H1, H1' = H0 - H1/z, and d/d(1/r) = -k r^2 d/dz
        const Complex shift = 0.5 / z - Complex{0, 1}, turn = -z * distance / per_inverse_;
        nodes_.push_back({{h.order_0, h.order_1},
                          {turn * (shift * h.order_0 - h.order_1),
                           turn * (shift * h.order_1 + h.order_0 - h.order_1 / z)}});
    }
}

Hankel HankelTable::operator()(double distance) const noexcept {
    const Complex z = wave_number_ * distance;
    if (std::norm(z) < least_tabulated * least_tabulated) return near(z);
    const double inverse = 1 / distance;
    const double place = (inverse - first_) * per_inverse_;
    const auto i = static_cast<std::size_t>(place);
    const double x = place - static_cast<double>(i);
    const Complex carrier = inverse_root_ * std::polar(std::sqrt(inverse) * std::exp(-z.imag()), z.real());
    const Node &low = nodes_[i], &high = nodes_[i + 1];
    return {carrier * hermite(low.value[0], low.derivative[0], high.value[0], high.derivative[0], x),
            carrier * hermite(low.value[1], low.derivative[1], high.value[1], high.derivative[1], x)};
}

}  // namespace hts::validation
