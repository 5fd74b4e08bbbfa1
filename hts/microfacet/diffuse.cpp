#include "hts/microfacet/diffuse.hpp"

#include <algorithm>
#include <cmath>

#include "hts/error.hpp"
#include "hts/microfacet/lobes.hpp"

namespace hts {
namespace {

constexpr double pi = std::numbers::pi;

double checked_slope_angle(double angle) {
    if (!(angle >= 0 && angle <= pi / 2))
        throw out_of_range("slope angle", angle, "rad", "from 0 to pi/2 rad");
    return angle;
}

double cosine_pdf(const Direction& in, const Direction& out) {
    return above_horizon(in, out) ? out.cos_theta() / pi : 0;
}

}  // namespace

LambertianModel::LambertianModel(double albedo) : albedo_{checked_reflectance("albedo", albedo)} {}

double LambertianModel::brdf(const Direction& in, const Direction& out) const noexcept {
    return above_horizon(in, out) ? albedo_ / pi : 0;
}

double LambertianModel::pdf(const Direction& in, const Direction& out) const noexcept {
    return cosine_pdf(in, out);
}

Draw LambertianModel::sample(const Direction& in, const Uniforms& u) const noexcept {
    return weighted(*this, in, cosine_vector(u[1], u[2]));
}

OrenNayar::OrenNayar(double albedo, double slope_angle)
    : albedo_{checked_reflectance("albedo", albedo)},
      slope_angle_{checked_slope_angle(slope_angle)},
      a_{1 - 0.5 * slope_angle * slope_angle / (slope_angle * slope_angle + 0.33)},
      b_{0.45 * slope_angle * slope_angle / (slope_angle * slope_angle + 0.09)} {}

void OrenNayar::brdf(std::span<const OrenNayar> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept {
    if (!above_horizon(in, out)) return std::fill(result.begin(), result.end(), 0.0);
    const double cos_between = in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi();
    // sin of the larger angle, tan of the smaller
    const double product = in.sin_theta() * out.sin_theta() / std::max(in.cos_theta(), out.cos_theta());
    const OrenNayar& one = alike.front();
    const double shape = (one.a_ + one.b_ * std::max(0.0, cos_between) * product) / pi;
    for (std::size_t i = 0; i < alike.size(); ++i) result[i] = alike[i].albedo_ * shape;
}

double OrenNayar::pdf(const Direction& in, const Direction& out) const noexcept {
    return cosine_pdf(in, out);
}

Draw OrenNayar::sample(const Direction& in, const Uniforms& u) const noexcept {
    return weighted(*this, in, cosine_vector(u[1], u[2]));
}

}  // namespace hts
