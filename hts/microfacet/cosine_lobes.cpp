#include "hts/microfacet/cosine_lobes.hpp"

#include <algorithm>
#include <cmath>

#include "hts/error.hpp"

namespace hts {
namespace {

constexpr double pi = std::numbers::pi;

/// ln cos theta_h from the slopes, which does not cancel near the peak.
double log_cosine(const HalfDirection& half) {
    return -std::log1p(half.slope_x * half.slope_x + half.slope_y * half.slope_y) / 2;
}

double checked_coefficient(const char* quantity, double value) {
    if (!(std::abs(value) <= 10)) throw out_of_range(quantity, value, "", "from -10 to 10");
    return value;
}

}  // namespace

BlinnPhongLobe::BlinnPhongLobe(double exponent)
    : exponent_{checked_exponent("exponent", exponent)},
      peak_{(exponent + 2) * (exponent + 4) / (8 * pi * (std::exp2(-exponent / 2) + exponent))} {}

LobeGeometry BlinnPhongLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    return {peak_ * std::exp(exponent_ * log_cosine(half_direction(in, out))), 0};
}

double BlinnPhongLobe::pdf(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    return (exponent_ + 1) * std::exp(exponent_ * log_cosine(half)) / (8 * pi * half.cos_theta_d);
}

Vector3 BlinnPhongLobe::draw(const Direction& in, double u1, double u2) const noexcept {
    const double phi = 2 * pi * u2;
    return mirrored(in, cosine_power_vector(1 - u1, exponent_, std::cos(phi), std::sin(phi)));
}

double BlinnPhongLobe::strength(const Direction& in) const noexcept {
    return in.cos_theta();
}

AshikhminShirleyLobe::AshikhminShirleyLobe(double f0, double nx, double ny)
    : f0_{checked_reflectance("reflectance f0", f0)},
      nx_{checked_exponent("exponent nx", nx)},
      ny_{checked_exponent("exponent ny", ny)} {}

double AshikhminShirleyLobe::density(const HalfDirection& half) const noexcept {
    const double x = half.slope_x * half.slope_x;
    const double y = half.slope_y * half.slope_y;
    const double power = x + y > 0 ? (nx_ * x + ny_ * y) / (x + y) * log_cosine(half) : 0;
    return std::sqrt((nx_ + 1) * (ny_ + 1)) / (2 * pi) * std::exp(power);
}

LobeGeometry AshikhminShirleyLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    const double higher = std::max(in.cos_theta(), out.cos_theta());
    return {density(half) / (4 * half.cos_theta_d * higher), schlick(0, half.cos_theta_d)};
}

double AshikhminShirleyLobe::pdf(const Direction& in, const Direction& out) const noexcept {
    const HalfDirection half = half_direction(in, out);
    return density(half) / (4 * half.cos_theta_d);
}

Vector3 AshikhminShirleyLobe::draw(const Direction& in, double u1, double u2) const noexcept {
    const double psi = 2 * pi * u2;
    const double x = std::cos(psi) / std::sqrt(nx_ + 1);
    const double y = std::sin(psi) / std::sqrt(ny_ + 1);
    const double length = std::hypot(x, y);
    const double cos_phi = x / length;
    const double sin_phi = y / length;
    const double exponent = nx_ * cos_phi * cos_phi + ny_ * sin_phi * sin_phi;
    return mirrored(in, cosine_power_vector(1 - u1, exponent, cos_phi, sin_phi));
}

double AshikhminShirleyLobe::strength(const Direction& in) const noexcept {
    return schlick_strength(f0_, in);
}

LafortuneLobe::LafortuneLobe(double cx, double cy, double exponent)
    : cx_{checked_coefficient("coefficient cx", cx)},
      cy_{checked_coefficient("coefficient cy", cy)},
      exponent_{checked_exponent("exponent", exponent)} {}

Vector3 LafortuneLobe::axis(const Direction& in) const noexcept {
    const Vector3 v = in.vector();
    return {cx_ * v.x, cy_ * v.y, v.z};
}

LobeGeometry LafortuneLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    const double cosine = dot(axis(in), out.vector());
    if (!(cosine > 0)) return {0, 0};
    return {std::min((exponent_ + 2) / (2 * pi) * std::pow(cosine, exponent_), 1e300), 0};
}

double LafortuneLobe::pdf(const Direction& in, const Direction& out) const noexcept {
    const Vector3 a = axis(in);
    const double cosine = dot(a, out.vector()) / std::hypot(a.x, a.y, a.z);
    return cosine > 0 ? (exponent_ + 1) / (2 * pi) * std::pow(std::fmin(1, cosine), exponent_) : 0;
}

Vector3 LafortuneLobe::draw(const Direction& in, double u1, double u2) const noexcept {
    const Vector3 a = axis(in);
    const double phi = 2 * pi * u2;
    const Vector3 local = cosine_power_vector(1 - u1, exponent_, std::cos(phi), std::sin(phi));
    const Vector3 w = 1 / std::hypot(a.x, a.y, a.z) * a;
    // A vertical plane through the axis, and the horizontal across it.
    const double radius = std::hypot(w.x, w.y);
    const Vector3 u = radius > 0 ? Vector3{-w.y / radius, w.x / radius, 0} : Vector3{0, 1, 0};
    return local.x * cross(u, w) + local.y * u + local.z * w;
}

double LafortuneLobe::strength(const Direction& in) const noexcept {
    return in.cos_theta() > 0 ? 1 : 0;
}

AshikhminShirley::AshikhminShirley(double rd, const AshikhminShirleyLobe& lobe, double ks)
    : parts_{checked_reflectance("diffuse reflectance rd", rd) * (1 - lobe.f0()), {{ks, lobe}}} {}

void AshikhminShirley::brdf(std::span<const AshikhminShirley> alike, const Direction& in,
                            const Direction& out, std::span<double> result) noexcept {
    if (!above_horizon(in, out)) return std::fill(result.begin(), result.end(), 0.0);
    // 1 - (1 - c/2)^5, which Schlick's term is for f0 = 0
    const auto below = [](double cosine) { return 1 - schlick(0, cosine / 2); };
    const double diffuse = 28 / (23 * pi) * below(in.cos_theta()) * below(out.cos_theta());
    const LobeGeometry geometry = alike.front().parts_.lobes().front().shape.geometry(in, out);
    for (std::size_t i = 0; i < alike.size(); ++i) {
        const auto& parts = alike[i].parts_;
        const auto& [ks, lobe] = parts.lobes().front();
        result[i] = parts.kd() * diffuse + ks * geometry.brdf(lobe.f0());
    }
}

}  // namespace hts
