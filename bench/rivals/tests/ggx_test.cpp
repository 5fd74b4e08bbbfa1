#include "bench/rivals/ggx.hpp"

#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <catch2/catch.hpp>

#include "bench/rivals/ggx_lanes.hpp"
#include "bench/rivals/ggx_sampling.hpp"
#include "bench/rivals/pbrt_conductor.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::bench::conductor_reflectance;
using hts::bench::RoughConductor;
using hts::bench::single;
using hts::spectral::DirectionPair;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

Direction random_direction(Random& random) {
    return Direction::from_angles(std::acos(random.uniform(0, 1)), random.uniform(0, 6.28));
}

/// Integral over the hemisphere of f(theta, phi) sin(theta), f even in phi.
template <class Function>
double hemisphere(const Function& f) {
    using Gauss = boost::math::quadrature::gauss<double, 100>;
    const double half_pi = std::numbers::pi / 2;
    return 2 * Gauss::integrate(
                   [&](double theta) {
                       const auto around = [&](double phi) { return f(theta, phi); };
                       return std::sin(theta) * (Gauss::integrate(around, 0.0, half_pi) +
                                                 Gauss::integrate(around, half_pi, 2 * half_pi));
                   },
                   0.0, half_pi);
}

}  // namespace

TEST_CASE("the conductor's reflectance is the engine's") {
    WorstCase worst{"reflectance in real arithmetic", 6e-14};
    Random random{1};
    for (int i = 0; i < 20000; ++i) {
        const double n = random.logarithmic(0.04, 8);
        const double k = random.logarithmic(0.1, 20);
        const double c = random.uniform(0, 1);
        worst.note(
            relative_error(conductor_reflectance(c, n, k), hts::fresnel(c, {n, k}).unpolarised_reflectance()),
            [&] {
                return "c = " + std::to_string(c) + ", n = " + std::to_string(n) +
                       ", k = " + std::to_string(k);
            });
    }
    worst.check();
    CHECK(conductor_reflectance(1.0, 1.5, 0.0) == Approx(0.04));
    CHECK(conductor_reflectance(0.0, 1.5, 2.0) == Approx(1));
}

TEST_CASE("the GGX distribution projects to area 1") {
    for (const double alpha : {0.2, 0.5, 1.0}) {
        const double projected = hemisphere([alpha](double theta, double) {
            const double c = std::cos(theta);
            const double s = std::sin(theta);
            return hts::bench::ggx_distribution(c * c, s * s, alpha * alpha) * c;
        });
        CHECK(projected == Approx(1).epsilon(1e-8));
    }
}

TEST_CASE("the white furnace: GGX with a perfect mirror for a facet loses energy and never gains any") {
    const auto total = [](double alpha, double degrees) {
        const RoughConductor conductor{alpha, {1}, {1e8}};
        const Direction in = Direction::from_degrees(degrees, 0);
        return hemisphere([&](double theta, double phi) {
            return conductor.pair(in, Direction::from_angles(theta, phi)).lobe * std::cos(theta);
        });
    };
    for (const double alpha : {0.2, 0.5, 1.0}) {
        for (const double degrees : {0.0, 45.0, 70.0}) {
            INFO("alpha = " << alpha << ", theta = " << degrees);
            CHECK(total(alpha, degrees) < 1 + 1e-6);
            CHECK(total(alpha, degrees) > 0.3);
        }
    }
    CHECK(total(0.2, 0) > 0.94);
    CHECK(total(1.0, 0) == Approx(1 - std::numbers::ln2).epsilon(1e-6));  // integral of c/(1 + c)
}

TEST_CASE("GGX is reciprocal") {
    const RoughConductor conductor{0.3, {0.2, 1.2, 2.5}, {3, 7, 3.4}};
    Random random{2};
    std::vector<double> forth(conductor.size());
    std::vector<double> back(conductor.size());
    WorstCase worst{"reciprocity of GGX", 4e-14};
    for (int i = 0; i < 2000; ++i) {
        const Direction a = random_direction(random);
        const Direction b = random_direction(random);
        conductor.brdf({a, b}, forth);
        conductor.brdf({b, a}, back);
        for (std::size_t j = 0; j < forth.size(); ++j) {
            worst.note(relative_error(forth[j], back[j]), [&] { return "pair " + std::to_string(i); });
        }
    }
    worst.check();
}

TEST_CASE("the GGX batch is its pairs one by one") {
    const RoughConductor conductor{0.3, {0.2, 1.2, 2.5, 1.1, 0.9}, {3, 7, 3.4, 2, 6}};
    Random random{3};
    std::vector<DirectionPair> pairs;
    pairs.reserve(50);
    for (int i = 0; i < 50; ++i) pairs.push_back({random_direction(random), random_direction(random)});
    std::vector<double> batch(pairs.size() * conductor.size());
    conductor.brdf(pairs, batch);
    std::vector<double> one(conductor.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        conductor.brdf(pairs[i], one);
        for (std::size_t j = 0; j < one.size(); ++j) CHECK(batch[i * one.size() + j] == one[j]);
    }
}

