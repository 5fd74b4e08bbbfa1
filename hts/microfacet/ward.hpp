/// Ward's anisotropic lobe (SIGGRAPH 1992) and Duer's correction of it (2005), q the Gaussian of slopes:
///
///   Ward        q / (4 pi mx my sqrt(cos theta_i cos theta_r))
///   Ward-Duer   q / (4 pi mx my cos theta_i cos theta_r)
///
/// Normalisation: as printed, q over pi mx my without the cos^4 theta_h of a density of normals, so that each
/// reflects 1 at normal incidence only in the limit of narrow lobes, less for wide ones.
/// Flaws: a narrow Ward lobe reflects cos theta_i, so it darkens towards grazing; Ward-Duer has 1 there. At
/// grazing, once cos theta_i is well below m, both grow beyond 1 without bound, like
/// cos(theta_i)^-1/2 and 1/cos theta_i.
#pragma once

#include "hts/microfacet/lobes.hpp"
#include "hts/microfacet/normals/gaussian_slopes.hpp"

namespace hts {

namespace accuracy {
inline constexpr double ward = 7e-12;  ///< of both lobes, where accuracy::kurt holds
}

class WardLobe : public SlopeLobe {
  public:
    ///   mx, my   slope widths, 1e-6 ... 1e3, else hts::Error
    using SlopeLobe::SlopeLobe;

    ///   error   accuracy::ward
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).mirrors;
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] double f0() const noexcept { return 1; }
    [[nodiscard]] double strength(const Direction& /*in*/) const noexcept { return 1; }
};

class WardDuerLobe : public SlopeLobe {
  public:
    ///   mx, my   slope widths, 1e-6 ... 1e3, else hts::Error
    using SlopeLobe::SlopeLobe;

    ///   error   accuracy::ward
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).mirrors;
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] double f0() const noexcept { return 1; }
    [[nodiscard]] double strength(const Direction& /*in*/) const noexcept { return 1; }
};

using Ward = DiffuseAndLobes<WardLobe>;
using WardDuer = DiffuseAndLobes<WardDuerLobe>;

}  // namespace hts
