// He, Torrance, Sillion & Greenberg 1991 as printed, at 80 digits: the literal forms of the paper, with the
// errata settled ((25) has its factor exp(-c^2) back; (72) has its 1/pi). No closed form, no stable form and
// no limit of the engine is used, so a mistake in one of those cannot hide here. The literal forms are 0/0 at
// exact backscatter, at normal incidence or view, and at 90 degrees: such points must not be asked for.
// Equation numbers are those of the paper, [He91].
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/special_functions/bernoulli.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/rational.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reference_numbers.hpp"

namespace reference {

// ---------------------------------------------------------------------------------------------------- Phi

/// Phi(g, t) = e^-g sum_{m>=1} g^m/(m! m) e^(-t/m), the sum of (78), and its companion
/// Psi(g, t) = e^-g sum_{m>=1} g^m/m! e^(-t/m).
struct PhiSums {
    Real log_phi, phi, psi;
};

/// ln m!: the product for small m, Stirling's series with Bernoulli numbers (error below 1e-95) above.
inline Real log_factorial(std::int64_t m) {
    if (m < 200) {
        Real product = 1;
        for (std::int64_t j = 2; j <= m; ++j) product *= j;
        return log(product);
    }
    static const std::vector<Real> coefficients = [] {
        std::vector<Real> c;
        for (int j = 1; j <= 30; ++j)
            c.push_back(boost::math::bernoulli_b2n<Real>(j) / (2 * j * (2 * j - 1)));
        return c;
    }();
    const Real x = m;
    const Real series =
        boost::math::tools::evaluate_polynomial(coefficients.data(), Real{1 / (x * x)}, coefficients.size());
    return (x + Real(1) / 2) * log(x) - x + log(2 * pi) / 2 + series / x;
}

/// The m of the largest summand, to within a few: the root of m^2 ln(m/g) = t, by bisection.
inline std::int64_t largest_term(double g, double t) {
    double low = 1, high = 3 * g + std::sqrt(t) + 10;
    for (int step = 0; step < 100; ++step) {
        const double middle = (low + high) / 2;
        (middle * middle * std::log(middle / g) < t ? low : high) = middle;
    }
    return static_cast<std::int64_t>(low);
}

/// ln of the summand of Psi: e^-g g^m/m! e^(-t/m).
inline Real log_summand(const Real& g, const Real& t, std::int64_t m) {
    return m * log(g) - g - log_factorial(m) - t / m;
}

/// Terms below this fraction of the largest are dropped; at most 1e6 of them matter, so the sum keeps 60
/// digits.
inline const Real negligible{"1e-75"};

inline PhiSums finished(const Real& log_scale, const Real& phi_sum, const Real& psi_sum) {
    const Real log_phi = log_scale + log(phi_sum);
    return {log_phi, exp(log_phi), exp(log_scale + log(psi_sum))};
}

/// The plain sum: every m in the window about the largest term, g^m/m! carried along by recurrence.
inline PhiSums phi_by_every_term(const Real& g, const Real& t) {
    const std::int64_t centre = largest_term(static_cast<double>(g), static_cast<double>(t));
    const Real t_centre = t / centre;
    Real phi_sum = 0, psi_sum = 0;
    const auto matters = [&](const Real& poisson, std::int64_t m) {
        const Real term = poisson * exp(t_centre - t / m);
        psi_sum += term;
        phi_sum += term / m;
        return term > negligible;
    };
    Real poisson = 1;
    for (std::int64_t m = centre; matters(poisson, m); ++m) poisson *= g / (m + 1);
    poisson = Real(centre) / g;
    for (std::int64_t m = centre - 1; m >= 1 && matters(poisson, m); --m) poisson *= Real(m) / g;
    return finished(log_summand(g, t, centre), phi_sum, psi_sum);
}

/// Standard deviation of the summand about its largest term m: (1/m + 2t/m^3)^(-1/2).
inline double summand_width(double t, double m) {
    return 1 / std::sqrt(1 / m + 2 * t / (m * m * m));
}

/// The same sum from every h-th term times h (the trapezoid rule in m), h a quarter of the width s. The
/// summand is smooth, so the error is about 2 exp(-2 pi^2 s^2/h^2) = 1e-137; exactly 2 exp(-g (1 - cos 2
/// pi/h)) for Psi at t = 0. check_stride() in reference_checks.hpp compares it with the plain sum for g = 2e4
/// ... 1e8.
inline PhiSums phi_by_stride(const Real& g, const Real& t) {
    const std::int64_t centre = largest_term(static_cast<double>(g), static_cast<double>(t));
    const double width = summand_width(static_cast<double>(t), static_cast<double>(centre));
    const std::int64_t stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(width / 4));
    const Real log_centre = log_summand(g, t, centre);
    Real phi_sum = 0, psi_sum = 0;
    const auto matters = [&](std::int64_t m) {
        const Real term = stride * exp(log_summand(g, t, m) - log_centre);
        psi_sum += term;
        phi_sum += term / m;
        return term > negligible;
    };
    for (std::int64_t m = centre; matters(m);) m += stride;
    for (std::int64_t m = centre - stride; m >= 1 && matters(m);) m -= stride;
    return finished(log_centre, phi_sum, psi_sum);
}

inline PhiSums phi_sums(const Real& g, const Real& t) {
    return g < 20000 ? phi_by_every_term(g, t) : phi_by_stride(g, t);
}