TEST_CASE("GGX at its limits") {
    const RoughConductor conductor{0.5, {0.2}, {3.4}};
    const Direction normal = Direction::from_degrees(0, 0);
    const Direction grazing = Direction::from_degrees(90, 0);
    CHECK(conductor.pair(normal, grazing).lobe == 0);
    CHECK(conductor.pair(grazing, grazing).lobe == 0);
    // at the normal D = 1/(pi alpha^2), V = 1/4
    CHECK(conductor.pair(normal, normal).lobe == Approx(1 / (std::numbers::pi * 0.25) / 4));
    CHECK(conductor.pair(normal, normal).cos_theta_d == 1);
    const Direction slanted = Direction::from_degrees(60, 40);
    CHECK(std::isfinite(conductor.pair(slanted, slanted).lobe));
    CHECK(conductor.pair(slanted, slanted.mirror()).cos_theta_d == Approx(0.5));
}

TEST_CASE("GGX refuses what it cannot use") {
    CHECK_THROWS_AS(RoughConductor(0, {1}, {1}), hts::Error);
    CHECK_THROWS_AS(RoughConductor(NAN, {1}, {1}), hts::Error);
    CHECK_THROWS_AS(RoughConductor(0.1, {}, {}), hts::Error);
    CHECK_THROWS_WITH(RoughConductor(0.1, {1, 2}, {1}), Catch::Contains("optical constants"));
}

TEST_CASE("the conductor in lanes is the scalar one") {
    Random random{2};
    WorstCase worst{"conductor in lanes", 1e-10};
    for (const std::size_t count : {1U, 3U, 4U, 7U, 31U}) {
        std::vector<double> n(count), k(count);
        for (std::size_t i = 0; i < count; ++i) {
            n[i] = random.logarithmic(0.04, 8);
            k[i] = random.logarithmic(0.1, 20);
        }
        const RoughConductor scalar{0.3, n, k};
        const hts::bench::LaneConductor lanes{0.3, n, k};
        std::vector<DirectionPair> pairs;
        for (int i = 0; i < 100; ++i) pairs.push_back({random_direction(random), random_direction(random)});
        std::vector<double> batch(pairs.size() * count), one(count), expected(count);
        lanes.brdf(pairs, batch);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            scalar.brdf(pairs[i], expected);
            lanes.brdf(pairs[i], one);
            for (std::size_t j = 0; j < count; ++j) {
                const auto where = [&] {
                    return std::to_string(count) + " wavelengths, pair " + std::to_string(i);
                };
                worst.note(relative_error(one[j], expected[j]), where);
                worst.note(relative_error(batch[i * count + j], expected[j]), where);
            }
        }
    }
    worst.check();
}

TEST_CASE("pbrt's conductor is the plain one in single precision, however compiled") {
    using hts::bench::Compilation;
    Random random{4};
    WorstCase brdf{"pbrt's BRDF", 8e-6}, density{"pbrt's density", 8e-6};
    for (const auto compilation : {Compilation::as_pbrt_is_built, Compilation::without_errno}) {
        const std::vector<double> n{0.2, 1.2, 2.5, 1.1}, k{3, 7, 3.4, 2};
        const RoughConductor plain{0.3, n, k};
        const hts::bench::GgxSampler sampler{0.3};
        const hts::bench::PbrtConductor pbrt{0.3, n, k, compilation};
        std::vector<double> expected(4);
        std::vector<float> values(4);
        for (int i = 0; i < 20000; ++i) {
            const DirectionPair pair{random.direction(0.05), random.direction(0.05)};
            const auto where = [&] { return "pair " + std::to_string(i); };
            plain.brdf(pair, expected);
            pbrt.brdf(single(pair.in), single(pair.out), values);
            for (std::size_t j = 0; j < 4; ++j) brdf.note(relative_error(values[j], expected[j]), where);
            density.note(
                relative_error(pbrt.pdf(single(pair.in), single(pair.out)), sampler.pdf(pair.in, pair.out)),
                where);
            const auto drawn = pbrt.sample(single(pair.in), {random.uniform(), random.uniform()}, values);
            if (!(drawn.pdf > 0 && drawn.out.z > 0.05)) continue;
            const Direction out = Direction::from_vector({drawn.out.x, drawn.out.y, drawn.out.z});
            plain.brdf({pair.in, out}, expected);
            density.note(relative_error(drawn.pdf, sampler.pdf(pair.in, out)), where);
            for (std::size_t j = 0; j < 4; ++j) brdf.note(relative_error(values[j], expected[j]), where);
        }
        CHECK_THROWS_WITH(
            hts::bench::PbrtConductor(0.3, std::vector<double>(5), std::vector<double>(5), compilation),
            Catch::Contains("5 wavelengths: must be 1, 4, 8, 16 or 31"));
    }
    CHECK_THROWS_AS(hts::bench::PbrtConductor(1e-4, std::vector<double>(4), std::vector<double>(4),
                                              Compilation::without_errno),
                    hts::Error);
    brdf.check();
    density.check();
}
