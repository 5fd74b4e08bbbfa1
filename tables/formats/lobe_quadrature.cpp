#include "tables/formats/lobe_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tables/formats/lobe.hpp"

namespace hts::tables {
namespace {

constexpr double pi = std::numbers::pi;

/// The i-th of van der Corput's numbers in base 2.
double radical_inverse(unsigned i) {
    double value = 0;
    for (double digit = 0.5; i != 0; i >>= 1, digit /= 2)
        if ((i & 1) != 0) value += digit;
    return value;
}

Vector3 cosine_draw(double u1, double u2) {
    const double radius = std::sqrt(u1);
    return {radius * std::cos(2 * pi * u2), radius * std::sin(2 * pi * u2), std::sqrt(1 - u1)};
}

}  // namespace

FacetDraws::FacetDraws(double slope) noexcept : alpha_squared_{slope * slope / std::numbers::ln2} {}

Vector3 FacetDraws::draw(const Direction& in, double u1, double u2) const noexcept {
    const double radius = std::sqrt(-alpha_squared_ * std::log1p(-u1));
    return mirrored(in, facet_normal(radius * std::cos(2 * pi * u2), radius * std::sin(2 * pi * u2)));
}

double FacetDraws::density(const DirectionPair& pair) const noexcept {
    const Vector3 m = bisector(pair);
    const double cosine = dot(pair.in.vector(), m);
    if (!(m.z > 0 && cosine > 0)) return 0;
    const double squared = (1 - m.z) * (1 + m.z) / (m.z * m.z);
    return std::exp(-squared / alpha_squared_) / (pi * alpha_squared_ * m.z * m.z * m.z * 4 * cosine);
}

SpecularCone::SpecularCone(double solid_angle) noexcept
    : squared_sine_{std::min(5 * solid_angle / (4 * pi), 1.0)} {}

Vector3 SpecularCone::draw(const Direction& in, double u1, double u2) const noexcept {
    const Direction mirror = in.mirror();
    const double h = u1 * squared_sine_, radius = 2 * std::sqrt(h * (1 - h));
    const Vector3 across{-mirror.sin_phi(), mirror.cos_phi(), 0};
    return (1 - 2 * h) * mirror.vector() +
           radius * (std::cos(2 * pi * u2) * across + std::sin(2 * pi * u2) * cross(mirror.vector(), across));
}

double SpecularCone::density(const DirectionPair& pair) const noexcept {
    const Vector3 apart = pair.out.vector() - pair.in.mirror().vector();
    return dot(apart, apart) / 4 <= squared_sine_ ? 1 / (4 * pi * squared_sine_) : 0;
}

std::vector<WeightedView> lobe_quadrature(const Direction& in, double slope, int count,
                                          double specular_solid_angle) {
    const FacetDraws facets{slope};
    const bool with_cone = specular_solid_angle > 0;
    const SpecularCone cone{with_cone ? specular_solid_angle : 1};
    std::vector<WeightedView> views;
    const auto add = [&](Vector3 out) {
        if (!(out.z > 0)) return;
        const Direction view = Direction::from_unit_vector(out);
        const double density =
            facets.density({in, view}) + view.cos_theta() / pi + (with_cone ? cone.density({in, view}) : 0);
        views.push_back({view, 1 / (count * density)});
    };
    for (int i = 0; i < count; ++i) {
        const double u1 = (i + 0.5) / count, u2 = radical_inverse(static_cast<unsigned>(i));
        add(facets.draw(in, u1, u2));
        add(cosine_draw(u1, u2));
        if (with_cone) add(cone.draw(in, u1, u2));
    }
    return views;
}

}  // namespace hts::tables
