#include "spectral/energy/surely_valid.hpp"

#include <catch2/catch.hpp>
#include <iostream>

#include "comparison.hpp"

using hts::Direction;
using hts::DirectionPair;
using hts::SpectralSample;
using hts::Surface;
using hts::testing::Random;
using namespace hts::spectral;

namespace {

DirectionPair random_pair(Random& random) {
    const auto direction = [&] {
        return Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
    };
    const Direction in = direction();
    return {in, direction()};
}

bool outside(const Surface& surface, const DirectionPair& pair, const SpectralSample& sample) {
    return validity(surface, pair, sample).severity() == Severity::outside;
}

}  // namespace

TEST_CASE("what is surely valid has no finding outside") {
    Random random{4};
    const SpectralSample sample{hts::Wavelength::from_micrometres(0.5), {0.8, 6}, hts::uniform_diffuse(0.5)};
    int told = 0, contradicted = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double length = random.logarithmic(0.1, 100);
        const Surface surface{length * random.logarithmic(1e-3, 2), length};
        const DirectionPair pair = random_pair(random);
        if (!surely_valid(surface, pair, sample.wavelength)) continue;
        ++told;
        contradicted += outside(surface, pair, sample);
    }
    CHECK(contradicted == 0);
    CHECK(told > 20'000);

    const Surface aluminium{0.28, 1.77};
    int valid = 0;
    told = 0;
    for (int i = 0; i < 10'000; ++i) {
        const DirectionPair pair = random_pair(random);
        valid += !outside(aluminium, pair, sample);
        told += surely_valid(aluminium, pair, sample.wavelength);
    }
    std::cout << "surely valid: " << told << " of " << valid << " that are\n";
    CHECK(told > 0.7 * valid);
}

TEST_CASE("surfaces whose slopes depend on azimuth or wavelength, and mirrors, are left to the verdict") {
    const DirectionPair normal{Direction::from_degrees(0, 0), Direction::from_degrees(0, 0)};
    const auto green = hts::Wavelength::from_micrometres(0.5);
    CHECK(surely_valid(Surface{0.1, 5}, normal, green));
    CHECK_FALSE(surely_valid(Surface{0, 5}, normal, green));
    CHECK_FALSE(surely_valid(Surface{0.1, 5}.correlated(hts::Correlation::exponential()), normal, green));
    CHECK_FALSE(surely_valid(Surface{4, 5}, normal, green));
    CHECK_FALSE(surely_valid(Surface{0.1, 0.2}, normal, green));
}
