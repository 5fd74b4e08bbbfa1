/// The yardstick for the speed of sampling: visible normals of the GGX distribution, as renderers draw them.
///
/// E. Heitz, Sampling the GGX distribution of visible normals, JCGT 7 (2018). The density of the outgoing
/// direction is G_1(in) D(theta_h) / (4 cos theta_i), G_1 Smith's shadowing of one direction.
#pragma once

#include <array>

#include "hts/direction.hpp"

namespace hts::bench {

/// A direction drawn; pdf 0 where it fell below the horizon.
struct GgxDraw {
    Direction out;
    double pdf;  ///< [1/sr]
};

class GgxSampler {
  public:
    ///   alpha   width of the slopes, > 0, else hts::Error
    explicit GgxSampler(double alpha);

    ///   in   above the horizon     u   two numbers in [0, 1)
    [[nodiscard]] GgxDraw draw(const Direction& in, const std::array<double, 2>& u) const noexcept;
    /// Density of `out` in solid angle [1/sr]; both directions above the horizon.
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;

  private:
    double alpha_, alpha_squared_;
};

}  // namespace hts::bench
