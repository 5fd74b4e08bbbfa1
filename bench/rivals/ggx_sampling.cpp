#include "bench/rivals/ggx_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"

namespace hts::bench {

GgxSampler::GgxSampler(double alpha) : alpha_{alpha}, alpha_squared_{alpha * alpha} {
    if (!(alpha > 0 && std::isfinite(alpha_squared_)))
        throw out_of_range("GGX width alpha", alpha, "", "> 0 and finite");
}

double GgxSampler::pdf(const Direction& in, const Direction& out) const noexcept {
    // G_1 = 2 cos/(cos + reach), D = alpha^2 |v|^4/(pi (alpha^2 v_z^2 + v_xy^2)^2), v the sum of both
    // directions
    const double cosine = in.cos_theta();
    const double reach = std::sqrt(alpha_squared_ + (1 - alpha_squared_) * cosine * cosine);
    const Vector3 v = in.vector() + out.vector();
    const double horizontal = v.x * v.x + v.y * v.y;
    const double vertical = v.z * v.z;
    const double squared = horizontal + vertical;
    const double bracket = alpha_squared_ * vertical + horizontal;
    return alpha_squared_ * squared * squared / (2 * std::numbers::pi * bracket * bracket * (cosine + reach));
}

GgxDraw GgxSampler::draw(const Direction& in, const std::array<double, 2>& u) const noexcept {
    // In the frame of the light's azimuth, stretched so that the slopes have width 1.
    const double x = alpha_ * in.sin_theta();
    const double z = in.cos_theta();
    const double scale = 1 / std::sqrt(x * x + z * z);
    const double sine = x * scale;
    const double cosine = z * scale;
    // A point of the projected area: half a disc, and the other half as foreshortened.
    const double radius = std::sqrt(u[0]);
    const double azimuth = 2 * std::numbers::pi * u[1];
    const double t1 = radius * std::cos(azimuth);
    const double half = (1 + cosine) / 2;
    const double t2 = (1 - half) * std::sqrt(1 - t1 * t1) + half * radius * std::sin(azimuth);
    const double t3 = std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2));
    // The normal, still stretched: t1 across, t2 upwards in the plane of the light, t3 along the light.
    const double m_x = alpha_ * (t3 * sine - t2 * cosine);
    const double m_y = alpha_ * t1;
    const double m_z = std::max(0.0, t2 * sine + t3 * cosine);
    const double twice = 2 * (in.sin_theta() * m_x + z * m_z) / (m_x * m_x + m_y * m_y + m_z * m_z);
    const double o_x = twice * m_x - in.sin_theta();
    const double o_y = twice * m_y;
    const double o_z = twice * m_z - z;
    if (!(o_z > 0)) return {in.mirror(), 0};
    const Direction out = Direction::from_unit_vector(
        {o_x * in.cos_phi() - o_y * in.sin_phi(), o_x * in.sin_phi() + o_y * in.cos_phi(), o_z});
    return {out, pdf(in, out)};
}

}  // namespace hts::bench
