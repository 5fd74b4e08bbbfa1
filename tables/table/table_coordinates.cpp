#include "tables/table/table_coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace hts::tables {
namespace {

const double lowest_cosine = std::cos(steepest_theta), highest_sine = std::sin(steepest_theta);

// To 1e-16 absolute, which is all that a coordinate needs; a logarithm instead of the library's call.
double inverse_sinh(double x) {
    return std::log(x + std::sqrt(1 + x * x));
}

struct Polar {
    double cosine, sine;
};

Polar up_to_steepest(const Direction& direction) {
    if (direction.cos_theta() < lowest_cosine) return {lowest_cosine, highest_sine};
    return {direction.cos_theta(), direction.sin_theta()};
}

Polar polar(double tangent) {
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    return {cosine, tangent * cosine};
}

double reach(const Polar& a, const Polar& b) {
    return 2 * std::sqrt(a.sine * b.sine) / (a.cosine + b.cosine);
}

constexpr double smallest_reach = 1e-6;  // below it turn is c itself, to 1e-12

double turn_from(double c, double scaled_reach) {
    if (scaled_reach < smallest_reach) return c;
    return std::min(1.0, inverse_sinh(scaled_reach * c) / inverse_sinh(scaled_reach));
}

double half_azimuth_cosine(double turn, double scaled_reach) {
    if (scaled_reach < smallest_reach) return turn;
    return std::min(1.0, std::sinh(turn * inverse_sinh(scaled_reach)) / scaled_reach);
}

}  // namespace

CoordinateMap::CoordinateMap(const TableSpacing& spacing) noexcept
    : spacing_{spacing}, steepest_{inverse_sinh(spacing.grazing * highest_sine / lowest_cosine)} {}

double CoordinateMap::grazing(const Direction& direction) const noexcept {
    const Polar p = up_to_steepest(direction);
    return std::min(1.0, inverse_sinh(spacing_.grazing * p.sine / p.cosine) / steepest_);
}

Coordinates CoordinateMap::operator()(const DirectionPair& pair) const noexcept {
    const double in = grazing(pair.in), out = grazing(pair.out);
    const double nearer = std::max(in, out), other = std::min(in, out);
    const double x = pair.in.cos_phi() + pair.out.cos_phi(), y = pair.in.sin_phi() + pair.out.sin_phi();
    const double c = std::min(1.0, std::sqrt(x * x + y * y) / 2);
    const double h = reach(up_to_steepest(pair.in), up_to_steepest(pair.out));
    return {nearer, nearer > 0 ? other / nearer : 1, turn_from(c, spacing_.turn * h)};
}

Direction CoordinateMap::direction(double grazing) const noexcept {
    const Polar p = polar(std::sinh(grazing * steepest_) / spacing_.grazing);
    return Direction::from_unit_vector({p.sine, 0, p.cosine});
}

DirectionPair CoordinateMap::pair(const Coordinates& coordinates) const noexcept {
    const auto [grazing, ratio, turn] = coordinates;
    const Direction a = direction(grazing);
    const Polar b = polar(std::sinh(grazing * ratio * steepest_) / spacing_.grazing);
    const double h = reach({a.cos_theta(), a.sin_theta()}, b);
    const double c = half_azimuth_cosine(turn, spacing_.turn * h);
    const double cos_phi = 2 * c * c - 1, sin_phi = 2 * c * std::sqrt((1 - c) * (1 + c));
    return {a, Direction::from_unit_vector({b.sine * cos_phi, b.sine * sin_phi, b.cosine})};
}

}  // namespace hts::tables
