/// Random numbers that are the same on every machine, for inputs drawn beforehand.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "hts/direction.hpp"

namespace hts::bench {

class Random {
  public:
    explicit Random(std::uint64_t seed) : bits_{seed} {}

    [[nodiscard]] double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
    }
    [[nodiscard]] double logarithmic(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// Uniform in solid angle over the hemisphere, never at the horizon.
    [[nodiscard]] Direction direction() {
        const double cosine = 1 - uniform(0, 1);
        const double sine = std::sqrt((1 - cosine) * (1 + cosine));
        const double azimuth = uniform(0, 2 * std::numbers::pi);
        return Direction::from_vector({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
    }

  private:
    std::mt19937_64 bits_;
};

}  // namespace hts::bench
