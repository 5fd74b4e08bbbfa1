#include "validation/boundary_integral.hpp"

#include <boost/math/special_functions/hankel.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "comparison.hpp"
#include "validation/hankel.hpp"
#include "validation/tapered_beam.hpp"

using hts::testing::Random;
using hts::testing::WorstCase;
using namespace hts::validation;
using Complex = std::complex<double>;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double k = 2 * pi;

/// A closed curve x(t), z(t) run through clockwise, so that the field is to its left.
template <class X, class Z>
Contour closed_curve(std::size_t nodes, const X& x, const Z& z) {
    Contour contour;
    contour.step = 2 * pi / static_cast<double>(nodes);
    contour.closed = true;
    const auto difference = [](const auto& f, double t,
                               int order) {  // derivatives with respect to -t, of order 1 or 2
        constexpr double h = 1e-4;
        if (order == 1) return -(8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
        return (f(t + h) - 2 * f(t) + f(t - h)) / (h * h);
    };
    for (std::size_t i = 0; i < nodes; ++i) {
        const double t = -static_cast<double>(i) * contour.step;
        contour.x.push_back(x(t));
        contour.z.push_back(z(t));
        contour.dx.push_back(difference(x, t, 1));
        contour.dz.push_back(difference(z, t, 1));
        contour.ddx.push_back(difference(x, t, 2));
        contour.ddz.push_back(difference(z, t, 2));
    }
    return contour;
}

Contour circle(double radius, std::size_t nodes) {
    return closed_curve(
        nodes, [=](double t) { return radius * std::cos(t); },
        [=](double t) { return radius * std::sin(t); });
}

/// The kite of Colton and Kress, which is not convex.
Contour kite(std::size_t nodes) {
    return closed_curve(
        nodes, [](double t) { return std::cos(t) + 0.65 * std::cos(2 * t) - 0.65; },
        [](double t) { return 1.5 * std::sin(t); });
}

/// exp(i k (x sin theta + z cos theta)) at the nodes: a wave that travels towards theta.
SurfaceField plane_wave(const Contour& contour, double theta) {
    SurfaceField field;
    for (std::size_t i = 0; i < contour.size(); ++i)
        field.push_back(
            std::polar(1.0, k * (contour.x[i] * std::sin(theta) + contour.z[i] * std::cos(theta))));
    return field;
}

/// N of both polarisations into `out` under plane waves that travel towards `in`.
struct Amplitudes {
    Complex te, tm;
};
Amplitudes amplitudes(const Contour& contour, double in, double out) {
    const SurfaceFields fields =
        surface_fields(contour, k, std::vector<SurfaceField>{plane_wave(contour, in)});
    const FarField far{contour, k, std::vector<double>{out}};
    return {far.te(fields.te)[0][0], far.tm(fields.tm)[0][0]};
}

/// Of a circular cylinder, sums over cylinder waves: psi_s = -sum i^m c_m H_m(kr) exp(i m angle), c_m = J_m/H_m for TE
/// and J_m'/H_m' for TM; far away psi_s = -+(i/4) sqrt(2/(pi k r)) N.
Amplitudes of_a_circle(double radius, double angle) {
    const double ka = k * radius;
    Complex te = 0, tm = 0;
    const auto h = [ka](int m) { return boost::math::cyl_hankel_1(m, ka); };
    for (int m = 0; m < 3 * ka; ++m) {
        const Complex slope = m == 0 ? -h(1) : h(m - 1) - h(m) * (m / ka);
        const double weight = (m == 0 ? 1 : 2) * std::cos(m * angle);
        te -= weight * h(m).real() / h(m);
        tm -= weight * slope.real() / slope;
    }
    return {te * Complex{0, 4}, tm * Complex{0, -4}};
}

/// Relative rms difference from the series over all directions, of TE and TM.
std::pair<double, double> circle_error(double radius, double points_per_wavelength) {
    const Contour contour =
        circle(radius, 2 * static_cast<std::size_t>(std::lround(pi * radius * points_per_wavelength)));
    const SurfaceFields fields =
        surface_fields(contour, k, std::vector<SurfaceField>{plane_wave(contour, 0)});
    std::vector<double> angles;
    for (int i = 0; i < 60; ++i) angles.push_back(i * pi / 30);
    const FarField far{contour, k, angles};
    const SurfaceField te = far.te(fields.te)[0], tm = far.tm(fields.tm)[0];
    double off_te = 0, off_tm = 0, all_te = 0, all_tm = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const Amplitudes exact = of_a_circle(radius, angles[i]);
        off_te += std::norm(te[i] - exact.te);
        off_tm += std::norm(tm[i] - exact.tm);
        all_te += std::norm(exact.te);
        all_tm += std::norm(exact.tm);
    }
    return {std::sqrt(off_te / all_te), std::sqrt(off_tm / all_tm)};
}

}  // namespace

