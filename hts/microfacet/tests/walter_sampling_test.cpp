// How the sampler of hts/microfacet/walter.hpp draws; walter_test.cpp has the values.
#include <cmath>
#include <iostream>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "checks.hpp"
#include "hts/microfacet/albedo.hpp"
#include "walter_cases.hpp"

using namespace hts;
using namespace hts::testing::walter;
using hts::testing::Angles;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

TEST_CASE("Walter: perfect mirrors reflect no more than all light, but by the rational G_1") {
    Random random{92};
    WorstCase visible{"albedo for F = 1, Beckmann and GGX", 1 + 1e-12};
    WorstCase phong{"albedo for F = 1, Phong, by draws", 1.0005};
    double most = 0;  // of Phong as the paper advises
    for (const double alpha : {0.01, 0.1, 0.3, 0.6, 1.0}) {
        for (const double shape : {0.0, 1.0, 2.0}) {
            const auto facets = distribution(shape, shape == 1 ? 2 / (alpha * alpha) - 2 : alpha);
            for (const double theta : {0.0, 45.0, 75.0, 85.0, 89.0}) {
                const auto in = Direction::from_degrees(theta, 0);
                const auto albedo = [&](const FacetDistribution& of) {
                    const int side = 80;  // a jittered grid of uniforms
                    double sum = 0;
                    for (int i = 0; i < side * side; ++i) {
                        const double u0 = (i % side + random.uniform(0, 1)) / side;
                        const double u1 = (i / side + random.uniform(0, 1)) / side;
                        sum += WalterBrdf{of, perfect}.sample(in, {u0, u1, 0}).weight;
                    }
                    return sum / (side * side);
                };
                (shape == 1 ? phong : visible).note(albedo(facets), [&] { return text(facets, theta); });
                if (shape != 1) continue;
                most = std::max(
                    most, albedo(FacetDistribution::phong(2 / (alpha * alpha) - 2, SmithForm::rational)));
            }
        }
    }
    visible.check();
    phong.check();
    std::cout << "albedo for F = 1, Phong with the rational G_1: most " << most << '\n';
    CHECK(most > 1.1);
}

TEST_CASE("Walter: draws fall as their density says, reflected and refracted, from both sides") {
    const std::size_t count = hts::testing::exhaustive() ? 2'000'000 : 40'000;
    WorstCase sums{"density and none, from 1, in standard errors", 4.5};
    double least = 1;
    int number = 0;
    Random random{93};
    for (const auto& facets : {FacetDistribution::beckmann(0.15), FacetDistribution::phong(30),
                               FacetDistribution::ggx(0.15), FacetDistribution::ggx(0.6)}) {
        for (const auto which : {NormalDraw::visible, NormalDraw::widened}) {
            for (const double theta : {20.0, 75.0}) {
                for (const Side side : {Side::front, Side::back}) {
                    if (++number % 5 != 0 && !hts::testing::exhaustive()) continue;
                    const double centre = 70 * pi / 180;
                    const SidedDirection in{side, Direction::from_degrees(theta, 250)};
                    const WalterBsdf glass{facets, 1, 1.5, which};
                    const auto draw = [&]() -> hts::testing::Draw {
                        const auto drawn = glass.sample(in, random.uniforms());
                        if (drawn.pdf == 0) return {};
                        return {Angles{polar_angle(drawn.out),
                                       std::remainder(azimuth(drawn.out.direction) - centre, 2 * pi)}};
                    };
                    const auto density = [&](double polar, double phi) {
                        return glass.pdf(in, on_sphere(polar, phi + centre));
                    };
                    const auto fit = hts::testing::fit_of(draw, density, count);
                    INFO(text(facets, theta)
                         << " side " << static_cast<int>(side) << ", total " << fit.total);
                    CHECK(fit.p_value > 1e-4);
                    least = std::min(least, fit.p_value);
                    sums.note(fit.deviation_of_sum(count), [&] { return text(facets, theta); });
                }
            }
        }
    }
    std::cout << "Walter: least p " << least << '\n';
    sums.check();
}

