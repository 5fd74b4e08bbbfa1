// Integral transforms on a logarithmic grid by Fourier's transform: FFTLog [Hamilton 2000]. Not installed.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hts::correlation_detail {

/// ln Gamma(z) up to a multiple of 2 pi i, z no pole.
///   error   1e-14, beside 1
[[nodiscard]] std::complex<double> log_gamma(std::complex<double> z);

/// For `points` values at x_n = x_c e^(n' step), n' = n - points/2, integrals over d ln x against a kernel of
/// k x, at k_n = e^(n' step)/x_c.
class LogTransform {
  public:
    ///   points   a power of 2
    LogTransform(std::size_t points, double step);

    [[nodiscard]] std::size_t points() const noexcept { return points_; }
    [[nodiscard]] double step() const noexcept { return step_; }

    /// k integral of a(x) J0(k x) dx, in place of a(x); of two functions at once, the
    /// real and the imaginary part.
    ///   error   some 1e-15 of the greatest value, where a is smooth in ln x and vanishes at both ends
    void hankel(std::span<std::complex<double>> values) const;
    /// integral of a(k) (1 - J0(k x)) d ln k, over x^bias, in place of a(k) k^bias.
    ///   bias   between 0 and 2, with which a(k) k^bias vanishes at both ends
    void complement(std::span<std::complex<double>> values, double bias) const;

  private:
    void convolve(std::span<std::complex<double>> values,
                  std::span<const std::complex<double>> multipliers) const;
    void fourier(std::span<std::complex<double>> values) const;
    [[nodiscard]] double frequency(std::size_t m) const noexcept;

    std::size_t points_;
    double step_;
    std::vector<std::complex<double>> roots_;   // exp(-2 pi i m/points)
    std::vector<std::complex<double>> bessel_;  // multipliers of J0
};

}  // namespace hts::correlation_detail
