#include "bench/stability/failures.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>

#include "bench/phi/phi_methods.hpp"

namespace hts::bench {
namespace {

template <class Number>
constexpr Number pi = std::numbers::pi_v<Number>;

template <class Number>
Number square(Number x) {
    return x * x;
}

template <class Number>
Number sine_of(Number cosine) {
    return std::sqrt(1 - cosine * cosine);
}

constexpr int most_steps = 100;

template <class Number>
constexpr Number convergence = std::is_same_v<Number, float> ? Number(1e-6) : Number(1e-12);

/// Of a root x = z_0/sigma_0 [He91 (80)].
template <class Number>
Iteration<Number> ended(Number x, int steps) {
    return {1 / std::sqrt(1 + x * x), steps, steps < most_steps};
}

/// Repeats x <- next(x) until it stands still.
template <class Number, class Next>
Iteration<Number> iterate(Number x, const Next& next) {
    int steps = 0;
    for (; steps < most_steps; ++steps) {
        const Number before = x;
        x = next(before);
        if (std::abs(x - before) <= convergence<Number> * std::abs(x)) break;
    }
    return ended(x, steps);
}

template <class Number>
Number root_half_pi() {
    return std::sqrt(pi<Number> / 2);
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number>
Vector<Number> wave_vector_change(const Rays<Number>& rays) {
    return {rays.out.x - rays.in.x, rays.out.y - rays.in.y, rays.out.z - rays.in.z};
}

/// s and p of a ray [He91 (14), (35)].
template <class Number>
struct Frame {
    Vector<Number> s, p;
};

template <class Number>
Frame<Number> frame(const Vector<Number>& k, NormalFrame normal) {
    Vector<Number> s = cross(k, {0, 0, 1});
    const Number length = std::sqrt(dot(s, s));
    const bool along_normal = normal == NormalFrame::fixed_axis && length == 0;
    s = along_normal ? Vector<Number>{0, 1, 0} : Vector<Number>{s.x / length, s.y / length, s.z / length};
    return {s, cross(s, k)};
}

template <class Number>
struct Angles {
    Number theta, phi;
};

template <class Number>
Vector<Number> unit_vector(double theta_degrees, double phi_degrees) {
    const Number theta = static_cast<Number>(theta_degrees) * pi<Number> / 180;
    const Number phi = static_cast<Number>(phi_degrees) * pi<Number> / 180;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// sigma [um] of a pair [He91 (80), (81)].
template <class Number>
Number effective_roughness(const ModelPoint& point, Number cos_in, Number cos_out) {
    const auto slope =
        static_cast<Number>(point.rms_roughness) / static_cast<Number>(point.correlation_length);
    const Number K = Naive<Number>::obstruction(cos_in, slope) + Naive<Number>::obstruction(cos_out, slope);
    return static_cast<Number>(point.rms_roughness) *
           Naive<Number>::roughness_by_newton(K, Number(1)).roughness_ratio;
}

template <class Number>
std::complex<Number> index_of(const ModelPoint& point) {
    return {static_cast<Number>(point.n), static_cast<Number>(point.k)};
}

}  // namespace

template <class Number>
Number Naive<Number>::slope_argument(Number cosine, Number slope) {
    return cosine / (2 * slope * sine_of(cosine));
}

template <class Number>
Number Naive<Number>::obstruction(Number cosine, Number slope) {
    return sine_of(cosine) / cosine * std::erfc(slope_argument(cosine, slope));
}

template <class Number>
Number Naive<Number>::lambda(Number c) {
    return (std::exp(-c * c) / (std::sqrt(pi<Number>) * c) - std::erfc(c)) / 2;
}

template <class Number>
Number Naive<Number>::lambda_by_erf(Number c) {
    return (std::exp(-c * c) / (std::sqrt(pi<Number>) * c) - (1 - std::erf(c))) / 2;
}

template <class Number>
Number Naive<Number>::lambda_as_printed(Number c) {
    return (1 / (std::sqrt(pi<Number>) * c) - std::erfc(c)) / 2;
}

template <class Number>
Number Naive<Number>::shadowing(Number cosine, Number slope) {
    const Number c = slope_argument(cosine, slope);
    return (1 - std::erfc(c) / 2) / (1 + lambda(c));
}

template <class Number>
Number Naive<Number>::shadowing_as_printed(Number cosine, Number slope) {
    const Number c = slope_argument(cosine, slope);
    return (1 - std::erfc(c) / 2) / (1 + lambda_as_printed(c));
}

template <class Number>
Iteration<Number> Naive<Number>::roughness_by_newton(Number obstruction, Number start) {
    return iterate(start, [obstruction](Number x) {
        const Number right = obstruction / 4 * std::exp(-x * x / 2);
        return x - (root_half_pi<Number>() * x - right) / (root_half_pi<Number>() + x * right);
    });
}

template <class Number>
Iteration<Number> Naive<Number>::roughness_by_fixed_point(Number obstruction) {
    return iterate(Number(0), [obstruction](Number x) {
        return obstruction / 4 * std::exp(-x * x / 2) / root_half_pi<Number>();
    });
}

template <class Number>
Iteration<Number> Naive<Number>::roughness_by_bisection(Number obstruction) {
    Number low = 0;
    Number high = obstruction / (4 * root_half_pi<Number>());
    int steps = 0;
    for (; steps < most_steps && high - low > convergence<Number> * high; ++steps) {
        const Number middle = (low + high) / 2;
        const bool below = root_half_pi<Number>() * middle < obstruction / 4 * std::exp(-middle * middle / 2);
        (below ? low : high) = middle;
    }
    return ended((low + high) / 2, steps);
}

template <class Number>
Rays<Number> Naive<Number>::rays_of(const Direction& in, const Direction& out) {
    const auto converted = [](Vector3 v) {
        return Vector<Number>{static_cast<Number>(v.x), static_cast<Number>(v.y), static_cast<Number>(v.z)};
    };
    return {converted(-in.vector()), converted(out.vector())};
}

template <class Number>
Number Naive<Number>::geometrical_factor_as_printed(const Rays<Number>& rays) {
    const auto in = frame(rays.in, NormalFrame::as_printed);
    const auto out = frame(rays.out, NormalFrame::as_printed);
    const Vector<Number> v = wave_vector_change(rays);
    const Vector<Number> normal = cross(rays.out, rays.in);
    return square(dot(v, v) / v.z) / square(dot(normal, normal)) *
           (square(dot(out.s, rays.in)) + square(dot(out.p, rays.in))) *
           (square(dot(in.s, rays.out)) + square(dot(in.p, rays.out)));
}

template <class Number>
Jones<Number> Naive<Number>::jones_as_printed(const Rays<Number>& rays, const Amplitudes<Number>& amplitudes,
                                              NormalFrame normal) {
    const auto in = frame(rays.in, normal);
    const auto out = frame(rays.out, normal);
    const auto& [f_s, f_p] = amplitudes;
    const Number s_in = dot(in.s, rays.out);
    const Number p_in = dot(in.p, rays.out);
    const Number s_out = dot(out.s, rays.in);
    const Number p_out = dot(out.p, rays.in);
    const Vector<Number> both = cross(rays.out, rays.in);
    const Number scale = 1 / dot(both, both);
    return {scale * (p_in * p_out * f_s + s_in * s_out * f_p),
            -scale * (s_in * p_out * f_s - p_in * s_out * f_p),
            -scale * (p_in * s_out * f_s - s_in * p_out * f_p),
            scale * (s_in * s_out * f_s + p_in * p_out * f_p)};
}

template <class Number>
Amplitudes<Number> Naive<Number>::fresnel(Number cosine, std::complex<Number> index) {
    const std::complex<Number> square = index * index;
    const std::complex<Number> r = std::sqrt(square - (1 - cosine * cosine));
    return {(cosine - r) / (cosine + r), (square * cosine - r) / (square * cosine + r)};
}

template <class Number>
Number Naive<Number>::fresnel_schlick(Number cosine, std::complex<Number> index) {
    const Number at_normal = std::norm((index - Number(1)) / (index + Number(1)));
    return at_normal + (1 - at_normal) * std::pow(1 - cosine, Number(5));
}

template <class Number>
Number Naive<Number>::model(const ModelPoint& point) {
    const Vector<Number> towards_light = unit_vector<Number>(point.theta_i, point.phi_i);
    const Rays<Number> both{{-towards_light.x, -towards_light.y, -towards_light.z},
                            unit_vector<Number>(point.theta_r, point.phi_r)};
    const Number cos_in = towards_light.z;
    const Number cos_out = both.out.z;
    const auto tau = static_cast<Number>(point.correlation_length);
    const Number slope = static_cast<Number>(point.rms_roughness) / tau;
    const Number wave_number = 2 * pi<Number> / static_cast<Number>(point.wavelength);
    const Vector<Number> v = wave_vector_change(both);
    const Number g = square(wave_number * effective_roughness(point, cos_in, cos_out) * v.z);
    const Number t = square(wave_number * tau) * (v.x * v.x + v.y * v.y) / 4;
    const Number D = square(wave_number * tau) / 16 * phi_series_adaptive(g, t);  // (78)
    const Number F = fresnel(std::sqrt(dot(v, v)) / 2, index_of<Number>(point)).unpolarised_reflectance();
    const Number S = shadowing(cos_in, slope) * shadowing(cos_out, slope);
    return F * geometrical_factor_as_printed(both) * S * D / (pi<Number> * cos_in * cos_out);  // (71)
}

template <class Number>
Number Naive<Number>::specular(const ModelPoint& point) {
    const Number cosine = unit_vector<Number>(point.theta_i, 0).z;
    const Number slope =
        static_cast<Number>(point.rms_roughness) / static_cast<Number>(point.correlation_length);
    const Number sigma = effective_roughness(point, cosine, cosine);
    const Number g = square(4 * pi<Number> * sigma / static_cast<Number>(point.wavelength) * cosine);
    return fresnel(cosine, index_of<Number>(point)).unpolarised_reflectance() * std::exp(-g) *
           square(shadowing(cosine, slope));
}

template struct Naive<float>;
template struct Naive<double>;

}  // namespace hts::bench
