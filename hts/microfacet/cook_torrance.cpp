#include "hts/microfacet/cook_torrance.hpp"

#include <algorithm>

namespace hts {

CookTorranceLobe::CookTorranceLobe(double f0, double m)
    : SlopeLobe{m, m}, f0_{checked_reflectance("reflectance f0", f0)} {}

LobeGeometry CookTorranceLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    const double lower = std::min(in.cos_theta(), out.cos_theta());
    const double visible = std::min(1.0, 2 * half.normal.z * lower / half.cos_theta_d);
    return {slopes().density(half) * visible / (4 * in.cos_theta() * out.cos_theta()),
            schlick(0, half.cos_theta_d)};
}

}  // namespace hts
