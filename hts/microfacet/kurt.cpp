#include "hts/microfacet/kurt.hpp"

#include <cmath>
#include <utility>

#include "hts/error.hpp"

namespace hts {
namespace {

double checked_alpha(double alpha) {
    if (!(alpha >= 0 && alpha < 2)) throw out_of_range("exponent alpha", alpha, "", "from 0 to below 2");
    return alpha;
}

}  // namespace

KurtLobe::KurtLobe(double f0, double mx, double my, double alpha)
    : SlopeLobe{mx, my}, f0_{checked_reflectance("reflectance f0", f0)}, alpha_{checked_alpha(alpha)} {}

double KurtLobe::brdf(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    const double cosines = std::pow(in.cos_theta() * out.cos_theta(), alpha_);
    return schlick(f0_, half.cos_theta_d) * slopes().density(half) / (4 * half.cos_theta_d * cosines);
}

double KurtLobe::strength(const Direction& in) const noexcept {
    return schlick_strength(f0_, in);
}

Kurt::Kurt(double kd, std::vector<WeightedLobe<KurtLobe>> lobes) : parts_{kd, std::move(lobes)} {}

Kurt Kurt::coupled(double kd, WeightedLobe<KurtLobe> lobe) {
    Kurt model{kd, {lobe}};
    model.coupled_ = true;
    return model;
}

double Kurt::brdf(const Direction& in, const Direction& out) const noexcept {
    const double sum = parts_.brdf(in, out);
    if (!coupled_ || sum == 0) return sum;
    const double f0 = parts_.lobes().front().shape.f0();
    return sum - parts_.kd() * schlick(f0, half_direction(in, out).cos_theta_d) / std::numbers::pi;
}

std::span<const KurtPreset> kurt_presets() {
    static const std::array<KurtPreset, 4> presets{{
        {"brushed aluminium",
         {0.0036, 0.0034, 0.0026},
         {0.0115, 0.0105, 0.0075},
         {0.999, 0.035, 0.129, 0.005},
         0.0104},
        {"purple satin",
         {0.0026, 0.0004, 0.0011},
         {0.1404, 0.0522, 0.0711},
         {0.055, 0.339, 1.256, 0},
         0.0006},
        {"red velvet", {0.0048, 0.0005, 0}, {0.1938, 0.0333, 0.0267}, {0.041, 2.337, 2.644, 0}, 0.0003},
        {"yellow satin",
         {0.0066, 0.0022, 0.0004},
         {0.0542, 0.0345, 0.0131},
         {0.207, 0.129, 1.084, 0.197},
         0.0014},
    }};
    return presets;
}

}  // namespace hts
