#include "hts/microfacet/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include "hts/error.hpp"

namespace hts {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inv_pi = std::numbers::inv_pi;
constexpr double inv_sqrtpi = std::numbers::inv_sqrtpi;

void require_width(double alpha) {
    if (!(alpha >= 1e-6 && alpha <= 1e3))
        throw out_of_range("facet width alpha", alpha, "", "from 1e-06 to 1000");
}

double square(double x) {
    return x * x;
}

/// cot(theta)/alpha, the a of (26) and (27); infinite along the normal.
double scaled_cotangent(const Direction& v, double alpha) {
    const double reach = alpha * v.sin_theta();
    return reach > 0 ? v.cos_theta() / reach : std::numeric_limits<double>::infinity();
}

/// 1 + Lambda of Gaussian slopes, the reciprocal of (26).
double gaussian_obstruction(double a) {
    return (1 + std::erf(a) + std::exp(-a * a) * inv_sqrtpi / a) / 2;
}

/// 1 + Lambda of Phong, (48) with P_2 proportional to (1 + q^2)^(-(e + 3)/2).
double phong_obstruction(const Direction& v, double exponent) {
    const double cos_squared = std::min(1.0, square(v.cos_theta()));  // of a drawn direction it may exceed 1
    const double half = exponent / 2 + 1;
    const double power = std::exp(half * std::log1p(-cos_squared));  // sin^(e + 2), and Lambda is less
    if (power < 1e-20) return 1;
    const double peak = inv_sqrtpi / boost::math::tgamma_delta_ratio(half, 0.5);
    return 1 + peak * power / ((exponent + 1) * v.cos_theta()) -
           boost::math::ibetac(0.5, half, cos_squared) / 2;
}

/// (27).
double rational_shadowing(double a) {
    return a < 1.6 ? a * (3.535 + 2.181 * a) / (1 + a * (2.276 + 2.577 * a)) : 1;
}

/// (26) over cos theta, multiplied out: finite at the horizon and along the normal.
double beckmann_visibility(const Direction& v, double alpha) {
    const double reach = alpha * v.sin_theta();
    if (v.cos_theta() > 6 * reach) return 1 / v.cos_theta();  // to the last bit
    const double a = v.cos_theta() / reach;
    return 2 / (v.cos_theta() * (1 + std::erf(a)) + reach * std::exp(-a * a) * inv_sqrtpi);
}

/// (34) over cos theta, multiplied out alike.
double ggx_visibility(const Direction& v, double alpha) {
    return 2 / (v.cos_theta() + std::sqrt(square(v.cos_theta()) + square(alpha * v.sin_theta())));
}

// Where exp(-tan^2/alpha^2) is 0.
constexpr double beyond_range = 750;

double beckmann_density(double tan_squared, double alpha) {
    const double inverse = 1 / square(alpha);
    const double exponent = tan_squared * inverse;
    if (exponent > beyond_range) return 0;
    return std::exp(-exponent) * square(1 + tan_squared) * (inv_pi * inverse);
}

double phong_density(double tan_squared, double exponent) {
    const double farthest = std::numeric_limits<double>::max();  // 0 times infinity is NaN
    return (exponent + 2) * inv_pi / 2 *
           std::exp(-exponent / 2 * std::log1p(std::min(tan_squared, farthest)));
}

double ggx_density(double tan_squared, double alpha) {
    if (tan_squared > 1e30) return square(alpha) * inv_pi;  // the limit, exact to 1e-24
    return square((1 + tan_squared) / (square(alpha) + tan_squared)) * square(alpha) * inv_pi;
}

/// The slope q along v, in units of alpha, of a visible facet with Gaussian slopes: the root of C(q) = u
/// C(a), where C(q) is the integral of (1 - x t) exp(-x^2)/sqrt(pi) up to q and t = 1/a the tangent of v in
/// those units; C(a) = 1/G_1. The density is log-concave on x < a, so ln C is concave, and Newton's method
/// climbs to the root from any point below it without passing it. -sqrt(-ln u) is below: there C <= u (1/2 +
/// t/(2 sqrt pi)) = u C(0) <= u C(a).
double visible_gaussian_slope(double a, double u) {
    const double t = 1 / a;
    const double target = std::log(u * gaussian_obstruction(a));
    constexpr double settled = 1e-9;  // the step that follows is about its square
    double q = -std::sqrt(-std::log(u));
    for (int step = 0; step < 60; ++step) {
        const double gauss = std::exp(-q * q) * inv_sqrtpi;
        const double cumulated = (std::erfc(-q) + t * gauss) / 2;
        const double slope = gauss * (1 - q * t);
        if (!(slope > 0)) break;
        const double change = (target - std::log(cumulated)) * cumulated / slope;
        q = std::min(q + change, a);
        if (!(change > settled)) break;
    }
    return q;
}

/// (x, y) of a facet along and across the azimuth of v, turned into the frame of the surface.
Vector3 turned(const Direction& v, double along, double across, double z) {
    return {along * v.cos_phi() - across * v.sin_phi(), along * v.sin_phi() + across * v.cos_phi(), z};
}

Vector3 unit(Vector3 v) {
    return 1 / std::sqrt(dot(v, v)) * v;
}

/// Away from 0, where quantiles are infinite; less than the step of 53-bit uniforms.
double above_zero(double u) {
    return std::max(u, 0x1p-54);
}

Vector3 visible_beckmann(const Direction& v, double alpha, double u0, double u1) {
    constexpr double at_horizon = 1e-150;  // whose tangent is still finite
    const double q = visible_gaussian_slope(std::max(scaled_cotangent(v, alpha), at_horizon), above_zero(u0));
    const double across = -boost::math::erfc_inv(2 * above_zero(u1));
    return unit(turned(v, -alpha * q, -alpha * across, 1));
}

/// Stretched until alpha is 1, facets are a hemisphere; v mirrored by its visible normals covers a cap of the
/// sphere uniformly [Dupuy23].
Vector3 visible_ggx(const Direction& v, double alpha, double u0, double u1) {
    const double stretched = std::sqrt(square(alpha * v.sin_theta()) + square(v.cos_theta()));
    const double sine = alpha * v.sin_theta() / stretched;
    const double cosine = v.cos_theta() / stretched;
    const double height = (1 - u0) * (1 + cosine);  // of the mirrored direction above the cap's rim
    const double z = height - cosine;
    const double radius = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    const double x = radius * std::cos(2 * pi * u1) + sine;
    return unit(turned(v, alpha * x, alpha * radius * std::sin(2 * pi * u1), height));
}

}  // namespace

