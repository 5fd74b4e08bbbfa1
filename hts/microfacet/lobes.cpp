#include "hts/microfacet/lobes.hpp"

#include <algorithm>
#include <cmath>

#include "hts/error.hpp"

namespace hts {

HalfDirection half_direction(const Direction& in, const Direction& out) noexcept {
    const Vector3 sum = in.vector() + out.vector();
    const double length = std::sqrt(dot(sum, sum));
    const double flat = 1 / sum.z;
    return {1 / length * sum, flat * sum.x, flat * sum.y, std::min(1.0, length / 2)};
}

Vector3 mirrored(const Direction& in, Vector3 normal) noexcept {
    return 2 * dot(in.vector(), normal) * normal - in.vector();
}

double schlick_strength(double f0, const Direction& in) noexcept {
    return std::max(0.05, schlick(f0, in.cos_theta()));
}

Vector3 cosine_power_vector(double base, double exponent, double cos_phi, double sin_phi) noexcept {
    const double logarithm = std::log(base) / (exponent + 1);
    const double sine = std::sqrt(-std::expm1(2 * logarithm));
    return {sine * cos_phi, sine * sin_phi, std::exp(logarithm)};
}

Vector3 cosine_vector(double u1, double u2) noexcept {
    const double phi = 2 * std::numbers::pi * u2;
    return cosine_power_vector(1 - u1, 1, std::cos(phi), std::sin(phi));
}

double checked_reflectance(const char* quantity, double value) {
    if (!(value >= 0 && value <= 1)) throw out_of_range(quantity, value, "", "from 0 to 1");
    return value;
}

double checked_reflectivity(const char* quantity, double value) {
    if (!(value >= 0 && value <= 1e6)) throw out_of_range(quantity, value, "", "from 0 to 1e+06");
    return value;
}

double checked_exponent(const char* quantity, double value) {
    if (!(value >= 0 && value <= 1e8)) throw out_of_range(quantity, value, "", "from 0 to 1e+08");
    return value;
}

}  // namespace hts
