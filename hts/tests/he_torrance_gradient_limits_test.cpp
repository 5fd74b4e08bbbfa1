// Symmetries and limits of the derivatives; their reference values are in he_torrance_gradient_test.cpp.

#include <cmath>
#include <numbers>
#include <utility>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "gradient_points.hpp"
#include "hts/he_torrance_gradient.hpp"

using hts::Direction;
using hts::Mueller;
using hts::PairGradient;
using hts::RefractiveIndex;
using hts::Surface;
using hts::view_gradient;
using hts::Wavelength;
using hts::testing::parameters;
using hts::testing::Point;
using hts::testing::Random;
using hts::testing::random_point;

TEST_CASE("the gradient is reciprocal") {
    Random random{63};
    for (int i = 0; i < 2000; ++i) {
        const Point p = random_point(random);
        const auto there =
            hts::directional_diffuse_gradient({p.surface(), p.in(), p.out()}, p.lambda(), p.index());
        const auto back =
            hts::directional_diffuse_gradient({p.surface(), p.out(), p.in()}, p.lambda(), p.index());
        const auto same = [&](double a, double b) {
            CHECK(a == Approx(b).epsilon(1e-9).margin(1e-9 * there.value));
        };
        same(there.value, back.value);
        same(there.by.rms_roughness, back.by.rms_roughness);
        same(there.by.correlation_length, back.by.correlation_length);
        same(there.by.n, back.by.n);
        same(there.by.k, back.by.k);
        same(there.by.theta_i, back.by.theta_r);
        same(there.by.theta_r, back.by.theta_i);
        same(there.by.phi, -back.by.phi);
    }
}

TEST_CASE("lengths in another unit give the same BRDF") {
    // f(c sigma_0, c tau, c lambda) = f, so that sigma_0 f_sigma0 + tau f_tau = -lambda f_lambda
    Random random{64};
    for (int i = 0; i < 1000; ++i) {
        const Point p = random_point(random);
        const auto f = p.gradient();
        if (f.value < 1e-30) continue;
        const double by_wavelength =
            difference(p, &Point::wavelength, 1e-3 * p.wavelength, [](const Point& q) { return q.brdf(); });
        const double by_lengths =
            p.rms_roughness * f.by.rms_roughness + p.correlation_length * f.by.correlation_length;
        CHECK(by_lengths == Approx(-p.wavelength * by_wavelength).epsilon(1e-5).margin(1e-5 * f.value));
    }
}

TEST_CASE("in the plane of incidence no derivative by phi is left but of what changes sign there") {
    Random random{65};
    for (int i = 0; i < 500; ++i) {
        const Point p = random_point(random);
        const double azimuth = random.one_of({0, 90, 137});
        const Direction in = Direction::from_degrees(random.uniform(0, 89), azimuth);
        const Direction forward = Direction::from_degrees(random.uniform(0, 89), azimuth).mirror();
        for (const Direction& out : {forward, forward.mirror(), in, in.mirror()}) {
            const PairGradient pair{p.surface(), in, out};
            CHECK(hts::directional_diffuse_gradient(pair, p.lambda(), p.index()).by.phi == 0);
            const auto m = hts::directional_diffuse_mueller_gradient(pair, p.lambda(), p.index());
            for (std::size_t e = 0; e < 16; ++e) {
                const bool changes_sign = (e / 4 < 2) != (e % 4 < 2);
                const Mueller& zero_here = changes_sign ? m.by.theta_i : m.by.phi;
                CHECK(std::abs(zero_here.elements()[e]) <=
                      1e-14 * (m.value(0, 0) + std::abs(zero_here(0, 0))));
            }
        }
    }
}

TEST_CASE("backscatter and the normal are limits of the Mueller matrix's derivatives too") {
    Point p{0.1, 0.8, 0.2, 3.4, 0.7, 0.7, 0, 0.5};
    for (const double theta : {0.0, 1e-9, 0.7, 1.5}) {
        p.theta_i = p.theta_r = theta;
        const auto exact = p.mueller_gradient();
        for (const double offset : {1e-5, 1e-7, 1e-8, 1e-9, 1e-12, 1e-15}) {
            Point near = p;
            near.theta_r = theta + offset;
            near.phi = offset;
            const auto m = near.mueller_gradient();
            for (const auto& by : parameters<Mueller>()) {
                const Mueller &a = m.by.*by.of_gradient, &b = exact.by.*by.of_gradient;
                const double scale = exact.value(0, 0) + std::abs(b(0, 0));
                for (std::size_t e = 0; e < 16; ++e) {
                    INFO(by.name << ", theta " << theta << ", offset " << offset << ", element " << e);
                    CHECK(std::abs(a.elements()[e] - b.elements()[e]) <= (1e3 * offset + 1e-12) * scale);
                }
            }
        }
    }
}

