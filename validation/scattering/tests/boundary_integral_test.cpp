#include "validation/scattering/boundary_integral.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/hankel.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "comparison.hpp"
#include "hts/fresnel.hpp"
#include "validation/scattering/hankel.hpp"
#include "validation/scattering/tapered_beam.hpp"

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

/// Under a plane wave that travels towards `in`; on a conductor if the index is 0.
PolarisedFields fields_of(const Contour& contour, double in, Complex index) {
    const std::vector<SurfaceField> wave{plane_wave(contour, in)};
    return index == 0.0 ? surface_fields(contour, k, wave) : surface_fields(contour, k, wave, index);
}

/// N of both polarisations into `out` under plane waves that travel towards `in`.
struct Amplitudes {
    Complex te, tm;
};
Amplitudes amplitudes(const Contour& contour, double in, double out, Complex index = 0) {
    const PolarisedFields fields = fields_of(contour, in, index);
    const FarField far{contour, k, std::vector<double>{out}};
    return {far.amplitudes(fields.te)[0][0], far.amplitudes(fields.tm)[0][0]};
}

/// H_m or J_m and its derivative.
template <class Function>
std::pair<Complex, Complex> with_slope(const Function& f, int m, double x) {
    const Complex value = f(m, x);
    return {value, m == 0 ? -f(1, x) : f(m - 1, x) - value * (m / x)};
}

/// N of a circular cylinder, a sum over cylinder waves: psi_s = -sum i^m c_m H_m(kr) exp(i m angle), far away
/// -(i/4) sqrt(2/(pi k r)) N. c_m = (eta J - J')/(eta H - H') with eta = n J'(n ka)/(rho J(n ka)), infinite
/// (TE) and 0 (TM) on a conductor, index 0.
Amplitudes of_a_circle(double radius, double angle, double index) {
    const double ka = k * radius;
    const auto hankel = [](int m, double x) { return boost::math::cyl_hankel_1(m, x); };
    const auto bessel = [](int m, double x) { return Complex{boost::math::cyl_bessel_j(m, x)}; };
    Complex te = 0, tm = 0;
    for (int m = 0; m < 3 * ka + 8; ++m) {
        const auto [h, dh] = with_slope(hankel, m, ka);
        const double j = h.real(), dj = dh.real();
        const double weight = (m == 0 ? 1 : 2) * std::cos(m * angle);
        if (index == 0) {
            te -= weight * j / h;
            tm -= weight * dj / dh;
            continue;
        }
        const auto [inner, slope] = with_slope(bessel, m, index * ka);
        const Complex eta = index * slope / inner, eta_tm = eta / (index * index);
        te -= weight * (eta * j - dj) / (eta * h - dh);
        tm -= weight * (eta_tm * j - dj) / (eta_tm * h - dh);
    }
    return {te * Complex{0, 4}, tm * Complex{0, 4}};
}

/// Relative rms difference from the series over all directions, of TE and TM.
std::pair<double, double> circle_error(double radius, double points_per_wavelength, double index = 0) {
    const Contour contour =
        circle(radius, 2 * static_cast<std::size_t>(std::lround(pi * radius * points_per_wavelength)));
    double off_te = 0, off_tm = 0, all_te = 0, all_tm = 0;
    const PolarisedFields fields = fields_of(contour, 0, index);
    std::vector<double> angles;
    for (int i = 0; i < 60; ++i) angles.push_back(i * pi / 30);
    const FarField far{contour, k, angles};
    const SurfaceField te = far.amplitudes(fields.te)[0], tm = far.amplitudes(fields.tm)[0];
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const Amplitudes exact = of_a_circle(radius, angles[i], index);
        off_te += std::norm(te[i] - exact.te);
        off_tm += std::norm(tm[i] - exact.tm);
        all_te += std::norm(exact.te);
        all_tm += std::norm(exact.tm);
    }
    return {std::sqrt(off_te / all_te), std::sqrt(off_tm / all_tm)};
}

/// Power that goes through the surface, per length across a plane wave.
double entering(const Contour& contour, const SurfaceFields& fields, std::size_t column = 0) {
    double sum = 0;
    for (std::size_t i = 0; i < contour.size(); ++i)
        sum -= std::imag(std::conj(fields.psi[column][i]) * fields.u[column][i]) * contour.step / k;
    return sum;
}

/// A plane piece, 24 wavelengths long.
Contour plate(int points_per_wavelength) {
    const std::size_t nodes = 24 * static_cast<std::size_t>(points_per_wavelength);
    const std::vector<double> zeros(nodes), ones(nodes, 1);
    Contour contour{1.0 / points_per_wavelength, {}, zeros, ones, zeros, zeros, zeros};
    for (std::size_t i = 0; i < nodes; ++i)
        contour.x.push_back(contour.step * (static_cast<double>(i) - static_cast<double>(nodes - 1) / 2));
    return contour;
}

