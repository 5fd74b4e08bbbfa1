// The shortcut of metals against the whole lobe.
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/unified/he_unified_spectrum.hpp"

using hts::Direction;
using hts::HeUnifiedSpectrum;
using hts::RefractiveIndex;
using hts::Surface;
using hts::Tolerance;
using hts::UnifiedChoices;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

constexpr UnifiedChoices shortcut{.conductor_shortcut = true};

/// A surface whose lengths are in wavelengths, at the wavelength 1 um.
HeUnifiedSpectrum model(const Surface& surface, const RefractiveIndex& index, const UnifiedChoices& choices,
                        double tolerance = 1e-12) {
    return {surface,
            {{Wavelength::from_micrometres(1), index, 0}},
            Tolerance{tolerance},
            hts::DiffuseLobe::full,
            choices};
}

double brdf(const HeUnifiedSpectrum& of, const Direction& in, const Direction& out) {
    double value = 0;
    of.brdf({in, out}, {&value, 1});
    return value;
}

/// Uniform in projected solid angle.
Direction drawn(Random& random) {
    const double radius = std::sqrt(random.uniform(0, 1)), azimuth = random.uniform(0, 2 * M_PI);
    return Direction::from_vector(
        {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - radius * radius)});
}

/// rms of the difference over directions, weighted with the light [dB].
double decibels(const Surface& surface, const RefractiveIndex& index, double theta_i_deg) {
    const HeUnifiedSpectrum whole = model(surface, index, {}, 1e-6),
                            quick = model(surface, index, shortcut, 1e-6);
    const Direction in = Direction::from_degrees(theta_i_deg, 0);
    Random random{1};
    double weight = 0, squares = 0;
    for (int i = 0; i < 4000; ++i) {
        const Direction out = drawn(random);
        const double exact = brdf(whole, in, out);
        if (!(exact > 0)) continue;
        const double difference = 10 * std::log10(brdf(quick, in, out) / exact);
        weight += exact;
        squares += exact * difference * difference;
    }
    return std::sqrt(squares / weight);
}

}  // namespace

TEST_CASE("the shortcut of a perfect conductor is its lobe") {
    WorstCase worst{"shortcut of a perfect conductor", 4e-13};
    Random random{7};
    for (const double slope : {0.02, 0.2, 0.5}) {
        for (const double roughness : {0.02, 0.2, 2.0}) {
            const Surface surface{roughness, roughness / slope};
            const auto whole = model(surface, hts::perfect_conductor(), {}),
                       quick = model(surface, hts::perfect_conductor(), shortcut);
            for (int i = 0; i < 300; ++i) {
                const Direction in = drawn(random), out = drawn(random);
                const double exact = brdf(whole, in, out);
                if (exact < 1e-280) continue;
                worst.note(hts::testing::relative_error(brdf(quick, in, out), exact),
                           [&] { return std::to_string(slope) + ", " + std::to_string(roughness); });
            }
        }
    }
    worst.check();
}

TEST_CASE("the shortcut is as near to the whole lobe of metals as it says") {
    struct Metal {
        const char* name;
        RefractiveIndex index;
    };
    const std::vector<Metal> metals{{"silver 0.63", {0.135, 3.99}},  {"the study's", {0.16, 3.6}},
                                    {"gold 0.6", {0.25, 2.9}},       {"copper 0.63", {0.24, 3.42}},
                                    {"aluminium 0.5", {0.77, 6.08}}, {"aluminium 10", {25, 90}},
                                    {"nickel 0.6", {1.98, 3.7}},     {"chromium 0.6", {3.18, 3.31}}};
    using namespace hts::accuracy;
    WorstCase gentle{"the shortcut's distance, tau >= lambda, up to 60 deg [dB]",
                     conductor_shortcut_gentle_db};
    WorstCase worst{"the shortcut's distance [dB]", conductor_shortcut_db};
    double squares = 0, gentle_squares = 0;
    for (const auto& [name, index] : metals) {
        for (const double length : {0.5, 1.0, 2.0, 4.0}) {
            for (const double slope : {0.05, 0.1, 0.25, 0.5}) {
                for (const double theta : {0.0, 30.0, 60.0, 75.0}) {
                    const double distance = decibels({slope * length, length}, index, theta);
                    const auto where = [&, &metal = name] {
                        return std::string{metal} + ", tau " + std::to_string(length) + ", slope " +
                               std::to_string(slope) + ", " + std::to_string(theta) + " deg";
                    };
                    worst.note(distance, where);
                    squares += distance * distance;
                    if (length < 1 || theta > 60) continue;
                    gentle.note(distance, where);
                    gentle_squares += distance * distance;
                }
            }
        }
    }
    std::cout << "the shortcut: rms " << std::sqrt(squares / static_cast<double>(worst.count())) << " dB, "
              << std::sqrt(gentle_squares / static_cast<double>(gentle.count()))
              << " dB with tau >= lambda up to 60 deg\n";
    gentle.check();
    worst.check();
}

TEST_CASE("the shortcut leaves Mueller matrices as they are, and is refused of what is no metal") {
    const Direction in = Direction::from_degrees(50, 0), out = Direction::from_degrees(40, 150);
    const auto whole = model({0.1, 1}, {0.25, 2.9}, {}), quick = model({0.1, 1}, {0.25, 2.9}, shortcut);
    hts::Mueller one, other;
    whole.mueller({in, out}, {&one, 1});
    quick.mueller({in, out}, {&other, 1});
    CHECK(one.elements() == other.elements());
    CHECK(brdf(quick, in, out) != brdf(whole, in, out));
    double mirror = 0, same = 0;
    whole.specular_reflectance(in, {&mirror, 1});
    quick.specular_reflectance(in, {&same, 1});
    CHECK(mirror == same);
    CHECK_THROWS_WITH(model({0.1, 1}, {1.5, 0}, shortcut), Catch::Contains("conductor_shortcut at 1 um") &&
                                                               Catch::Contains("0.04") &&
                                                               Catch::Contains(">= 0.5"));
    CHECK_THROWS_WITH(hts::require_theory_of_films(shortcut), Catch::Contains("conductor_shortcut"));
}