FacetDistribution FacetDistribution::beckmann(double alpha, SmithForm form) {
    require_width(alpha);
    return {FacetShape::beckmann, alpha, 0, form};
}

FacetDistribution FacetDistribution::phong(double exponent, SmithForm form) {
    if (!(exponent >= 0 && exponent <= 1e12)) {
        throw out_of_range("Phong exponent", exponent, "", "from 0 to 1e+12");
    }
    return {FacetShape::phong, std::sqrt(2 / (exponent + 2)), exponent, form};
}

FacetDistribution FacetDistribution::ggx(double alpha) {
    require_width(alpha);
    return {FacetShape::ggx, alpha, 0, SmithForm::exact};
}

double FacetDistribution::density(Vector3 normal) const noexcept {
    constexpr double on_horizon = 1e-300;
    if (!(normal.z > on_horizon)) return 0;
    const double inverse = 1 / normal.z;
    const double tan_squared = square(normal.x * inverse) + square(normal.y * inverse);
    switch (shape_) {
        case FacetShape::beckmann:
            return beckmann_density(tan_squared, alpha_);
        case FacetShape::phong:
            return phong_density(tan_squared, exponent_);
        default:
            return ggx_density(tan_squared, alpha_);
    }
}

double FacetDistribution::shadowing_over_cosine(const Direction& v) const noexcept {
    if (shape_ == FacetShape::ggx) return ggx_visibility(v, alpha_);
    if (form_ == SmithForm::rational) {
        return rational_shadowing(scaled_cotangent(v, alpha_)) / v.cos_theta();
    }
    return shape_ == FacetShape::phong ? 1 / (phong_obstruction(v, exponent_) * v.cos_theta())
                                       : beckmann_visibility(v, alpha_);
}

FacetDistribution FacetDistribution::widened_for(const Direction& v) const noexcept {
    const double wider = (1.2 - 0.2 * std::sqrt(v.cos_theta())) * alpha_;
    return {shape_, wider, 2 / square(wider) - 2, form_};
}

/// The distribution whose visible normals are drawn; its G_1 is the one that makes
/// their density integrate to 1.
FacetDistribution FacetDistribution::with_visible_draw() const noexcept {
    const FacetShape shape = shape_ == FacetShape::phong ? FacetShape::ggx : shape_;
    return {shape, alpha_, 0, SmithForm::exact};
}

/// tan^2 of a normal drawn by (28), (31) or (35).
double FacetDistribution::tan_squared(double u) const noexcept {
    switch (shape_) {
        case FacetShape::beckmann:
            return -square(alpha_) * std::log1p(-u);
        case FacetShape::phong:
            return std::expm1(-2 / (exponent_ + 2) * std::log1p(-u));
        default:
            return square(alpha_) * u / (1 - u);
    }
}

Vector3 FacetDistribution::any_normal(double u0, double u1) const noexcept {
    const double tangent = std::sqrt(tan_squared(u0));
    return unit({tangent * std::cos(2 * pi * u1), tangent * std::sin(2 * pi * u1), 1});
}

Vector3 FacetDistribution::normal(const Direction& v, double u0, double u1, NormalDraw which) const noexcept {
    if (which == NormalDraw::all) return any_normal(u0, u1);
    if (which == NormalDraw::widened) return widened_for(v).any_normal(u0, u1);
    return shape_ == FacetShape::beckmann ? visible_beckmann(v, alpha_, u0, u1)
                                          : visible_ggx(v, alpha_, u0, u1);
}

double FacetDistribution::normal_pdf(const Direction& v, Vector3 m, NormalDraw which) const noexcept {
    if (which == NormalDraw::all) return density(m) * m.z;
    if (which == NormalDraw::widened) return widened_for(v).density(m) * m.z;
    const double seen = dot(v.vector(), m);
    if (!(seen > 0 && v.cos_theta() > 0)) return 0;
    const FacetDistribution drawn = with_visible_draw();
    return drawn.shadowing(v) * drawn.density(m) * seen / v.cos_theta();
}

}  // namespace hts
