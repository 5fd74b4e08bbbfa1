// pbrt-v4's rough conductor, formula by formula; included once per instruction set, within a namespace of
// its own for each way to compile it.
#if defined(HTS_PBRT_CONDUCTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PBRT_CONDUCTOR_INL
#undef HTS_PBRT_CONDUCTOR_INL
#else
#define HTS_PBRT_CONDUCTOR_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bench/rivals/pbrt_conductor.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::bench::HTS_PBRT_COMPILATION::HWY_NAMESPACE {

constexpr float pi = std::numbers::pi_v<float>;

HWY_INLINE float square(float x) {
    return x * x;
}
HWY_INLINE float root(float x) {
    return std::sqrt(x);
}
HWY_INLINE float safe_root(float x) {
    return root(std::max(0.0F, x));
}
HWY_INLINE float dot(Vector3f a, Vector3f b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Vector3f scaled(float s, Vector3f a) {
    return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE Vector3f sum(Vector3f a, Vector3f b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vector3f cross(Vector3f a, Vector3f b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Vector3f normalised(Vector3f a) {
    const float length = root(dot(a, a));
    return {a.x / length, a.y / length, a.z / length};
}

// --- angles of a unit vector -----------------------------------------------------------------------------

HWY_INLINE float cos_squared(Vector3f w) {
    return w.z * w.z;
}
HWY_INLINE float sin_squared(Vector3f w) {
    return std::max(0.0F, 1 - cos_squared(w));
}
HWY_INLINE float tan_squared(Vector3f w) {
    return sin_squared(w) / cos_squared(w);
}
HWY_INLINE float cos_phi(Vector3f w) {
    const float sine = root(sin_squared(w));
    return sine == 0 ? 1 : std::clamp(w.x / sine, -1.0F, 1.0F);
}
HWY_INLINE float sin_phi(Vector3f w) {
    const float sine = root(sin_squared(w));
    return sine == 0 ? 0 : std::clamp(w.y / sine, -1.0F, 1.0F);
}

// --- Trowbridge-Reitz normals ----------------------------------------------------------------------------

HWY_INLINE float distribution(const PbrtMetal& m, Vector3f normal) {
    const float tangent = tan_squared(normal);
    if (std::isinf(tangent)) return 0;
    const float cos_4 = square(cos_squared(normal));
    if (cos_4 < 1e-16F) return 0;
    const float e = tangent * (square(cos_phi(normal) / m.alpha_x) + square(sin_phi(normal) / m.alpha_y));
    return 1 / (pi * m.alpha_x * m.alpha_y * cos_4 * square(1 + e));
}
HWY_INLINE float lambda(const PbrtMetal& m, Vector3f w) {
    const float tangent = tan_squared(w);
    if (std::isinf(tangent)) return 0;
    const float alpha_squared = square(cos_phi(w) * m.alpha_x) + square(sin_phi(w) * m.alpha_y);
    return (root(1 + alpha_squared * tangent) - 1) / 2;
}
HWY_INLINE float shadowing(const PbrtMetal& m, Vector3f w) {
    return 1 / (1 + lambda(m, w));
}
HWY_INLINE float shadowing(const PbrtMetal& m, Vector3f in, Vector3f out) {
    return 1 / (1 + lambda(m, in) + lambda(m, out));
}
/// Density of the normals that `w` sees.
HWY_INLINE float visible(const PbrtMetal& m, Vector3f w, Vector3f normal) {
    return shadowing(m, w) / std::abs(w.z) * distribution(m, normal) * std::abs(dot(w, normal));
}

HWY_INLINE Vector3f drawn_normal(const PbrtMetal& m, Vector3f w, float u0, float u1) {
    Vector3f pole = normalised({m.alpha_x * w.x, m.alpha_y * w.y, w.z});
    if (pole.z < 0) pole = scaled(-1, pole);
    const Vector3f across = pole.z < 0.99999F ? normalised(cross({0, 0, 1}, pole)) : Vector3f{1, 0, 0};
    const Vector3f along = cross(pole, across);
    const float radius = root(u0), azimuth = 2 * pi * u1;
    const float x = radius * std::cos(azimuth);
    const float half = (1 + pole.z) / 2;
    const float y = (1 - half) * root(1 - square(x)) + half * radius * std::sin(azimuth);
    const float z = safe_root(1 - square(x) - square(y));
    const Vector3f stretched = sum(sum(scaled(x, across), scaled(y, along)), scaled(z, pole));
    return normalised({m.alpha_x * stretched.x, m.alpha_y * stretched.y, std::max(1e-6F, stretched.z)});
}

// --- reflectance of a complex index ----------------------------------------------------------------------

struct Complex {
    float re, im;
};
HWY_INLINE Complex operator+(Complex a, Complex b) {
    return {a.re + b.re, a.im + b.im};
}
HWY_INLINE Complex operator-(Complex a, Complex b) {
    return {a.re - b.re, a.im - b.im};
}
HWY_INLINE Complex operator*(Complex a, Complex b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
HWY_INLINE float norm(Complex a) {
    return a.re * a.re + a.im * a.im;
}
HWY_INLINE Complex operator/(Complex a, Complex b) {
    const float scale = 1 / norm(b);
    return {scale * (a.re * b.re + a.im * b.im), scale * (a.im * b.re - a.re * b.im)};
}
HWY_INLINE Complex root(Complex a) {
    const float modulus = root(norm(a));
    const float larger = root(0.5F * (modulus + std::abs(a.re))), smaller = 0.5F * a.im / larger;
    if (modulus == 0) return {0, 0};
    if (a.re >= 0) return {larger, smaller};
    return {std::abs(smaller), std::copysign(larger, a.im)};
}

HWY_INLINE float fresnel(float cosine, Complex eta) {
    cosine = std::clamp(cosine, 0.0F, 1.0F);
    const Complex sine_t = Complex{1 - square(cosine), 0} / (eta * eta);
    const Complex cosine_t = root(Complex{1, 0} - sine_t);
    const Complex tilted = eta * Complex{cosine, 0}, refracted = eta * cosine_t;
    const Complex parallel = (tilted - cosine_t) / (tilted + cosine_t);
    const Complex perpendicular = (Complex{cosine, 0} - refracted) / (Complex{cosine, 0} + refracted);
    return (norm(parallel) + norm(perpendicular)) / 2;
}

// --- the conductor ---------------------------------------------------------------------------------------

/// Of the normal between both directions.
template <std::size_t count>
HWY_INLINE void brdf_of(const PbrtMetal& m, Vector3f in, Vector3f out, Vector3f normal, float* result) {
    const float cosine = std::abs(dot(in, normal));
    for (std::size_t i = 0; i < count; ++i) result[i] = fresnel(cosine, {m.eta[i], m.k[i]});
    const float d = distribution(m, normal), g = shadowing(m, in, out);
    const float below = 4 * std::abs(in.z) * std::abs(out.z);
    for (std::size_t i = 0; i < count; ++i) result[i] = d * result[i] * g / below;
}

template <std::size_t count>
HWY_ATTR void brdf(const PbrtMetal& m, Vector3f in, Vector3f out, float* result) {
    const Vector3f between = sum(in, out);
    if (in.z * out.z <= 0 || std::min(m.alpha_x, m.alpha_y) < 1e-3F || dot(between, between) == 0) {
        std::fill_n(result, count, 0.0F);
        return;
    }
    brdf_of<count>(m, in, out, normalised(between), result);
}

HWY_INLINE PbrtDraw drawn(const PbrtMetal& m, Vector3f in, Vector3f normal) {
    const Vector3f out = sum(scaled(-1, in), scaled(2 * dot(in, normal), normal));
    if (in.z * out.z <= 0) return {out, 0};
    return {out, visible(m, in, normal) / (4 * std::abs(dot(in, normal)))};
}

template <std::size_t count>
HWY_ATTR PbrtDraw sample(const PbrtMetal& m, Vector3f in, float u0, float u1, float* result) {
    const Vector3f normal = drawn_normal(m, in, u0, u1);
    const PbrtDraw made = drawn(m, in, normal);
    if (made.pdf > 0) brdf_of<count>(m, in, made.out, normal, result);
    return made;
}

HWY_ATTR float pdf(const PbrtMetal& m, Vector3f in, Vector3f out) {
    const Vector3f between = sum(in, out);
    if (in.z * out.z <= 0 || dot(between, between) == 0) return 0;
    Vector3f normal = normalised(between);
    if (normal.z < 0) normal = scaled(-1, normal);
    return visible(m, in, normal) / (4 * std::abs(dot(in, normal)));
}

HWY_ATTR PbrtDraw draw(const PbrtMetal& m, Vector3f in, float u0, float u1) {
    return drawn(m, in, drawn_normal(m, in, u0, u1));
}

template <std::size_t count>
PbrtForms forms_of() {
    return {brdf<count>, sample<count>, pdf, draw};
}

PbrtForms forms(std::size_t count) {
    switch (count) {
        case 1:
            return forms_of<1>();
        case 4:
            return forms_of<4>();
        case 8:
            return forms_of<8>();
        case 16:
            return forms_of<16>();
        case 31:
            return forms_of<31>();
        default:
            return {};
    }
}

}  // namespace hts::bench::HTS_PBRT_COMPILATION::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
