/// Which side of the normal is the brighter. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace hts::tables {

/// What was measured in the plane of incidence, on the mirror's side of the normal and on the light's.
/// Azimuths counted from another direction than the reader takes for zero show in it.
class TwoSides {
  public:
    /// A value at polar angles [deg]; near the normal it tells nothing.
    void add(double theta_i, double theta_r, bool towards_light, double value) {
        constexpr double oblique = 5;
        if (std::min(theta_i, theta_r) < oblique) return;
        Side& side = sides_[towards_light ? 1 : 0];
        side.sum += value;
        ++side.count;
    }
    /// Whether the mean of the light's side is more than twice that of the mirror's, where each has three
    /// values or more.
    [[nodiscard]] bool brighter_towards_light() const {
        constexpr std::size_t enough = 3;
        const auto& [mirror, light] = sides_;
        return mirror.count >= enough && light.count >= enough && light.mean() > 2 * mirror.mean();
    }

  private:
    struct Side {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    };
    std::array<Side, 2> sides_;
};

}  // namespace hts::tables
