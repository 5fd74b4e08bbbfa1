#include "hts/microfacet/normals/gaussian_slopes.hpp"

#include <cmath>

#include "hts/error.hpp"

namespace hts {
namespace {

// Where exp(-power) is 0.
constexpr double beyond_range = 750;

double checked_width(const char* quantity, double value) {
    if (!(value >= 1e-6 && value <= 1e3)) throw out_of_range(quantity, value, "", "from 1e-06 to 1000");
    return value;
}

}  // namespace

GaussianSlopes::GaussianSlopes(double mx, double my)
    : mx_{checked_width("slope width mx", mx)}, my_{checked_width("slope width my", my)} {}

double GaussianSlopes::shape(const HalfDirection& half) const noexcept {
    const double x = half.slope_x / mx_;
    const double y = half.slope_y / my_;
    const double power = x * x + y * y;
    return power < beyond_range ? std::exp(-power) : 0;
}

double GaussianSlopes::density(const HalfDirection& half) const noexcept {
    const double q = shape(half);
    if (q == 0) return 0;
    const double squared_cosine = half.normal.z * half.normal.z;
    return q / (std::numbers::pi * mx_ * my_ * squared_cosine * squared_cosine);
}

double GaussianSlopes::outgoing_pdf(const HalfDirection& half) const noexcept {
    return density(half) * half.normal.z / (4 * half.cos_theta_d);
}

Vector3 GaussianSlopes::normal(double u1, double u2) const noexcept {
    const double radius = std::sqrt(-std::log1p(-u1));
    const double psi = 2 * std::numbers::pi * u2;
    const double x = radius * mx_ * std::cos(psi);
    const double y = radius * my_ * std::sin(psi);
    const double cosine = 1 / std::hypot(x, y, 1);
    return {x * cosine, y * cosine, cosine};
}

double SlopeLobe::pdf(const Direction& in, const Direction& out) const noexcept {
    return slopes_.outgoing_pdf(half_direction(in, out));
}

Vector3 SlopeLobe::draw(const Direction& in, double u1, double u2) const noexcept {
    return mirrored(in, slopes_.normal(u1, u2));
}

}  // namespace hts
