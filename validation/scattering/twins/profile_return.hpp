/// The twin of hts/unified/return_factor.hpp for profiles: the reciprocal factor m of each direction with
/// which the facets of a perfectly conducting profile return all light in geometric optics,
///
///   m(theta_i) integral L(theta_i, theta_r) m(theta_r) dtheta_r = 1,
///   L = P(tan gamma) cos theta_d/(2 cos^3 gamma cos theta_i) / (1 + Lambda_i + Lambda_r),
///
/// gamma = (theta_r - theta_i)/2 the angle of the facet, theta_d = (theta_r + theta_i)/2, P the density of
/// slopes, exp(-p^2/alpha^2)/(sqrt(pi) alpha), alpha = 2 sigma_0/tau.
#pragma once

#include <vector>

#include "validation/scattering/gaussian_surface.hpp"

namespace hts::validation {

/// P(tan gamma) cos theta_d/(2 cos^3 gamma cos theta_i): light from theta_i that a profile with a density of
/// slopes P reflects once, unshadowed, per angle [1/rad].
[[nodiscard]] double facet_lobe(double density, double theta_i, double theta_r) noexcept;

class ProfileReturn {
  public:
    explicit ProfileReturn(const RoughnessStatistics& surface);

    /// m(theta) [1].
    [[nodiscard]] double operator()(double theta) const noexcept;
    /// Share of uniform light that is reflected once and away, integral E cos theta
    /// dtheta over 0 … 90 degrees.
    [[nodiscard]] double single() const noexcept { return single_; }

  private:
    double alpha_, single_ = 1;
    std::vector<double> values_;  // of m at Chebyshev's nodes in 1/(1 + cot theta/alpha)
};

}  // namespace hts::validation
