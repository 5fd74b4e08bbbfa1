#include "tables/formats/mitsuba/frames.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::Direction;
using hts::Mueller;
using hts::Vector3;
using hts::testing::Random;

namespace {

Mueller gold_facet(const Direction& in, const Direction& out) {
    const auto amplitudes = hts::fresnel(wave_vector_change(in, out).cos_theta_d(), {0.183, 3.43});
    return Mueller::from_jones(hts::facet_jones(in, out, amplitudes));
}

Vector3 unit(Vector3 v) {
    return (1 / std::sqrt(dot(v, v))) * v;
}

}  // namespace

TEST_CASE("in the facet's own right-handed frames a reflection is Mitsuba's") {
    // [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C cos D, -C sin D], [0, 0, C sin D, C cos D]], A = (R_s + R_p)/2, B
    // = (R_s - R_p)/2, C = sqrt(R_s R_p) and D = arg r_p - arg r_s for n - ik, whose amplitudes are the
    // conjugates of ours
    Random random{31};
    for (int i = 0; i < 200; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const Direction out = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const auto f = hts::fresnel(wave_vector_change(in, out).cos_theta_d(), {0.183, 3.43});
        const Vector3 x = unit(cross(in.vector(), out.vector()));
        const Mueller m = hts::in_right_handed_frames(gold_facet(in, out), in, out, x, x);
        const double c = std::abs(f.s) * std::abs(f.p);
        const double d = std::arg(std::conj(f.p)) - std::arg(std::conj(f.s));
        const double a = f.unpolarised_reflectance();
        const double b = (std::norm(f.s) - std::norm(f.p)) / 2;
        const double expected[4][4] = {{a, b, 0, 0},
                                       {b, a, 0, 0},
                                       {0, 0, c * std::cos(d), -c * std::sin(d)},
                                       {0, 0, c * std::sin(d), c * std::cos(d)}};
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t column = 0; column < 4; ++column) {
                INFO("element " << row << column);
                CHECK(m(row, column) == Approx(expected[row][column]).margin(1e-11));
            }
        }
    }
}

TEST_CASE("the sign of M23 in Mitsuba's convention") {
    // gold, 60 degrees: 0.717304 in the paper's frames, -0.717304 by Mitsuba's formula
    const Direction in = Direction::from_degrees(60, 0);
    const Mueller ours = gold_facet(in, in.mirror());
    const Vector3 x{0, 1, 0};
    const Mueller theirs = hts::in_right_handed_frames(ours, in, in.mirror(), x, x);
    CHECK(ours(2, 3) / ours(0, 0) == Approx(0.717304).margin(1e-6));
    CHECK(theirs(2, 3) / theirs(0, 0) == Approx(-0.717304).margin(1e-6));
}

TEST_CASE("Mitsuba's axes") {
    const auto is = [](Vector3 a, Vector3 b) { return std::sqrt(dot(a - b, a - b)) < 1e-15; };
    CHECK(is(hts::mitsuba_x_axis({0.6, 0, 0.8}), {0.8, 0, -0.6}));
    CHECK(is(hts::mitsuba_x_axis({0, 0.6, 0.8}), {1, 0, 0}));
    CHECK(is(hts::mitsuba_x_axis({0.6, 0, -0.8}), {0.8, 0, 0.6}));
    CHECK(is(hts::mitsuba_x_axis({0.48, 0.36, 0.8}), {0.872, -0.096, -0.48}));
}

TEST_CASE("a field reflected in three dimensions has the Stokes vector that Mitsuba's matrix gives") {
    // light arrives along k_i with its field along x or diagonal in Mitsuba's frame; the facet reflects the
    // parts across and in its plane; time factor exp(-i omega t), y = k x x, S3 > 0
    // clockwise for the receiver
    using Complex = std::complex<double>;
    Random random{33};
    for (int i = 0; i < 100; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const Direction out = Direction::from_degrees(random.uniform(1, 89), random.uniform(0, 360));
        const auto f = hts::fresnel(wave_vector_change(in, out).cos_theta_d(), {0.183, 3.43});
        const Vector3 ki = -in.vector();
        const Vector3 kr = out.vector();
        const Vector3 s = unit(cross(ki, kr));
        const auto y_axis = [](Vector3 k) { return cross(k, hts::mitsuba_x_axis(k)); };
        const Vector3 field = unit(hts::mitsuba_x_axis(ki) + 0.5 * y_axis(ki));
        const Complex along_s = f.s * dot(field, s);
        const Complex along_p = f.p * dot(field, cross(s, ki));
        const auto component = [&](Vector3 axis) {
            return along_s * dot(s, axis) + along_p * dot(cross(s, kr), axis);
        };
        const Complex x = component(hts::mitsuba_x_axis(kr));
        const Complex y = component(y_axis(kr));
        const double expected[4] = {std::norm(x) + std::norm(y), std::norm(x) - std::norm(y),
                                    2 * (x * std::conj(y)).real(), 2 * (x * std::conj(y)).imag()};
        const Mueller m = hts::mitsuba_mueller(gold_facet(in, out), in, out);
        const hts::Stokes reflected = m * hts::Stokes{1, 0.6, 0.8, 0};
        for (std::size_t k = 0; k < 4; ++k) {
            INFO("component " << k);
            CHECK(reflected[k] == Approx(expected[k]).margin(1e-11));
        }
    }
}

TEST_CASE("Mitsuba's axes lie across the ray and the change keeps what does not depend on frames") {
    Random random{32};
    for (int i = 0; i < 200; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
        const Direction out = Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
        for (const Vector3 k : {-in.vector(), out.vector()}) {
            const Vector3 x = hts::mitsuba_x_axis(k);
            CHECK(dot(x, k) == Approx(0).margin(1e-15));
            CHECK(dot(x, x) == Approx(1).epsilon(1e-14));
        }
        const Mueller ours = gold_facet(in, out);
        const Mueller theirs = hts::mitsuba_mueller(ours, in, out);
        CHECK(theirs(0, 0) == ours(0, 0));
        CHECK(theirs(3, 3) == ours(3, 3));
        CHECK(std::hypot(theirs(0, 1), theirs(0, 2)) ==
              Approx(std::hypot(ours(0, 1), ours(0, 2))).margin(1e-15));
    }
}