struct FresnelReflectances {
    double te, tm;
};

/// Fresnel's reflectance averaged over the directions in a beam that is exp(-x^2/g^2) wide.
FresnelReflectances beam_average(double theta, double width, const hts::RefractiveIndex& index) {
    FresnelReflectances sum{0, 0};
    double weights = 0;
    for (double sine = -0.9995; sine < 1; sine += 0.001) {
        const double off = k * width * (sine - std::sin(theta)), cosine = std::sqrt(1 - sine * sine);
        const double weight = cosine * std::exp(-off * off / 2);
        const hts::FresnelAmplitudes amplitudes = hts::fresnel(cosine, index);
        sum.te += weight * std::norm(amplitudes.s);
        sum.tm += weight * std::norm(amplitudes.p);
        weights += weight;
    }
    return {sum.te / weights, sum.tm / weights};
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

TEST_CASE("Hankel functions of complex arguments are those of their integral over real exponents") {
    // H_nu(z) = (2/(pi i)) exp(-i nu pi/2) integral_0^inf exp(iz cosh t) cosh(nu t) dt [NIST (10.9.11)]
    WorstCase worst{"Hankel functions of complex arguments", accuracy::hankel};
    for (const double angle : {0.05, 0.4, pi / 4, 1.2, pi / 2}) {
        const Complex wave_number = std::polar(7.0, angle);
        const HankelTable table{30, wave_number};
        for (const double distance : {0.003, 0.1, 0.213, 0.2145, 0.4, 1.7, 9.0}) {
            const Complex z = wave_number * distance;
            Complex h0 = 0, h1 = 0;
            constexpr double step = 1e-3;
            for (double t = -13; t < 13; t += step) {
                const Complex wave = std::exp(Complex{0, 1} * z * std::cosh(t));
                h0 += step / pi * Complex{0, -1} * wave;
                h1 -= step / pi * std::cosh(t) * wave;
            }
            const Hankel found = table(distance);
            const auto where = [&] {
                return "angle " + std::to_string(angle) + ", |z| = " + std::to_string(std::abs(z));
            };
            worst.note(std::abs(found.order_0 - h0) / std::abs(h0), where);
            worst.note(std::abs(found.order_1 - h1) / std::abs(h1), where);
        }
    }
    worst.check();
    for (const double z : {0.01, 1.0, 4.0}) {
        CHECK(bessel(z).order_0.real() == Approx(boost::math::cyl_bessel_j(0, z)).epsilon(1e-13));
        CHECK(bessel(z).order_1.real() == Approx(boost::math::cyl_bessel_j(1, z)).epsilon(1e-13));
    }
}

TEST_CASE("moment method: a circular cylinder scatters like the series over cylinder waves") {
    for (const double radius : {0.3, 1.0, 2.04}) {
        const auto [te, tm] = circle_error(radius, 10);
        std::printf("circle of %.2f wavelengths, 10 points a wavelength: TE %.1e, TM %.1e\n", radius, te, tm);
        CHECK(te < 1e-4);
        CHECK(tm < 1e-4);
    }
}

TEST_CASE("moment method: a glass cylinder scatters like the series over cylinder waves") {
    for (const double index : {1.33, 1.5, 2.5}) {
        for (const double radius : {0.3, 1.0}) {
            const auto [te, tm] = circle_error(radius, 10 * index, index);
            std::printf(
                "glass circle of %.2f wavelengths, n = %.2f, 10 points a wavelength in it: TE %.1e, TM "
                "%.1e\n",
                radius, index, te, tm);
            CHECK(te < 4e-4);
            CHECK(tm < 4e-4);
        }
    }
}

TEST_CASE("moment method: with a greater and greater complex index a ground becomes a conductor") {
    double te[2], tm[2];
    for (int i = 0; i < 2; ++i) {
        const double size = i == 0 ? 4 : 8;
        const Contour contour = circle(0.3, i == 0 ? 110 : 220);
        const Amplitudes ground = amplitudes(contour, 0, 1, {size, size}),
                         conductor = amplitudes(contour, 0, 1);
        te[i] = std::abs(ground.te - conductor.te) / std::abs(conductor.te);
        tm[i] = std::abs(ground.tm - conductor.tm) / std::abs(conductor.tm);
        std::printf("index %.0f (1 + i) against a conductor: TE %.4f, TM %.4f\n", size, te[i], tm[i]);
        CHECK(te[i] < 2 / size);
        CHECK(tm[i] < 2 / size);
    }
    CHECK(te[0] / te[1] == Approx(2).epsilon(0.1));
    CHECK(tm[0] / tm[1] == Approx(2).epsilon(0.1));
}

TEST_CASE("moment method: glass and absorbing bodies scatter reciprocally and obey the optical theorem") {
    const Contour contour = kite(240);
    for (const Complex index : {Complex{1.5, 0}, Complex{1.4, 0.3}}) {
        const Amplitudes there = amplitudes(contour, 0.3, 2.0, index),
                         back = amplitudes(contour, 2.0 + pi, 0.3 + pi, index);
        CHECK(std::abs(there.te - back.te) < 1e-4 * std::abs(there.te));
        CHECK(std::abs(there.tm - back.tm) < 1e-4 * std::abs(there.tm));
        const PolarisedFields fields = fields_of(contour, 0.3, index);
        std::vector<double> angles;
        for (int i = 0; i < 200; ++i) angles.push_back(0.3 + i * pi / 100);
        const FarField far{contour, k, angles};
        for (const SurfaceFields& one : {fields.te, fields.tm}) {
            const SurfaceField amplitude = far.amplitudes(one)[0];
            const double absorbed = entering(contour, one);
            double scattered = 0;
            for (const Complex value : amplitude) scattered += std::norm(value) * (pi / 100) / (8 * pi * k);
            CHECK(scattered + absorbed == Approx(-amplitude[0].imag() / k).epsilon(1e-4));
            if (index.imag() == 0) CHECK(std::fabs(absorbed) < 1e-4 * scattered);
            if (index.imag() > 0) CHECK(absorbed > 0.2 * scattered);
        }
    }
}

TEST_CASE("moment method: a plane interface reflects what Fresnel's equations say, and loses nothing") {
    const double width = 6;
    const Contour contour = plate(12);
    std::vector<double> up, down;
    for (int i = 0; i < 180; ++i) {
        up.push_back((i + 0.5) * pi / 180 - pi / 2);
        down.push_back(up.back() + pi);
    }
    std::vector<TaperedBeam> beams;
    std::vector<SurfaceField> incident;
    std::vector<double> angles;
    for (const double degrees : {0, 20, 40, 60}) {
        angles.push_back(degrees * pi / 180);
        beams.emplace_back(angles.back(), width, k);
        incident.emplace_back();
        for (const double x : contour.x) incident.back().push_back(beams.back().field(x, 0));
    }
    for (const Complex index : {Complex{1.5, 0}, Complex{1.2, 1.1}}) {
        WorstCase worst{"reflectance of a plane interface against Fresnel's, averaged over the beam", 2e-3};
        const PolarisedFields fields = surface_fields(contour, k, incident, index);
        const FarField above{contour, k, up}, below{contour, k * index.real(), down};
        const auto power = [&](const FarField& far, const SurfaceFields& radiating, std::size_t beam) {
            double sum = 0;
            const auto amplitudes = far.amplitudes(radiating);
            for (const Complex value : amplitudes[beam]) sum += std::norm(value) / 180 / (8 * k);
            return sum / beams[beam].power();
        };
        for (std::size_t beam = 0; beam < beams.size(); ++beam) {
            const FresnelReflectances fresnel =
                beam_average(angles[beam], width, {index.real(), index.imag()});
            const auto check = [&](SurfaceFields one, double expected, Complex rho, const char* name) {
                const double reflected = power(above, one, beam),
                             transmitted = entering(contour, one, beam) / beams[beam].power();
                worst.note(std::fabs(reflected - expected),
                           [&] { return name + (" at " + std::to_string(angles[beam])); });
                CHECK(reflected + transmitted == Approx(1).epsilon(2e-3));
                if (index.imag() > 0) return;
                for (Complex& slope : one.u[beam]) slope *= rho;  // in the ground
                CHECK(power(below, one, beam) / rho.real() == Approx(transmitted).epsilon(1e-3));
            };
            check(fields.te, fresnel.te, 1, "TE");
            check(fields.tm, fresnel.tm, index * index, "TM");
        }
        worst.check();
    }
}

TEST_CASE("moment method: the error falls with the seventh power of the step") {
    const auto coarse = circle_error(1, 8), fine = circle_error(1, 16);
    std::printf("circle, 8 to 16 points a wavelength: TE %.1e to %.1e, TM %.1e to %.1e\n", coarse.first,
                fine.first, coarse.second, fine.second);
    CHECK(coarse.first / fine.first > 100);
    CHECK(coarse.second / fine.second > 100);
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
    const PolarisedFields fields =
        surface_fields(contour, k, std::vector<SurfaceField>{plane_wave(contour, in)});
    std::vector<double> angles;
    for (int i = 0; i < 200; ++i) angles.push_back(in + i * pi / 100);
    const FarField far{contour, k, angles};
    const SurfaceField te = far.amplitudes(fields.te)[0], tm = far.amplitudes(fields.tm)[0];
    double all_te = 0, all_tm = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        all_te += std::norm(te[i]) * (pi / 100) / (8 * pi * k);
        all_tm += std::norm(tm[i]) * (pi / 100) / (8 * pi * k);
    }
    CHECK(all_te == Approx(-te[0].imag() / k).epsilon(1e-5));
    CHECK(all_tm == Approx(-tm[0].imag() / k).epsilon(1e-4));
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