// -------------------------------------------------------------------------------------------- obstruction

/// What one direction contributes to effective roughness and shadowing.
struct Obstruction {
    Real K;       ///< (82), (83)
    Real lambda;  ///< (25) with the factor exp(-c^2)
    Real S1;      ///< (24)
};

inline Obstruction obstruction(const Real& theta, const Real& sigma_over_tau) {
    const Real tangent = sin(theta) / cos(theta);
    const Real c = 1 / (2 * sigma_over_tau * tangent);
    const Real complement = boost::math::erfc(c);
    const Real lambda = (exp(-c * c) / (sqrt(pi) * c) - complement) / 2;
    return {tangent * complement, lambda, (1 - complement / 2) / (lambda + 1)};
}

/// sigma / sigma0 from the root z0 of (81), here x = z0/sigma0: sqrt(pi/2) x = K/4 exp(-x^2/2), put into
/// (80). The left side rises and the right side falls, so [0, K/4 / sqrt(pi/2)] brackets the one root:
/// bisection.
inline Real effective_roughness_ratio(const Real& K) {
    const Real slope = sqrt(pi / 2);
    Real low = 0, high = K / (4 * slope);
    for (int step = 0; step < 320; ++step) {
        const Real middle = (low + high) / 2;
        (slope * middle < K / 4 * exp(-middle * middle / 2) ? low : high) = middle;
    }
    const Real x = (low + high) / 2;
    return 1 / sqrt(1 + x * x);
}

// ------------------------------------------------------------------------------------------------ Fresnel

struct Fresnel {
    Complex s, p;
    [[nodiscard]] Real unpolarised() const { return (norm(s) + norm(p)) / 2; }
};

/// F_s = (c - r)/(c + r), F_p = (n^2 c - r)/(n^2 c + r), r = sqrt(n^2 - sin^2), time factor exp(-i omega t).
inline Fresnel fresnel(const Real& cosine, const Complex& index) {
    const Complex c{cosine, 0};
    const Complex square = index * index;
    const Complex r = sqrt(square - Complex{1 - cosine * cosine, 0});
    return {(c - r) / (c + r), (square * c - r) / (square * c + r)};
}

// ------------------------------------------------------------------------------------------- polarisation

/// s = k x z/|k x z|, p = s x k (14), (35), (85), (86).
struct Frame {
    Vector s, p;
};

inline Frame frame(const Vector& k) {
    const Vector normal_to_plane = cross(k, Vector{0, 0, 1});
    const Vector s = normal_to_plane / length(normal_to_plane);
    return {s, cross(s, k)};
}

struct Jones {
    Complex ss, sp, ps, pp;
    [[nodiscard]] Real half_sum_of_squares() const { return (norm(ss) + norm(sp) + norm(ps) + norm(pp)) / 2; }
};

/// (61)-(64), divided by |k_r x k_i|^2.
inline Jones jones(const Vector& ki, const Vector& kr, const Fresnel& f) {
    const Frame in = frame(ki), out = frame(kr);
    const Real si = dot(in.s, kr), pi_ = dot(in.p, kr), sr = dot(out.s, ki), pr = dot(out.p, ki);
    const Vector normal = cross(kr, ki);
    const Real scale = 1 / dot(normal, normal);
    return {scale * (pi_ * pr * f.s + si * sr * f.p), -scale * (si * pr * f.s - pi_ * sr * f.p),
            -scale * (pi_ * sr * f.s - si * pr * f.p), scale * (si * sr * f.s + pi_ * pr * f.p)};
}

using Stokes = std::array<Real, 4>;
using Mueller = std::array<std::array<Real, 4>, 4>;

/// (|Es|^2 + |Ep|^2, |Es|^2 - |Ep|^2, 2 Re Es Ep*, -2 Im Es Ep*): the convention of the interface.
inline Stokes stokes(const Complex& Es, const Complex& Ep) {
    const Complex product = Es * conj(Ep);
    return {norm(Es) + norm(Ep), norm(Es) - norm(Ep), 2 * product.re, -2 * product.im};
}

/// The Mueller matrix from what the Jones matrix does to four pure states: s, p, S2 = 1 and S3 = 1. Elements
/// below 1e-60 of m00 are zeros of exact arithmetic (in the plane of incidence, or k = 0) and are written so.
inline Mueller mueller(const Jones& j) {
    const auto reflected = [&j](const Complex& Es, const Complex& Ep) {
        return stokes(j.ss * Es + j.sp * Ep, j.ps * Es + j.pp * Ep);
    };
    const Real half_root = sqrt(Real(1) / 2);
    const Complex zero{}, one{1, 0}, part{half_root, 0}, imaginary_part{0, half_root};
    const Stokes from_s = reflected(one, zero), from_p = reflected(zero, one);
    const Stokes from_diagonal = reflected(part, part), from_circular = reflected(part, imaginary_part);
    Mueller m;
    for (std::size_t row = 0; row < 4; ++row) {
        const Real unpolarised = (from_s[row] + from_p[row]) / 2;
        m[row] = {unpolarised, (from_s[row] - from_p[row]) / 2, from_diagonal[row] - unpolarised,
                  from_circular[row] - unpolarised};
    }
    for (auto& row : m)
        for (Real& element : row)
            if (abs(element) < Real("1e-60") * m[0][0]) element = 0;
    return m;
}

}  // namespace reference
