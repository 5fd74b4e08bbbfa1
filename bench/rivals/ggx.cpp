#include "bench/rivals/ggx.hpp"

#include <utility>

#include "hts/error.hpp"

namespace hts::bench {

RoughConductor::RoughConductor(double alpha, std::vector<double> n, std::vector<double> k)
    : alpha_squared_{alpha * alpha}, n_{std::move(n)}, k_{std::move(k)} {
    if (!(alpha > 0 && std::isfinite(alpha_squared_)))
        throw out_of_range("GGX width alpha", alpha, "", "> 0 and finite");
    if (n_.empty() || n_.size() != k_.size()) {
        throw Error{"optical constants: n and k must have the same number of wavelengths, at least one"};
    }
}

GgxPair RoughConductor::pair(const Direction& in, const Direction& out) const noexcept {
    const double cos_in = in.cos_theta();
    const double cos_out = out.cos_theta();
    if (!(cos_in > 0 && cos_out > 0)) return {0, 0};
    const Vector3 sum = in.vector() + out.vector();
    const double length_squared = dot(sum, sum);
    const double cos_h_squared = sum.z * sum.z / length_squared;
    const double sin_h_squared = (sum.x * sum.x + sum.y * sum.y) / length_squared;
    const double cos_theta_d = std::fmin(1, std::sqrt(length_squared) / 2);
    return {cos_theta_d, ggx_distribution(cos_h_squared, sin_h_squared, alpha_squared_) *
                             ggx_visibility(cos_in, cos_out, alpha_squared_)};
}

void RoughConductor::brdf(const spectral::DirectionPair& directions,
                          std::span<double> result) const noexcept {
    const GgxPair shared = pair(directions.in, directions.out);
    const double* const n = n_.data();
    const double* const k = k_.data();
    double* const f = result.data();
    for (std::size_t i = 0; i < n_.size(); ++i) {
        f[i] = shared.lobe * conductor_reflectance(shared.cos_theta_d, n[i], k[i]);
    }
}

void RoughConductor::brdf(std::span<const spectral::DirectionPair> pairs,
                          std::span<double> result) const noexcept {
    for (std::size_t i = 0; i < pairs.size(); ++i) brdf(pairs[i], result.subspan(i * size(), size()));
}

}  // namespace hts::bench
