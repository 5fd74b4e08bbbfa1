/// Cook and Torrance's lobe (SIGGRAPH 1981): Beckmann's facets D, V-shaped grooves G, Schlick's
/// reflectance F at theta_d:
///
///   F D G / (4 cos theta_i cos theta_r),   G = min(1, 2 cos theta_h cos theta_i/cos theta_d,
///                                                     2 cos theta_h cos theta_r/cos theta_d)
///
/// Normalisation: D as a density of normals, the integral of D cos theta_h being 1, and 1/4, with which the
/// lobe reflects at most 1. The form that many texts print, F D' G/(pi cos theta_i cos theta_r) with D' =
/// q/(m^2 cos^4 theta_h) = pi D, is 4 times this one: ks = 4 gives it.
/// Flaws: light that would leave a groove after a second reflection is lost; G has kinks.
#pragma once

#include "hts/microfacet/lobes.hpp"
#include "hts/microfacet/normals/gaussian_slopes.hpp"

namespace hts {

namespace accuracy {
inline constexpr double cook_torrance = 2.5e-12;  ///< of the lobe, where accuracy::kurt holds
}

class CookTorranceLobe : public SlopeLobe {
  public:
    ///   f0   reflectance at normal incidence, 0 ... 1      m   slope width, 1e-6 ... 1e3; else hts::Error
    CookTorranceLobe(double f0, double m);

    [[nodiscard]] double f0() const noexcept { return f0_; }
    [[nodiscard]] double m() const noexcept { return slopes().mx(); }

    ///   error   accuracy::cook_torrance
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).brdf(f0_);
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] double strength(const Direction& in) const noexcept { return schlick_strength(f0_, in); }

  private:
    double f0_;
};

using CookTorrance = DiffuseAndLobes<CookTorranceLobe>;

}  // namespace hts
