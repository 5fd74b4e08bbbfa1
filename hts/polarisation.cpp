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

/// Real part of a b*.
double real_product(const Complex& a, const Complex& b) {
    return a.real() * b.real() + a.imag() * b.imag();
}

/// Elements of the Mueller matrix, with one factor of each product from `a` and the conjugate one from `b`.
std::array<double, 16> elements_of(const JonesMatrix& a, const JonesMatrix& b) {
    const double ss = real_product(a.ss, b.ss);
    const double sp = real_product(a.sp, b.sp);
    const double ps = real_product(a.ps, b.ps);
    const double pp = real_product(a.pp, b.pp);
    const Complex columns_s = a.ss * std::conj(b.ps);  // s and p out of s in
    const Complex columns_p = a.sp * std::conj(b.pp);  // s and p out of p in
    const Complex rows_s = a.ss * std::conj(b.sp);
    const Complex rows_p = a.ps * std::conj(b.pp);
    const Complex straight = a.ss * std::conj(b.pp);
    const Complex crossed = a.sp * std::conj(b.ps);
    return {(ss + sp + ps + pp) / 2,
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
}

double square(double x) {
    return x * x;
}

/// Cosine and sine of alpha_i - alpha_r, the angles of the facet's plane to the frames of both rays; from
/// differences of the rays, so that backscatter keeps its digits.
struct FrameDifference {
    double cosine, sine;

    FrameDifference(const Direction& in, const Direction& out) {
        const double one_less_cos_phi =
            (square(in.cos_phi() - out.cos_phi()) + square(in.sin_phi() - out.sin_phi())) / 2;
        const double around = in.sin_theta() * out.sin_theta() * one_less_cos_phi;
        const double along =
            (square(in.sin_theta() - out.sin_theta()) + square(in.cos_theta() - out.cos_theta())) / 2;
        const double one_less_mu = around + along;
        if (!(one_less_mu > 0)) {
            cosine = 1, sine = 0;
            return;
        }
        cosine = (around - (1 - one_less_cos_phi) * along) / one_less_mu;
        sine = -sin_azimuth_between(in, out) * (in.cos_theta() - out.cos_theta()) / one_less_mu;
    }
};

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
    return from_elements(elements_of(j, j));
}

Mueller Mueller::from_jones_gradient(const JonesMatrix& jones, const JonesMatrix& by) noexcept {
    return from_elements(elements_of(jones, by)) + from_elements(elements_of(by, jones));
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

ByAngles<JonesMatrix> facet_jones_gradient(const Direction& in, const Direction& out,
                                           const JonesMatrix& jones,
                                           const FresnelGradient& amplitudes) noexcept {
    const double one_plus_mu = wave_vector_change(in, out).squared() / 2;
    if (one_plus_mu == 0) return {};
    const double sin_phi = sin_azimuth_between(in, out);
    const double vertical = in.cos_theta() + out.cos_theta();
    const FrameDifference difference{in, out};
    // (F_s - F_p)/2 times cosine and sine of alpha_i + alpha_r; (F_s + F_p)/2 over 1 - mu
    const Complex even = (jones.ss - jones.pp) / 2.0, odd = (jones.sp + jones.ps) / 2.0;
    const Complex scale = amplitudes.sum_over_sine_squared / 4.0;
    const auto turned = [&](double by_sum, double by_difference) -> JonesMatrix {
        const double sum = by_sum / one_plus_mu;
        const Complex across = scale * (by_difference * difference.sine);
        const Complex along = scale * (by_difference * difference.cosine);
        return {-sum * odd - across, sum * even + along, sum * even - along, sum * odd - across};
    };
    return {turned(-out.sin_theta() * sin_phi, out.sin_theta() * sin_phi),
            turned(-in.sin_theta() * sin_phi, -in.sin_theta() * sin_phi),
            turned(vertical, in.cos_theta() - out.cos_theta())};
}

}  // namespace hts
