// The sampler where nothing is reflected, at the ends of every range, and its density call by call.

#include <cmath>
#include <sstream>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/he_torrance.hpp"
#include "hts/unified/he_unified.hpp"

using hts::Direction;
using hts::HeTorrance;
using hts::Lobe;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Uniforms;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

SpectralSample metal(double um = 0.5, double uniform_diffuse = 0) {
    return {Wavelength::from_micrometres(um), {0.77, 6.08}, uniform_diffuse};
}

Uniforms uniforms(Random& random) {
    const auto one = [&] {
        return random.uniform(0, 8) < 1 ? random.one_of({0, 0.5, 1 - 0x1p-53}) : random.uniform(0, 1);
    };
    const double u0 = one();
    const double u1 = one();
    return {u0, u1, one()};
}

Direction direction(Random& random) {
    const double azimuth = random.uniform(-180, 180);
    if (random.uniform(0, 3) < 1)
        return Direction::from_degrees(random.one_of({0, 1e-9, 89.9999999, 90}), azimuth);
    return Direction::from_degrees(random.uniform(0, 90), azimuth);
}

}  // namespace

TEMPLATE_TEST_CASE("a draw's density is that of its direction", "", HeTorrance, hts::HeUnified) {
    WorstCase worst{"density of a draw and of its direction", hts::accuracy::pdf};
    Random random{31};
    for (const double slope : {0.005, 0.05, 0.5}) {
        for (const double roughness : {0.01, 0.2, 3.0}) {
            const TestType sampler{{roughness, roughness / slope}, metal(0.5, 0.05), Tolerance{1e-6}};
            for (int i = 0; i < 4000; ++i) {
                const Direction in =
                    Direction::from_degrees(random.uniform(0, 89.5), random.uniform(-180, 180));
                const double u0 = random.uniform(0, 1);  // no ends: lobes have edges there
                const double u1 = random.uniform(0, 1);
                const auto drawn = sampler.draw(in, {u0, u1, random.uniform(0, 1)});
                if (drawn.lobe == Lobe::none || drawn.lobe == Lobe::specular) continue;
                worst.note(relative_error(sampler.pdf(in, drawn.out), drawn.pdf), [&] {
                    std::ostringstream text;
                    text << "slope " << slope << ", sigma0 " << roughness << ", cos " << in.cos_theta();
                    return text.str();
                });
            }
        }
    }
    worst.check();
}

TEMPLATE_TEST_CASE("every draw is finite, whatever the surface and the direction", "", HeTorrance,
                   hts::HeUnified) {
    Random random{32};
    const auto length = [&random] {
        return random.uniform(0, 3) < 1 ? random.one_of({1e-24, 1e-3, 1, 1e24})
                                        : random.logarithmic(1e-24, 1e24);
    };
    for (int surfaces = 0; surfaces < 60; ++surfaces) {
        const bool ordinary = surfaces % 2 == 0;
        const double sigma = ordinary                   ? random.logarithmic(1e-3, 10)
                             : random.uniform(0, 3) < 1 ? 0
                                                        : length();
        const double tau = ordinary ? random.logarithmic(1e-2, 100) : length();
        const SpectralSample sample = metal(ordinary ? 0.5 : length(), random.one_of({0, 0.1, 0.3}));
        const TestType sampler{{sigma, tau}, sample, Tolerance{1e-6}};
        for (int i = 0; i < 2000; ++i) {
            const Direction in = direction(random);
            const auto drawn = sampler.sample(in, uniforms(random));
            const double pdf = sampler.pdf(in, direction(random));
            const bool finite = std::isfinite(drawn.weight) && drawn.weight >= 0 &&
                                std::isfinite(drawn.pdf) && drawn.pdf >= 0 && pdf >= 0 && std::isfinite(pdf);
            INFO("sigma0 " << sigma << ", tau " << tau << ", lambda " << sample.wavelength.micrometres()
                           << ", cos " << in.cos_theta() << ", " << name(drawn.lobe) << ", weight "
                           << drawn.weight);
            if (!finite || std::abs(dot(drawn.out.vector(), drawn.out.vector()) - 1) > 1e-12) CHECK(false);
        }
    }
}

TEST_CASE("a mirror sends everything into the mirror direction, and a void nowhere") {
    const Direction in = Direction::from_degrees(40, 10);
    const HeTorrance mirror{{0, 2}, metal(), Tolerance{1e-6}};
    const auto drawn = mirror.sample(in, {0.3, 0.4, 0.5});
    CHECK(drawn.lobe == Lobe::specular);
    CHECK(drawn.pdf == Approx(1));
    CHECK(drawn.weight ==
          Approx(metal().index.amplitudes(in.cos_theta()).unpolarised_reflectance()).epsilon(1e-12));
    CHECK(mirror.specular_probability(in) == Approx(1));
    CHECK(mirror.pdf(in, in.mirror()) == 0);

    const HeTorrance nothing{{0.2, 2}, {Wavelength::from_micrometres(0.5), {1, 0}, 0}, Tolerance{1e-6}};
    CHECK(nothing.sample(in, {0.3, 0.4, 0.5}).lobe == Lobe::none);
    CHECK(nothing.sample(in, {0.3, 0.4, 0.5}).weight == 0);

    const HeTorrance white{
        {0, 2}, {Wavelength::from_micrometres(0.5), {1, 0}, hts::uniform_diffuse(0.8)}, Tolerance{1e-6}};
    CHECK(white.sample(in, {0.3, 0.4, 0.5}).lobe == Lobe::uniform_diffuse);
    CHECK(white.sample(in, {0.3, 0.4, 0.5}).weight == Approx(0.8));
    CHECK(white.pdf(in, Direction::from_degrees(90, 0)) == 0);
}

TEMPLATE_TEST_CASE("the same numbers draw the same direction, and a copy draws as the original", "",
                   HeTorrance, hts::HeUnified) {
    const TestType one{{0.28, 1.77}, metal(), Tolerance{1e-6}};
    const TestType other{{0.28, 1.77}, metal(), Tolerance{1e-6}};
    const TestType copy = one;
    Random random{33};
    for (int i = 0; i < 1000; ++i) {
        const Direction in = direction(random);
        const auto u = uniforms(random);
        const auto a = one.sample(in, u);
        for (const auto& b : {other.sample(in, u), copy.sample(in, u)}) {
            CHECK(a.out.cos_theta() == b.out.cos_theta());
            CHECK(a.pdf == b.pdf);
            CHECK(a.weight == b.weight);
        }
    }
    CHECK(one.bytes() > 60 * 40 * sizeof(double));
    CHECK(one.bytes() < 40000);
}
