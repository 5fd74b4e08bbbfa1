/// The formulas of [He91] as printed, or as one types them at first, in double and in single precision. They
/// are right on paper and fail in floating point; the stability suite shows where.
#pragma once

#include <complex>

#include "hts/direction.hpp"

namespace hts::bench {

/// Where an iteration for the root z_0 of [He91 (81)] ended.
template <class Number>
struct Iteration {
    Number roughness_ratio;  ///< sigma/sigma_0 [He91 (80)]
    int steps;
    bool converged;
};

template <class Number>
struct Vector {
    Number x, y, z;
};

/// Propagation vectors of a pair, k_i = -in and k_r = out.
template <class Number>
struct Rays {
    Vector<Number> in, out;
};

/// Of Fresnel.
template <class Number>
struct Amplitudes {
    std::complex<Number> s, p;

    [[nodiscard]] Number unpolarised_reflectance() const { return (std::norm(s) + std::norm(p)) / 2; }
};

template <class Number>
struct Jones {
    std::complex<Number> ss, sp, ps, pp;
};

/// What stands in for s = k x z/|k x z| along the normal.
enum class NormalFrame {
    as_printed,  ///< nothing: 0/0
    fixed_axis   ///< s = y, the usual patch
};

/// A point of the model: micrometres and degrees; nothing is checked.
struct ModelPoint {
    double wavelength, theta_i, phi_i, theta_r, phi_r, n, k, rms_roughness, correlation_length;
};

/// The formulas, for Number float or double. `cosine` is that of the polar angle, `slope` is sigma_0/tau.
template <class Number>
struct Naive {
    /// c = tau cot(theta)/(2 sigma_0).
    [[nodiscard]] static Number slope_argument(Number cosine, Number slope);

    /// K = tan(theta) erfc(c) [He91 (82)].
    [[nodiscard]] static Number obstruction(Number cosine, Number slope);

    /// Lambda = (exp(-c^2)/(sqrt(pi) c) - erfc(c))/2, [He91 (25)] with Smith's exponential.
    [[nodiscard]] static Number lambda(Number c);
    /// The same with 1 - erf(c).
    [[nodiscard]] static Number lambda_by_erf(Number c);
    /// [He91 (25)] as printed, without the exponential.
    [[nodiscard]] static Number lambda_as_printed(Number c);

    /// S_1 = (1 - erfc(c)/2)/(1 + Lambda) [He91 (24)], with Smith's exponential and as printed.
    [[nodiscard]] static Number shadowing(Number cosine, Number slope);
    [[nodiscard]] static Number shadowing_as_printed(Number cosine, Number slope);

    // x = z_0/sigma_0 from sqrt(pi/2) x = (K/4) exp(-x^2/2) [He91 (81)]

    /// Newton's method without safeguard.
    [[nodiscard]] static Iteration<Number> roughness_by_newton(Number obstruction, Number start);
    /// x <- (K/4) exp(-x^2/2)/sqrt(pi/2), from 0.
    [[nodiscard]] static Iteration<Number> roughness_by_fixed_point(Number obstruction);
    /// Bisection of [0, (K/4)/sqrt(pi/2)].
    [[nodiscard]] static Iteration<Number> roughness_by_bisection(Number obstruction);

    [[nodiscard]] static Rays<Number> rays_of(const Direction& in, const Direction& out);
    /// G as printed [He91 (76)].
    [[nodiscard]] static Number geometrical_factor_as_printed(const Rays<Number>& rays);
    /// M of [He91 (61)-(64)] over |k_r x k_i|^2, from s and p of [He91 (14), (35)].
    [[nodiscard]] static Jones<Number> jones_as_printed(const Rays<Number>& rays,
                                                        const Amplitudes<Number>& amplitudes,
                                                        NormalFrame normal = NormalFrame::as_printed);

    /// F_s = (c - r)/(c + r), F_p = (N^2 c - r)/(N^2 c + r), r = sqrt(N^2 - sin^2), N = `index`.
    [[nodiscard]] static Amplitudes<Number> fresnel(Number cosine, std::complex<Number> index);
    /// Schlick's F_0 + (1 - F_0)(1 - c)^5.
    [[nodiscard]] static Number fresnel_schlick(Number cosine, std::complex<Number> index);

    /// The directional-diffuse BRDF [He91 (71)] from the pieces above, the root by Newton's method from z_0 =
    /// sigma_0 and the sum over m from exp(-g).
    [[nodiscard]] static Number model(const ModelPoint& point);
    /// The specular reflectance [He91 (73)] likewise.
    [[nodiscard]] static Number specular(const ModelPoint& point);
};

}  // namespace hts::bench
