/// What models of surfaces say of profiles, which vary along one direction only: the twin of each, to be held
/// against exact scattering by profiles. All are products of the same factors as on surfaces; Phi has the
/// weights m^(-1/2) of profiles in place of m^(-1) (`profile_scattering`), and so has beta; m of he_unified
/// is that of `profile_return`; microfacets have the density of slopes along one direction. Lengths are in
/// wavelengths, the azimuth is 0 or 180 degrees, so that s stays s and p stays p: TE and TM.
#pragma once

#include <string_view>
#include <vector>

#include "hts/fresnel.hpp"
#include "hts/unified/unified_terms.hpp"
#include "validation/scattering/profile_scattering.hpp"
#include "validation/scattering/twins/profile_return.hpp"

namespace hts::validation {

enum class TwinModel {
    he,                   ///< the published model
    he_unified,           ///< its successor
    he_unified_mixing,    ///< with "polarisation_mixing": true
    he_unified_shortcut,  ///< with "conductor_shortcut": true, in unpolarised light; TE and TM mean nothing
    he_first_order,       ///< the published model with the first term of Phi
    he_rough_limit,       ///< with exp(-t/g)/sqrt(g) in place of Phi
    kirchhoff,            ///< sigma_0, not shadowed
    smith,                ///< sigma_0, shadowing of correlated heights
    ssa1,                 ///< small-slope approximation: Bragg's coefficient in all orders, shadowed as smith
    beckmann,             ///< microfacets of Walter et al. 2007, shadowed by both directions apart
    ggx,
};
/// "he", "he_unified", … as material files and tables name them.
[[nodiscard]] std::string_view name(TwinModel model) noexcept;

/// Of all that falls in, per angle [1/rad], incoherent.
struct ProfileLobe {
    double te, tm;
};

class ProfileTwin {
  public:
    ///   index   perfect_conductor() for one      alpha   the width of the slopes, of beckmann and ggx alone
    ProfileTwin(TwinModel model, const RoughnessStatistics& surface, const RefractiveIndex& index,
                double alpha = 0);

    ///   theta_i, theta_r   [rad], theta_r < 0 on the side of the source
    [[nodiscard]] ProfileLobe lobe(double theta_i, double theta_r) const;

  private:
    [[nodiscard]] ProfileLobe facets(double theta_i, double theta_r, double of_mirrors) const;
    [[nodiscard]] ProfileLobe unified(double theta_i, double theta_r) const;
    [[nodiscard]] double he_limit(double theta_i, double theta_r) const;
    [[nodiscard]] double microfacets(double theta_i, double theta_r) const;

    TwinModel model_;
    ProfileHeights heights_;
    RefractiveIndex index_;
    double alpha_;
    ProfileReturn return_;
    UnifiedWave wave_;
};

/// Shares of the light that a perfectly conducting profile mirrors.
///   domain    a Gaussian correlation
///   formula   second-order perturbation theory: exp(-x), x_s = 4 (k sigma_0)^2 c integral S(q - s) sqrt(1 -
///             q^2) dq, x_p = 4 (k sigma_0)^2/c integral S(q - s) (1 - s q)^2/sqrt(1 - q^2) dq over -1 … 1, S
///             the normalised spectrum, k tau/(2 sqrt(pi)) exp(-(k tau q)^2/4): "mirror":
///             "second_order" of he_unified
[[nodiscard]] ProfileLobe second_order_mirror(const RoughnessStatistics& surface, double theta_i);

}  // namespace hts::validation
