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

LobeGeometry KurtLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    const double cosines = in.cos_theta() * out.cos_theta();
    const double visible = alpha_ == 0 ? 1 : std::pow(cosines, alpha_);
    return {slopes().density(half) / (4 * half.cos_theta_d * visible), schlick(0, half.cos_theta_d)};
}

Kurt::Kurt(double kd, std::vector<WeightedLobe<KurtLobe>> lobes) : parts_{kd, std::move(lobes)} {}

Kurt Kurt::coupled(double kd, WeightedLobe<KurtLobe> lobe) {
    Kurt model{kd, {lobe}};
    model.coupled_ = true;
    return model;
}

void Kurt::brdf(std::span<const Kurt> alike, const Direction& in, const Direction& out,
                std::span<double> result) noexcept {
    DiffuseAndLobes<KurtLobe>::brdf(alike, &Kurt::parts_, in, out, result);
    if (!alike.front().coupled_ || !above_horizon(in, out)) return;
    const LobeGeometry mirror{1, schlick(0, half_direction(in, out).cos_theta_d)};
    for (std::size_t i = 0; i < alike.size(); ++i) {
        const auto& parts = alike[i].parts_;
        result[i] -= parts.kd() * mirror.brdf(parts.lobes().front().shape.f0()) / std::numbers::pi;
    }
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
