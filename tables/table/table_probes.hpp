/// Random directions on which tables are measured. Private to the module.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hts/sampling/random.hpp"
#include "tables/table/table.hpp"

namespace hts::tables {

/// Pairs as table_error describes them, the same on every machine.
class RandomPairs {
  public:
    explicit RandomPairs(std::uint64_t seed) : random_{seed} {}
    [[nodiscard]] std::vector<DirectionPair> next(std::size_t count);

  private:
    [[nodiscard]] DirectionPair uniform_pair();
    [[nodiscard]] DirectionPair lobe_pair();

    Random random_;
    bool about_lobe_ = false;
};

/// On which a finished table is measured, for a request's seed.
inline constexpr std::size_t measured_pairs = 1 << 17;
[[nodiscard]] constexpr std::uint64_t measured_seed(std::uint64_t seed) noexcept {
    return seed + 1;
}

/// The lobe's largest value [1/sr] for each theta_i: the largest of every half degree in the plane of
/// incidence, linear between whole degrees of theta_i.
class LobePeaks {
  public:
    explicit LobePeaks(const spectral::Reflectance& exact);
    [[nodiscard]] double operator()(const Direction& in, std::size_t wavelength) const noexcept;
    /// The least over all theta_i.
    [[nodiscard]] double least(std::size_t wavelength) const noexcept;

  private:
    std::size_t wavelengths_;
    std::vector<double> peaks_;  // by degree, wavelengths side by side
};

/// What the differences of a table are measured by, exact + 1e-3 peak.
[[nodiscard]] double error_scale(double exact, double peak) noexcept;

}  // namespace hts::tables
