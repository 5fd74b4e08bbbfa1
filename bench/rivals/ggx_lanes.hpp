/// The yardstick of ggx.hpp in the engine's own vector lanes, so that the comparison is between models and
/// not between compilers: the same geometry, Fresnel and choice of instruction set as
/// hts::HeTorranceSpectrum.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::bench {

/// A rough GGX conductor at several wavelengths; formulas in ggx.hpp.
class LaneConductor {
  public:
    ///   alpha   width of the slopes, > 0     n, k   one value per wavelength, equally many, at least one;
    ///   else hts::Error
    LaneConductor(double alpha, std::span<const double> n, std::span<const double> k);

    [[nodiscard]] std::size_t size() const noexcept { return count_; }

    /// BRDF of a pair [1/sr], one value per wavelength, into `result` of size() values; directions above the
    /// horizon.
    void brdf(const DirectionPair& pair, std::span<double> result) const noexcept;
    /// The same for many pairs, all wavelengths of a pair together, into pairs.size() * size() values.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const noexcept;

  private:
    double alpha_squared_;
    std::size_t count_;
    std::vector<double> d_real_, d_imaginary_squared_, d_squared_;  // of d = N^2 - 1, padded to whole vectors
};

}  // namespace hts::bench