TEST_CASE("Walter: weight and density of a draw are those of its direction") {
    Random random{94};
    WorstCase weights{"weight from f cos / pdf", 1e-12};
    WorstCase densities{"density of the draw from pdf", 7e-12};
    WorstCase lengths{"squared length of the direction drawn, from 1", 6e-15};
    for (int i = 0; i < 40000; ++i) {
        const auto facets = random_facets(random);
        const auto where = [&] { return text(facets, 0); };
        const auto which = static_cast<NormalDraw>(random.one_of({0, 1, 2}));
        const auto from = random.uniform(0, 1) < 0.5 ? PathFrom::light : PathFrom::eye;
        const SidedDirection known{random.uniform(0, 1) < 0.5 ? Side::front : Side::back,
                                   off_grazing(random)};
        const WalterBsdf glass{facets, 1.1, 1.6, which};
        const auto drawn = glass.sample(known, random.uniforms(), from);
        if (drawn.weight > 1e-9 && drawn.out.direction.cos_theta() > 1e-4) {
            const double f =
                from == PathFrom::light ? glass.bsdf(known, drawn.out) : glass.bsdf(drawn.out, known);
            weights.note(relative_error(drawn.weight, f * drawn.out.direction.cos_theta() / drawn.pdf),
                         where);
            densities.note(relative_error(drawn.pdf, glass.pdf(known, drawn.out)), where);
            const auto v = drawn.out.vector();
            lengths.note(std::abs(dot(v, v) - 1), where);
        }
        const WalterBrdf metal{facets, {0.2, 3}, which};
        const auto mirrored = metal.sample(known.direction, random.uniforms());
        if (mirrored.weight > 1e-9 && mirrored.out.cos_theta() > 1e-4) {
            const double f = metal.brdf(known.direction, mirrored.out);
            weights.note(relative_error(mirrored.weight, f * mirrored.out.cos_theta() / mirrored.pdf), where);
            densities.note(relative_error(mirrored.pdf, metal.pdf(known.direction, mirrored.out)), where);
        }
    }
    weights.check();
    densities.check();
    lengths.check();
}

TEST_CASE("Walter: with a diffuse term draws are of both, and their mean weight is the albedo") {
    const WalterInterface bare{FacetDistribution::ggx(0.3), {1.5, 0}, 1},
        painted{FacetDistribution::ggx(0.3), {1.5, 0}, 1, 0.4};
    CHECK(bare.transmits());
    CHECK_FALSE(painted.transmits());
    CHECK_THROWS_AS((WalterInterface{FacetDistribution::ggx(0.3), {1.5, 0}, 1, 1.1}), Error);
    Random random{11};
    for (const double degrees : {0.0, 40.0, 80.0}) {
        const Direction in = Direction::from_degrees(degrees, 20);
        const double albedo = directional_albedo(painted, in);
        CHECK(albedo == Approx(directional_albedo(bare, in) + 0.4).epsilon(1e-6));
        constexpr int draws = 40'000;
        double sum = 0, squares = 0;
        for (int i = 0; i < draws; ++i) {
            const Draw drawn =
                painted.sample(in, {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)});
            sum += drawn.weight / draws;
            squares += drawn.weight * drawn.weight / draws;
            if (drawn.lobe == Lobe::none) continue;
            REQUIRE(drawn.pdf == painted.pdf(in, drawn.out));
            REQUIRE(drawn.weight * drawn.pdf ==
                    Approx(painted.brdf(in, drawn.out) * drawn.out.cos_theta()).epsilon(1e-12));
            REQUIRE(painted.brdf(in, drawn.out) - bare.brdf(in, drawn.out) ==
                    Approx(0.4 * std::numbers::inv_pi).epsilon(1e-9));
        }
        CHECK(std::abs(sum - albedo) < 4 * std::sqrt((squares - sum * sum) / draws));
        CHECK(painted.pdf(in, in.mirror()) < 1e4);
    }
}

TEST_CASE("Walter: weights stay within the bounds of the paper and of visible normals") {
    const int count = hts::testing::exhaustive() ? 20'000'000 : 150'000;
    Random random{95};
    WorstCase visible{"weight of visible normals, Beckmann and GGX", 1 + 1e-12};
    WorstCase phong{"weight of Phong by GGX's visible normals", 2.7};
    WorstCase widened{"weight of the widened Beckmann", 4};
    for (int i = 0; i < count; ++i) {
        const double alpha = random.logarithmic(0.01, 1);
        const auto in = Direction::from_degrees(
            i % 2 == 0 ? random.uniform(0, 90) : 90 - random.logarithmic(1e-3, 30), 0);
        const auto u = random.uniforms();
        const auto weight = [&](const FacetDistribution& facets, NormalDraw which) {
            return WalterBrdf{facets, perfect, which}.sample(in, u).weight;
        };
        const auto where = [&] {
            return "alpha " + std::to_string(alpha) + ", cos theta " + std::to_string(in.cos_theta());
        };
        visible.note(weight(FacetDistribution::beckmann(alpha), NormalDraw::visible), where);
        visible.note(weight(FacetDistribution::ggx(alpha), NormalDraw::visible), where);
        phong.note(weight(FacetDistribution::phong(2 / (alpha * alpha) - 2), NormalDraw::visible), where);
        widened.note(weight(FacetDistribution::beckmann(alpha), NormalDraw::widened), where);
    }
    visible.check();
    phong.check();
    widened.check();
}
