#include "hts/correlation/log_transform.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace hts::correlation_detail {
namespace {

using Complex = std::complex<double>;

}  // namespace

Complex log_gamma(Complex z) {
    constexpr double far = 16;  // Stirling's series then ends within rounding
    Complex lowered = 0;
    for (; z.real() < far; z += 1.0) lowered += std::log(z);
    // B_2k / (2k (2k - 1))
    constexpr std::array<double, 7> stirling{1.0 / 12,   -1.0 / 360,       1.0 / 1260, -1.0 / 1680,
                                             1.0 / 1188, -691.0 / 360360., 1.0 / 156};
    const Complex inverse = 1.0 / z;
    Complex series = 0;
    for (std::size_t i = stirling.size(); i-- > 0;) series = series * inverse * inverse + stirling[i];
    return (z - 0.5) * std::log(z) - z + std::log(2 * std::numbers::pi) / 2 + series * inverse - lowered;
}

LogTransform::LogTransform(std::size_t points, double step)
    : points_{points}, step_{step}, roots_(points / 2), bessel_(points) {
    for (std::size_t m = 0; m < roots_.size(); ++m)
        roots_[m] =
            std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(m) / static_cast<double>(points));
    for (std::size_t m = 0; m < points; ++m) {
        // integral of t^(i w) J0(t) dt = 2^(i w) Gamma((1 + i w)/2)/Gamma((1 - i w)/2)
        const double w = frequency(m);
        const double phase = w * std::numbers::ln2 + 2 * log_gamma({0.5, w / 2}).imag();
        bessel_[m] = 2 * m == points ? std::cos(phase) : std::polar(1.0, phase);
    }
}

double LogTransform::frequency(std::size_t m) const noexcept {
    const auto count = static_cast<double>(points_);
    const double signed_m = static_cast<double>(m) - (2 * m > points_ ? count : 0);
    return 2 * std::numbers::pi * signed_m / (count * step_);
}

void LogTransform::hankel(std::span<Complex> values) const {
    convolve(values, bessel_);
}

void LogTransform::complement(std::span<Complex> values, double bias) const {
    std::vector<Complex> multipliers(points_);
    for (std::size_t m = 0; m < points_; ++m) {
        // integral of t^(s - 1) (1 - J0(t)) dt = -2^(s - 1) Gamma(s/2)/Gamma(1 - s/2), -2 < Re s < 0
        const Complex s{-bias, frequency(m)};
        const Complex value =
            -std::exp((s - 1.0) * std::numbers::ln2 + log_gamma(s / 2.0) - log_gamma(1.0 - s / 2.0));
        multipliers[m] = 2 * m == points_ ? Complex{value.real(), 0} : value;
    }
    convolve(values, multipliers);
}

void LogTransform::convolve(std::span<Complex> values, std::span<const Complex> multipliers) const {
    // both transforms run forwards: the second turns x round to k ~ 1/x, and the signs
    // of a centred index cancel
    fourier(values);
    for (std::size_t m = 0; m < points_; ++m) values[m] *= multipliers[m] / static_cast<double>(points_);
    fourier(values);
}

void LogTransform::fourier(std::span<Complex> values) const {
    for (std::size_t i = 1, j = 0; i < points_; ++i) {
        std::size_t bit = points_ >> 1;
        for (; (j & bit) != 0; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(values[i], values[j]);
    }
    for (std::size_t half = 1; half < points_; half *= 2) {
        const std::size_t stride = points_ / (2 * half);
        for (std::size_t first = 0; first < points_; first += 2 * half) {
            for (std::size_t i = 0; i < half; ++i) {
                const Complex &root = roots_[i * stride], &b = values[first + half + i];
                const Complex turned{root.real() * b.real() - root.imag() * b.imag(),
                                     root.real() * b.imag() + root.imag() * b.real()};
                values[first + half + i] = values[first + i] - turned;
                values[first + i] += turned;
            }
        }
    }
}

}  // namespace hts::correlation_detail
