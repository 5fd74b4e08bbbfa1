#include "hts/polarisation.hpp"

#include <cmath>

#include "hts/error.hpp"

namespace hts {
namespace {

using Complex = std::complex<double>;

/// p = s x k, the same expression for both rays.
Vector3 p_vector(const Direction& d) {
    return {-d.cos_theta() * d.cos_phi(), -d.cos_theta() * d.sin_phi(), d.sin_theta()};
}

/// Normal of the plane of both rays. Where they (nearly) coincide any normal will do, since the facet then
/// treats all planes alike to second order in the angle between them.
Vector3 s_of_facet(const Direction& in, const Direction& out) {
    const Vector3 normal = cross(out.vector(), in.vector());  // k_i x k_r
    const double length = std::hypot(normal.x, normal.y, normal.z);
    return length < 1e-8 ? s_vector_of_incident(in) : (1 / length) * normal;
}

}  // namespace

Stokes::Stokes(double s0, double s1, double s2, double s3) : components_{s0, s1, s2, s3} {
    if (!(s0 >= 0 && std::isfinite(s0))) throw out_of_range("Stokes parameter s0", s0, "", ">= 0 and finite");
    const double polarised = std::hypot(s1, s2, s3);
    if (!(polarised <= s0 * (1 + 1e-12))) {
        throw out_of_range("polarised intensity", polarised, "", "at most s0 = " + shortest(s0));
    }
}

Stokes Stokes::from_jones(const JonesVector& field) {
    const Complex cross_term = field.s * std::conj(field.p);
    const double s = std::norm(field.s);
    const double p = std::norm(field.p);
    if (!std::isfinite(s + p)) throw out_of_range("intensity of a Jones vector", s + p, "", "finite");
    return {Unchecked{}, {s + p, s - p, 2 * cross_term.real(), -2 * cross_term.imag()}};
}

double Stokes::degree_of_polarisation() const noexcept {
    const double polarised = std::hypot(components_[1], components_[2], components_[3]);
    return polarised > 0 ? std::fmin(1, polarised / components_[0]) : 0;
}

double Stokes::angle_of_polarisation() const noexcept {
    return std::atan2(components_[2], components_[1]) / 2;
}

Mueller Mueller::from_elements(const std::array<double, 16>& elements) noexcept {
    Mueller result;
    result.elements_ = elements;
    return result;
}

Mueller Mueller::depolariser(double reflectance) noexcept {
    Mueller result;
    result.elements_[0] = reflectance;
    return result;
}

Mueller Mueller::from_jones(const JonesMatrix& j) noexcept {
    const double ss = std::norm(j.ss);
    const double sp = std::norm(j.sp);
    const double ps = std::norm(j.ps);
    const double pp = std::norm(j.pp);
    const Complex columns_s = j.ss * std::conj(j.ps);  // s and p out of s in
    const Complex columns_p = j.sp * std::conj(j.pp);  // s and p out of p in
    const Complex rows_s = j.ss * std::conj(j.sp);
    const Complex rows_p = j.ps * std::conj(j.pp);
    const Complex straight = j.ss * std::conj(j.pp);
    const Complex crossed = j.sp * std::conj(j.ps);
    Mueller m;
    m.elements_ = {(ss + sp + ps + pp) / 2,
                   (ss - sp + ps - pp) / 2,
                   rows_s.real() + rows_p.real(),
                   rows_s.imag() + rows_p.imag(),
                   (ss + sp - ps - pp) / 2,
                   (ss - sp - ps + pp) / 2,
                   rows_s.real() - rows_p.real(),
                   rows_s.imag() - rows_p.imag(),
                   columns_s.real() + columns_p.real(),
                   columns_s.real() - columns_p.real(),
                   straight.real() + crossed.real(),
                   straight.imag() - crossed.imag(),
                   -columns_s.imag() - columns_p.imag(),
                   columns_p.imag() - columns_s.imag(),
                   -straight.imag() - crossed.imag(),
                   straight.real() - crossed.real()};
    return m;
}

Stokes Mueller::operator*(const Stokes& incident) const noexcept {
    std::array<double, 4> reflected{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column)
            reflected[row] += (*this)(row, column) * incident[column];
    }
    return {Stokes::Unchecked{}, reflected};
}

Vector3 s_vector_of_incident(const Direction& in) noexcept {
    return {-in.sin_phi(), in.cos_phi(), 0};
}

Vector3 s_vector_of_reflected(const Direction& out) noexcept {
    return -s_vector_of_incident(out);
}

JonesMatrix facet_jones(const Direction& in, const Direction& out,
                        const FresnelAmplitudes& amplitudes) noexcept {
    const auto& [f_s, f_p] = amplitudes;
    const Vector3 s_facet = s_of_facet(in, out);
    const double cos_in = dot(s_vector_of_incident(in), s_facet);
    const double sin_in = dot(p_vector(in), s_facet);
    const double cos_out = dot(s_vector_of_reflected(out), s_facet);
    const double sin_out = dot(p_vector(out), s_facet);
    return {cos_out * cos_in * f_s + sin_out * sin_in * f_p, cos_out * sin_in * f_s - sin_out * cos_in * f_p,
            sin_out * cos_in * f_s - cos_out * sin_in * f_p, sin_out * sin_in * f_s + cos_out * cos_in * f_p};
}

}  // namespace hts
