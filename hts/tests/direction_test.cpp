#include "hts/direction.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::Vector3;
using hts::wave_vector_change;
using hts::testing::Random;

TEST_CASE("directions from angles, degrees and vectors are the same") {
    Random random{1};
    for (int i = 0; i < 1000; ++i) {
        const double theta = random.uniform(0, 90);
        const double phi = random.uniform(-400, 400);
        const Vector3 a = Direction::from_degrees(theta, phi).vector();
        const Vector3 b =
            Direction::from_angles(theta * std::numbers::pi / 180, phi * std::numbers::pi / 180).vector();
        const Vector3 c = Direction::from_vector(7.0 * a).vector();
        CHECK(hts::dot(a - b, a - b) < 1e-29);
        CHECK(hts::dot(a - c, a - c) < 1e-30);
        CHECK(hts::dot(a, a) == Approx(1).epsilon(1e-15));
    }
}

TEST_CASE("multiples of 90 degrees are exact") {
    const Direction horizon = Direction::from_degrees(90, 270);
    CHECK(horizon.cos_theta() == 0);
    CHECK(horizon.sin_theta() == 1);
    CHECK(horizon.cos_phi() == 0);
    CHECK(horizon.sin_phi() == -1);
    CHECK(Direction::from_degrees(0, 33).sin_theta() == 0);
}

TEST_CASE("the cosine keeps its precision near the horizon") {
    CHECK(Direction::from_degrees(89.99, 0).cos_theta() == Approx(1.7453292431333680e-4).epsilon(1e-12));
    CHECK(Direction::from_degrees(std::nextafter(90.0, 0.0), 0).cos_theta() ==
          Approx((90 - std::nextafter(90.0, 0.0)) * std::numbers::pi / 180).epsilon(1e-15));
}

TEST_CASE("a vertical direction keeps its azimuth") {
    CHECK(Direction::from_degrees(0, 90).sin_phi() == 1);
    CHECK(Direction::from_vector({0, 0, 2}).cos_phi() == 1);
}

TEST_CASE("directions below the horizon and broken ones are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(Direction::from_degrees(91, 0), "polar angle 91 deg: must be from 0 to 90 deg");
    CHECK_THROWS_WITH(Direction::from_degrees(-1, 0), "polar angle -1 deg: must be from 0 to 90 deg");
    CHECK_THROWS_AS(Direction::from_degrees(nan, 0), hts::Error);
    CHECK_THROWS_WITH(Direction::from_degrees(1, infinity), "azimuth inf deg: must be finite");
    CHECK_THROWS_WITH(Direction::from_angles(2, 0), "polar angle 2 rad: must be from 0 to pi/2 rad");
    CHECK_THROWS_AS(Direction::from_vector({0, 0, 0}), hts::Error);
    CHECK_THROWS_AS(Direction::from_vector({nan, 0, 1}), hts::Error);
    CHECK_THROWS_WITH(Direction::from_vector({0, 1, -0.5}),
                      "z of a direction vector -0.5: must be >= 0 (above the horizon)");
}

TEST_CASE("wave-vector change of a pair") {
    Random random{2};
    for (int i = 0; i < 2000; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
        const Direction out = Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
        const Vector3 v = in.vector() + out.vector();
        const auto change = wave_vector_change(in, out);
        CHECK(change.horizontal == Approx(std::hypot(v.x, v.y)).margin(4e-16));
        CHECK(change.squared() == Approx(hts::dot(v, v)).epsilon(1e-14));
        CHECK(change.cos_theta_d() == Approx(std::sqrt(hts::dot(v, v)) / 2).epsilon(1e-14));
        const auto back = wave_vector_change(out, in);
        CHECK(back.horizontal == change.horizontal);
        CHECK(back.vertical == change.vertical);
    }
}

TEST_CASE("the mirror direction changes only the vertical component") {
    for (const double theta : {0.0, 10.0, 45.0, 89.0}) {
        const Direction in = Direction::from_degrees(theta, 20);
        CHECK(wave_vector_change(in, Direction::from_degrees(theta, 200)).horizontal < 3e-16);
        CHECK(wave_vector_change(in, in.mirror()).horizontal == 0);
        CHECK(wave_vector_change(in, in.mirror()).cos_theta_d() == Approx(in.cos_theta()).epsilon(1e-15));
    }
}

TEST_CASE("the geometrical factor is that of the paper") {
    // [He91 (76)], with the printed vectors: (v.v/v_z)^2 / |k_r x k_i|^4 [(s_r.k_i)^2 +
    // (p_r.k_i)^2][(s_i.k_r)^2 + …]
    Random random{3};
    for (int i = 0; i < 500; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const Direction out = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const Vector3 incident = -in.vector();
        const Vector3 reflected = out.vector();
        const Vector3 up{0, 0, 1};
        const auto bracket = [&](Vector3 ray, Vector3 other) {
            const Vector3 across = hts::cross(ray, up);
            const Vector3 s = (1 / std::sqrt(hts::dot(across, across))) * across;
            const Vector3 p = hts::cross(s, ray);
            return std::pow(hts::dot(s, other), 2) + std::pow(hts::dot(p, other), 2);
        };
        const Vector3 v = reflected - incident;
        const Vector3 normal = hts::cross(reflected, incident);
        const double printed = std::pow(hts::dot(v, v) / v.z, 2) / std::pow(hts::dot(normal, normal), 2) *
                               bracket(reflected, incident) * bracket(incident, reflected);
        const double root = wave_vector_change(in, out).root_geometrical_factor();
        CHECK(root * root == Approx(printed).epsilon(1e-8));
    }
    const Direction grazing = Direction::from_degrees(90, 0);
    CHECK(wave_vector_change(grazing, Direction::from_degrees(90, 120)).root_geometrical_factor() == 0);
}