TEST_CASE("a mirror: no lobe, Fresnel's derivatives alone") {
    const Surface mirror{0, 2};
    const auto wavelength = Wavelength::from_micrometres(0.5);
    const RefractiveIndex index{1.5, 0};
    for (const double theta : {0.0, 40.0, 89.0, 90.0}) {
        const Direction in = Direction::from_degrees(theta, 0);
        const PairGradient pair{mirror, in, in.mirror()};
        const auto f = hts::brdf_gradient(pair, wavelength, index, 0.1);
        CHECK(f.value == 0.1);
        CHECK(f.by.rms_roughness == 0);
        CHECK(f.by.theta_i == 0);
        CHECK(f.by.diffuse_albedo == std::numbers::inv_pi);
        const auto s =
            hts::specular_reflectance_gradient(mirror, view_gradient(mirror, in), wavelength, index);
        const auto amplitudes = hts::fresnel_gradient(in.cos_theta(), index);
        CHECK(s.value.value() == amplitudes.value.unpolarised_reflectance());
        CHECK(s.by.rms_roughness == 0);
        CHECK(s.by.correlation_length == 0);
        CHECK(s.by.n == amplitudes.unpolarised_reflectance(amplitudes.by_n));
        CHECK(s.by.k == 0);
        CHECK(s.by.theta_i >= 0);
        CHECK(s.by.phi == 0);
    }
    // and the limit of little roughness is as sigma_0^2
    const Point p{1e-9, 1, 1.5, 0.2, 0.5, 0.6, 2, 0.5};
    CHECK(p.rms_roughness * p.gradient().by.rms_roughness == Approx(2 * p.brdf()).epsilon(1e-9));
}

TEST_CASE("the horizon has no derivatives, its neighbourhood has") {
    const Surface rough{0.28, 1.77};
    const auto wavelength = Wavelength::from_micrometres(0.5);
    const Direction light = Direction::from_degrees(80, 0), horizon = Direction::from_degrees(90, 180);
    for (const auto& [in, out] : {std::pair{light, horizon}, {horizon, light}, {horizon, horizon.mirror()}}) {
        const auto f = hts::directional_diffuse_gradient({rough, in, out}, wavelength, {0.8, 6});
        CHECK(f.value == 0);
        CHECK(f.by.theta_i == 0);
        CHECK(f.by.theta_r == 0);
    }
    const Direction low = Direction::from_degrees(89.9999999, 180);
    CHECK(hts::directional_diffuse_gradient({rough, light, low}, wavelength, {0.8, 6}).by.theta_r < -1);
    const auto s =
        hts::specular_reflectance_gradient(rough, view_gradient(rough, horizon), wavelength, {0.8, 6});
    CHECK(s.value.value() == 0);
    CHECK(s.by.theta_i == 0);
}

TEST_CASE("the extinction coefficient of a dielectric has a one-sided derivative") {
    Point p{0.1, 1, 0.6, 0, 1.2, 1.2, 3, 0.5};  // total reflection, which absorption weakens
    const auto f = p.gradient();
    CHECK(f.by.k < 0);
    const double value = f.value;
    p.k = 1e-7;
    CHECK((p.brdf() - value) / p.k == Approx(f.by.k).epsilon(1e-5));
    p.n = 1.5, p.k = 0;
    CHECK(p.gradient().by.k == 0);
}

TEST_CASE("every valid input has derivatives") {
    Random random{66};
    const auto length = [&] { return random.logarithmic(1e-24, 1e24); };
    const auto direction = [&] {
        if (random.uniform(0, 3) < 1)
            return Direction::from_degrees(random.one_of({0, 1e-12, 45, 89.99, 90}), 180);
        if (random.uniform(0, 2) < 1)
            return Direction::from_vector(
                {random.uniform(-1, 1), random.logarithmic(1e-300, 1), random.logarithmic(1e-300, 1)});
        return Direction::from_degrees(random.uniform(0, 90), random.one_of({0, 90, 180, 77}));
    };
    int failures = 0, count = 0;
    for (int i = 0; i < 200000; ++i) {
        const double sigma = random.uniform(0, 8) < 1 ? 0 : length();
        const Surface surface{sigma,
                              random.uniform(0, 2) < 1 || sigma == 0 ? length() : std::fmin(1e24, 3 * sigma)};
        const auto wavelength = Wavelength::from_micrometres(
            random.uniform(0, 2) < 1 || sigma == 0 ? length() : std::fmin(1e24, 3 * sigma));
        const RefractiveIndex index{random.uniform(0, 3) < 1 ? random.one_of({1, 0.5, 1 + 1e-15}) : length(),
                                    random.uniform(0, 3) < 1 ? 0 : length()};
        const auto in = view_gradient(surface, direction());
        const auto out =
            view_gradient(surface, random.uniform(0, 6) < 1 ? in.direction.mirror() : direction());
        const PairGradient pair{surface, in, out};
        const auto note = [&](double x) {
            if (!std::isfinite(x)) ++failures;
            ++count;
        };
        const auto f = hts::directional_diffuse_gradient(pair, wavelength, index);
        const auto s = hts::specular_reflectance_gradient(surface, in, wavelength, index);
        for (const auto& by : parameters<double>()) note(f.by.*by.of_gradient), note(s.by.*by.of_gradient);
        const auto m = hts::directional_diffuse_mueller_gradient(pair, wavelength, index);
        const auto t = hts::specular_mueller_gradient(surface, in, wavelength, index);
        for (const auto& by : parameters<Mueller>()) {
            for (const double x : (m.by.*by.of_gradient).elements()) note(x);
            for (const double x : (t.by.*by.of_gradient).elements()) note(x);
        }
    }
    CHECK(failures == 0);
    CHECK(count > 0);
}
