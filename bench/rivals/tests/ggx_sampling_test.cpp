#include "bench/rivals/ggx_sampling.hpp"

#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "bench/rivals/ggx.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::bench::GgxSampler;
using hts::testing::Random;

TEST_CASE("visible GGX normals: density and draws agree with the integrals") {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
    constexpr double pi = std::numbers::pi;
    Random random{41};
    for (const double alpha : {0.2, 0.6}) {
        for (const double degrees : {0.0, 50.0, 80.0}) {
            const GgxSampler sampler{alpha};
            const hts::bench::RoughConductor mirror_facets{alpha, {1}, {1e8}};
            const Direction in = Direction::from_degrees(degrees, 0);
            const auto hemisphere = [&](const auto& f) {
                return 2 * Quadrature::integrate(
                               [&](double theta) {
                                   const auto ring = [&](double phi) {
                                       return f(Direction::from_angles(theta, phi));
                                   };
                                   return std::sin(theta) * Quadrature::integrate(ring, 0.0, pi, 8, 1e-8);
                               },
                               0.0, pi / 2, 8, 1e-8);
            };
            const double density = hemisphere([&](const Direction& out) { return sampler.pdf(in, out); });
            const double reflectance = hemisphere(
                [&](const Direction& out) { return mirror_facets.pair(in, out).lobe * out.cos_theta(); });
            constexpr int draws = 200000;
            double none = 0;
            double sum = 0;
            double squares = 0;
            for (int i = 0; i < draws; ++i) {
                const double u0 = random.uniform(0, 1);
                const auto drawn = sampler.draw(in, {u0, random.uniform(0, 1)});
                if (drawn.pdf == 0) {
                    ++none;
                    continue;
                }
                const double weight =
                    mirror_facets.pair(in, drawn.out).lobe * drawn.out.cos_theta() / drawn.pdf;
                sum += weight;
                squares += weight * weight;
            }
            const double mean = sum / draws;
            INFO("alpha " << alpha << ", theta " << degrees);
            CHECK(density + none / draws == Approx(1).margin(4 * std::sqrt(none + 1) / draws));
            CHECK(mean ==
                  Approx(reflectance).margin(4 * std::sqrt((squares / draws - mean * mean) / draws) + 1e-6));
        }
    }
    CHECK_THROWS_AS(GgxSampler(0), hts::Error);
}
