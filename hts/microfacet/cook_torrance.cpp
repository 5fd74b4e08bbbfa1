#include "hts/microfacet/cook_torrance.hpp"

#include <algorithm>
#include <cmath>

namespace hts {

CookTorranceLobe::CookTorranceLobe(double f0, double m)
    : SlopeLobe{m, m}, f0_{checked_reflectance("reflectance f0", f0)} {}

double CookTorranceLobe::brdf(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    const double lower = std::min(in.cos_theta(), out.cos_theta());
    const double visible = std::fmin(1, 2 * half.normal.z * lower / half.cos_theta_d);
    return schlick(f0_, half.cos_theta_d) * slopes().density(half) * visible /
           (4 * in.cos_theta() * out.cos_theta());
}

double CookTorranceLobe::strength(const Direction& in) const noexcept {
    return schlick_strength(f0_, in);
}

}  // namespace hts
