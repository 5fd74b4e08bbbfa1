#include "tables/formats/lobe_quadrature.hpp"

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

std::vector<WeightedView> lobe_quadrature(const Direction& in, double slope, int count) {
    const FacetDraws facets{slope};
    std::vector<WeightedView> views;
    const auto add = [&](Vector3 out) {
        if (!(out.z > 0)) return;
        const Direction view = Direction::from_unit_vector(out);
        views.push_back({view, 1 / (count * (facets.density({in, view}) + view.cos_theta() / pi))});
    };
    for (int i = 0; i < count; ++i) {
        const double u1 = (i + 0.5) / count, u2 = radical_inverse(static_cast<unsigned>(i));
        add(facets.draw(in, u1, u2));
        add(cosine_draw(u1, u2));
    }
    return views;
}

}  // namespace hts::tables
