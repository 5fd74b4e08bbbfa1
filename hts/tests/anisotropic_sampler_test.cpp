// The sampler of surfaces of two correlation lengths against its density.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "chi_squared.hpp"
#include "comparison.hpp"
#include "hts/he_torrance.hpp"
#include "hts/unified/he_unified.hpp"

using hts::CorrelationLengths;
using hts::Direction;
using hts::HeTorrance;
using hts::HeUnified;
using hts::Lobe;
using hts::SpectralSample;
using hts::Surface;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {
constexpr double pi = std::numbers::pi;
}

TEMPLATE_TEST_CASE("draws from surfaces of two correlation lengths fall as their density says", "",
                   HeTorrance, HeUnified) {
    struct Case {
        double sigma;
        CorrelationLengths lengths;
        double azimuth, theta, phi;
    };
    const std::vector<Case> cases{{0.1, {1, 3}, 0, 0, 0},      {0.1, {1, 5}, 20, 45, 0},
                                  {0.3, {6, 1.5}, -60, 60, 0}, {0.02, {0.5, 2}, 0, 30, 70},
                                  {1, {4, 40}, 0, 45, 45},     {0.3, {1, 4}, 10, 80, 40},
                                  {0.05, {2, 8}, 0, 75, 90},   {0.3, {1.2, 12}, 30, 85, 80}};
    WorstCase sums{"density, specular and none of anisotropic surfaces, from 1, in standard errors", 4.5};
    WorstCase spread{"relative deviation of their weights", 1.4};
    double least = 1;
    const std::size_t draws = hts::testing::exhaustive() ? 1'000'000 : 40'000;
    for (std::size_t k = 1; k < cases.size();
         k += hts::testing::exhaustive() ? std::size_t{1} : std::size_t{3}) {
        const Case& c = cases[k];
        const TestType model{Surface::anisotropic(c.sigma, c.lengths, Direction::from_degrees(90, c.azimuth)),
                             SpectralSample{Wavelength::from_micrometres(1), {0.77, 6.08}, 0}};
        const Direction in = Direction::from_degrees(c.theta, c.phi);
        const double mirror = (c.phi + 180) * pi / 180;
        Random random{100 + k};
        double sum = 0, squares = 0;
        std::size_t lobes = 0;
        const auto draw = [&]() -> hts::testing::Draw {
            const auto drawn = model.sample(in, random.uniforms());
            if (drawn.lobe == Lobe::specular) return {{}, true};
            sum += drawn.weight;
            squares += drawn.weight * drawn.weight;
            ++lobes;
            if (drawn.lobe == Lobe::none) return {};
            const double phi = std::atan2(drawn.out.sin_phi(), drawn.out.cos_phi()) - mirror;
            return {hts::testing::Angles{std::atan2(drawn.out.sin_theta(), drawn.out.cos_theta()),
                                         std::remainder(phi, 2 * pi)}};
        };
        const auto density = [&](double theta, double phi) {
            return theta < pi / 2 ? model.pdf(in, Direction::from_angles(theta, mirror + phi)) : 0;
        };
        const auto fit = hts::testing::fit_of(draw, density, draws, model.specular_probability(in));
        const auto where = [&] { return "case " + std::to_string(k); };
        INFO(where() << ", total " << fit.total << ", none " << fit.none);
        CHECK(fit.p_value > 0.001);
        least = std::min(least, fit.p_value);
        sums.note(fit.deviation_of_sum(draws), where);
        const double mean = sum / static_cast<double>(lobes);
        spread.note(std::sqrt(squares / static_cast<double>(lobes) - mean * mean) / mean, where);
    }
    std::cout << "sampler of anisotropic surfaces: least p " << least << " of " << cases.size() << '\n';
    sums.check();
    spread.check();
}