TEST_CASE("Hankel functions from the table are those of Boost.Math") {
    const HankelTable table{600};
    Random random{7};
    WorstCase worst{"Hankel functions", accuracy::hankel};
    for (int i = 0; i < 4000; ++i) {
        const double z = random.logarithmic(1e-3, 600);
        const Hankel found = table(z);
        const auto where = [z] { return "z = " + std::to_string(z); };
        const Complex h0 = boost::math::cyl_hankel_1(0, z), h1 = boost::math::cyl_hankel_1(1, z);
        worst.note(std::abs(found.order_0 - h0) / std::abs(h0), where);
        worst.note(std::abs(found.order_1 - h1) / std::abs(h1), where);
    }
    worst.check();
}

TEST_CASE("moment method: a circular cylinder scatters like the series over cylinder waves") {
    for (const double radius : {0.3, 1.0, 2.04}) {
        const auto [te, tm] = circle_error(radius, 10);
        std::printf("circle of %.2f wavelengths, 10 points a wavelength: TE %.1e, TM %.1e\n", radius, te, tm);
        CHECK(te < 1e-4);
        CHECK(tm < 1e-4);
    }
}

TEST_CASE("moment method: the error falls with the seventh power of the step") {
    const auto coarse = circle_error(1, 8), fine = circle_error(1, 16);
    std::printf("circle, 8 to 16 points a wavelength: TE %.1e to %.1e, TM %.1e to %.1e\n", coarse.first,
                fine.first, coarse.second, fine.second);
    CHECK(coarse.first / fine.first > 64);
    CHECK(coarse.second / fine.second > 64);
}

TEST_CASE("moment method: a kite scatters reciprocally and obeys the optical theorem") {
    const Contour contour = kite(200);
    for (const auto& [in, out] : {std::pair{0.3, 2.0}, {1.1, -0.7}, {2.5, 2.5}}) {
        const Amplitudes there = amplitudes(contour, in, out), back = amplitudes(contour, out + pi, in + pi);
        CHECK(std::abs(there.te - back.te) < 1e-5 * std::abs(there.te));
        CHECK(std::abs(there.tm - back.tm) < 1e-4 * std::abs(there.tm));
    }
    // what is scattered in all, integral |N|^2/(8 pi k), is what the forward wave loses
    const double in = 0.3;
    const SurfaceFields fields =
        surface_fields(contour, k, std::vector<SurfaceField>{plane_wave(contour, in)});
    std::vector<double> angles;
    for (int i = 0; i < 200; ++i) angles.push_back(in + i * pi / 100);
    const FarField far{contour, k, angles};
    const SurfaceField te = far.te(fields.te)[0], tm = far.tm(fields.tm)[0];
    double all_te = 0, all_tm = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        all_te += std::norm(te[i]) * (pi / 100) / (8 * pi * k);
        all_tm += std::norm(tm[i]) * (pi / 100) / (8 * pi * k);
    }
    CHECK(all_te == Approx(-te[0].imag() / k).epsilon(1e-5));
    CHECK(all_tm == Approx(tm[0].imag() / k).epsilon(1e-4));
}

TEST_CASE("a tapered beam is a solution nearly, its derivative is one, and it carries its power") {
    const TaperedBeam beam{1.0, 12.5, k};
    const double x = 3.1, z = -0.4, h = 1e-3;
    const auto field = [&](double dx, double dz) { return beam.field(x + dx, z + dz); };
    const Complex by_x = (field(h, 0) - field(-h, 0)) / (2 * h),
                  by_z = (field(0, h) - field(0, -h)) / (2 * h);
    CHECK(std::abs(beam.derivative(x, z, 1, 0) - by_x) < 1e-4);
    CHECK(std::abs(beam.derivative(x, z, 0, 1) - by_z) < 1e-4);
    const Complex laplace =
        (field(h, 0) + field(-h, 0) + field(0, h) + field(0, -h) - 4.0 * field(0, 0)) / (h * h);
    const double divergence = k * 12.5 * std::cos(1.0);
    CHECK(std::abs(laplace + k * k * field(0, 0)) < 4 * k * k / (divergence * divergence));
    // flux through z = 0, Im(psi* dpsi/dz)/k downwards
    double flux = 0;
    for (double at = -60; at < 60; at += 0.05)
        flux -= 0.05 * std::imag(std::conj(beam.field(at, 0)) * beam.derivative(at, 0, 0, 1)) / k;
    CHECK(flux == Approx(beam.power()).epsilon(1e-3));
}
