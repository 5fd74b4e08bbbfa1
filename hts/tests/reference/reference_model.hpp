// The whole model at one point, from the literal pieces of reference_physics.hpp.
#pragma once

#include <utility>

#include "reference_physics.hpp"

namespace reference {

/// A row of a points file of `hts eval`: micrometres and decimal degrees. Both directions point away from the
/// surface; the mirror direction of (theta_i, phi_i) is (theta_i, phi_i + 180).
template <class Number>
struct PointOf {
    Number wavelength, theta_i, phi_i, theta_r, phi_r, n, k, rms_roughness, correlation_length, albedo;
};
using Point = PointOf<double>;

inline constexpr const char* point_columns =
    "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,n,k,rms_roughness_um,correlation_length_um,"
    "albedo";

inline std::vector<std::string> cells(const Point& p) {
    return {text(p.wavelength), text(p.theta_i),       text(p.phi_i),
            text(p.theta_r),    text(p.phi_r),         text(p.n),
            text(p.k),          text(p.rms_roughness), text(p.correlation_length),
            text(p.albedo)};
}

inline Point reversed(Point p) {
    std::swap(p.theta_i, p.theta_r);
    std::swap(p.phi_i, p.phi_r);
    return p;
}

struct Reflection {
    Real directional_diffuse, uniform_diffuse, specular_reflectance;
    Mueller mueller;           ///< of the directional-diffuse term, 1/sr
    Jones jones;               ///< dimensionless
    Real g, t;                 ///< of the pair of directions
    Real effective_roughness;  ///< of the pair [um]
    Real shadowing;            ///< S = S1(theta_i) S1(theta_r) (23)
    Real fresnel;              ///< |F|^2 at the bisecting angle (75)
    Real cos_bisector;         ///< cosine of the polar angle of the bisector
};

/// sigma for two obstructions (80).
template <class Number>
Real effective_roughness(const PointOf<Number>& p, const Obstruction& in, const Obstruction& out) {
    return Real(p.rms_roughness) * effective_roughness_ratio(in.K + out.K);
}

/// g (79), with the effective roughness as (9) says.
template <class Number>
Real phase_variance(const PointOf<Number>& p, const Real& sigma, const Real& cos_sum) {
    const Real root = 2 * pi * sigma / Real(p.wavelength) * cos_sum;
    return root * root;
}

/// (73) at theta_r = theta_i: |F|^2 e^-g S.
template <class Number>
Real specular_reflectance(const PointOf<Number>& p, const Obstruction& in) {
    const Real cosine = cos(radians(p.theta_i));
    const Real g = phase_variance(p, effective_roughness(p, in, in), 2 * cosine);
    const Real F = fresnel(cosine, {Real(p.n), Real(p.k)}).unpolarised();
    return F * exp(-g) * in.S1 * in.S1;
}

/// G (76), v in units of 2 pi/lambda.
inline Real geometrical_factor(const Vector& ki, const Vector& kr) {
    const Frame in = frame(ki), out = frame(kr);
    const Vector v = kr - ki, normal = cross(kr, ki);
    const Real ratio = dot(v, v) / v.z, length_squared = dot(normal, normal);
    const auto square = [](const Real& x) { return x * x; };
    return square(ratio) / square(length_squared) * (square(dot(out.s, ki)) + square(dot(out.p, ki))) *
           (square(dot(in.s, kr)) + square(dot(in.p, kr)));
}

/// The three terms (70)-(73), f_ud = a/pi, and everything on the way.
template <class Number>
Reflection reflection(const PointOf<Number>& p) {
    const Real lambda = p.wavelength, tau = p.correlation_length, ratio = Real(p.rms_roughness) / tau;
    const Real theta_i = radians(p.theta_i), theta_r = radians(p.theta_r);
    const Vector ki = -direction(theta_i, radians(p.phi_i)), kr = direction(theta_r, radians(p.phi_r));
    const Vector v = kr - ki;  // (84), in units of 2 pi/lambda
    const Obstruction in = obstruction(theta_i, ratio), out = obstruction(theta_r, ratio);

    Reflection f;
    f.effective_roughness = effective_roughness(p, in, out);
    f.g = phase_variance(p, f.effective_roughness, cos(theta_i) + cos(theta_r));
    const Real wave_number = 2 * pi / lambda;
    f.t = wave_number * wave_number * (v.x * v.x + v.y * v.y) * tau * tau / 4;
    if (f.t < Real("1e-60")) f.t = 0;  // the exact mirror direction
    f.shadowing = in.S1 * out.S1;
    const Fresnel amplitudes = fresnel(length(v) / 2, {Real(p.n), Real(p.k)});
    f.fresnel = amplitudes.unpolarised();
    f.jones = jones(ki, kr, amplitudes);
    f.cos_bisector = v.z / length(v);

    const Real D = pi * pi * tau * tau / (4 * lambda * lambda) * phi_sums(f.g, f.t).phi;  // (78)
    const Real common = geometrical_factor(ki, kr) * f.shadowing * D / (pi * cos(theta_i) * cos(theta_r));
    f.directional_diffuse = f.fresnel * common;  // (71)
    f.uniform_diffuse = Real(p.albedo) / pi;     // (72)
    f.specular_reflectance = specular_reflectance(p, in);
    f.mueller = mueller(f.jones);
    for (auto& row : f.mueller)
        for (Real& element : row) element *= common;
    return f;
}

/// The geometric-optics limit, F S D_B/(4 cos theta_i cos theta_r), D_B the Beckmann distribution of Walter
/// et al. 2007, eq. (25), of width alpha = 2 sigma/tau with the effective roughness.
inline Real geometric_optics_limit(const Point& p, const Reflection& f) {
    const Real alpha = 2 * f.effective_roughness / Real(p.correlation_length);
    const Real c2 = f.cos_bisector * f.cos_bisector;
    const Real beckmann = exp(-(1 - c2) / (c2 * alpha * alpha)) / (pi * alpha * alpha * c2 * c2);
    return f.fresnel * f.shadowing * beckmann / (4 * cos(radians(p.theta_i)) * cos(radians(p.theta_r)));
}

}  // namespace reference
