/// Random numbers that are the same on every machine, and directions drawn with them. Not installed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "hts/direction.hpp"

namespace hts {

class Random {
  public:
    explicit Random(std::uint64_t seed) : bits_{seed} {}

    /// 64 bits, each 0 or 1 as likely.
    [[nodiscard]] std::uint64_t bits() { return bits_(); }
    /// Uniform in [0, 1).
    [[nodiscard]] double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
    [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Three of them, as samplers take them.
    [[nodiscard]] std::array<double, 3> uniforms() { return {uniform(), uniform(), uniform()}; }
    /// Uniform in the logarithm.
    [[nodiscard]] double logarithmic(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// One of a list, each as likely.
    [[nodiscard]] double one_of(const std::vector<double>& values) { return values[bits_() % values.size()]; }
    /// Uniform in solid angle over the cap about the normal.
    ///   lowest_cosine   cos theta at its rim, 0 (the hemisphere) ... 1
    [[nodiscard]] Direction direction(double lowest_cosine = 0);

  private:
    std::mt19937_64 bits_;
};

}  // namespace hts
