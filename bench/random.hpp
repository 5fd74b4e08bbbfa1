/// Random numbers that are the same on every machine, for inputs drawn beforehand.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "hts/direction.hpp"
#include "spectral/random_directions.hpp"

namespace hts::bench {

class Random {
  public:
    explicit Random(std::uint64_t seed) : bits_{seed} {}

    [[nodiscard]] double uniform(double low, double high) {
        return low + (high - low) * spectral::uniform(bits_);
    }
    [[nodiscard]] double logarithmic(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// Uniform in solid angle over the hemisphere, never at the horizon.
    [[nodiscard]] Direction direction() { return spectral::random_direction(bits_); }

  private:
    std::mt19937_64 bits_;
};

}  // namespace hts::bench
