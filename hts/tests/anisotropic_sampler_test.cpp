// The sampler of surfaces of two correlation lengths, and of other correlations, against its density.
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

/// A surface under light from an angle [deg].
struct Lit {
    Surface surface;
    double theta, phi;
};

/// Draws against the density, of some of the cases; all of them where tests are exhaustive.
///   most_spread   of the weights, relative
template <class Model>
void check_draws(const std::string& name, const std::vector<Lit>& cases, double most_spread) {
    WorstCase sums{"density, specular and none of " + name + ", from 1, in standard errors", 4.5};
    WorstCase spread{"relative deviation of the weights of " + name, most_spread};
    double least = 1;
    const std::size_t draws = hts::testing::exhaustive() ? 1'000'000 : 40'000;
    for (std::size_t k = 1; k < cases.size();
         k += hts::testing::exhaustive() ? std::size_t{1} : std::size_t{3}) {
        const auto& [surface, theta_deg, phi_deg] = cases[k];
        const Model model{surface, SpectralSample{Wavelength::from_micrometres(1), {0.77, 6.08}, 0}};
        const Direction in = Direction::from_degrees(theta_deg, phi_deg);
        const double mirror = (phi_deg + 180) * pi / 180;
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
    std::cout << "sampler of " << name << ": least p " << least << '\n';
    sums.check();
    spread.check();
}

Surface brushed(double sigma, const CorrelationLengths& lengths, double azimuth) {
    return Surface::anisotropic(sigma, lengths, Direction::from_degrees(90, azimuth));
}

}  // namespace

TEMPLATE_TEST_CASE("draws from surfaces of two correlation lengths fall as their density says", "",
                   HeTorrance, HeUnified) {
    check_draws<TestType>("anisotropic surfaces",
                          {{brushed(0.1, {1, 3}, 0), 0, 0},
                           {brushed(0.1, {1, 5}, 20), 45, 0},
                           {brushed(0.3, {6, 1.5}, -60), 60, 0},
                           {brushed(0.02, {0.5, 2}, 0), 30, 70},
                           {brushed(1, {4, 40}, 0), 45, 45},
                           {brushed(0.3, {1, 4}, 10), 80, 40},
                           {brushed(0.05, {2, 8}, 0), 75, 90},
                           {brushed(0.3, {1.2, 12}, 30), 85, 80}},
                          1.4);
}

TEMPLATE_TEST_CASE("draws from surfaces of other correlations fall as their density says", "", HeTorrance,
                   HeUnified) {
    const auto exponential = hts::Correlation::exponential();
    const std::vector<hts::Correlation::Part> parts{{0.9, hts::Correlation::gaussian(), 1},
                                                    {0.1, exponential, 0.05}};
    const auto two_scales = hts::Correlation::sum(parts);
    check_draws<TestType>("other correlations",
                          {{Surface{0.1, 1}.correlated(exponential), 30, 0},
                           {Surface{0.1, 2}.correlated(exponential), 0, 0},
                           {Surface{0.3, 8}.correlated(hts::Correlation::matern(1.5)), 45, 0},
                           {Surface{0.02, 1}.correlated(exponential), 60, 20},
                           {Surface{0.3, 4}.correlated(two_scales), 30, 0},
                           {Surface{0.05, 0.5}.correlated(hts::Correlation::matern(1.5)), 75, 0},
                           {brushed(0.1, {1, 3}, 20).correlated(exponential), 45, 30},
                           {Surface{0.5, 20}.correlated(exponential), 70, 0}},
                          3);
}
