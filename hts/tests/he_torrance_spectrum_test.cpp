// The lanes against the exact path of terms.hpp, in every regime. HTS_EXHAUSTIVE=1 takes 10^7 points a
// tolerance, otherwise 10^5, in single precision 10^6.
#include "hts/he_torrance_spectrum.hpp"

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "any_input.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/evaluation/single_precision.hpp"

using hts::DiffuseLobe;
using hts::Direction;
using hts::DirectionPair;
using hts::HeTorranceSpectrum;
using hts::Mueller;
using hts::RefractiveIndex;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Wavelength;
using hts::testing::any_direction;
using hts::testing::any_index;
using hts::testing::any_pair;
using hts::testing::described;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double exact = hts::accuracy::finest_tolerance;

Surface surface(Random& random) {
    const double pick = random.uniform(0, 8);
    if (pick < 1) return {0, random.logarithmic(0.1, 100)};
    if (pick < 2) return {random.logarithmic(1, 50), random.logarithmic(0.1, 3)};  // steep
    const double sigma = random.logarithmic(1e-3, 16);
    return {sigma, sigma / random.logarithmic(3e-3, 2)};
}

std::vector<SpectralSample> samples(Random& random, std::size_t count) {
    std::vector<SpectralSample> result;
    result.reserve(count);
    const double diffuse = random.one_of({0, 0, 0.1});
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back(
            {Wavelength::from_micrometres(random.logarithmic(0.3, 13)), any_index(random), diffuse});
    }
    return result;
}

/// The surface with a shape of correlation, now and then with another length across.
Surface correlated(const Surface& of, const hts::Correlation& shape, Random& random) {
    if (of.rms_roughness() == 0 || random.uniform(0, 3) > 1) return of.correlated(shape);
    const double length = of.correlation_length();
    return Surface::anisotropic(of.rms_roughness(), {length, length * random.logarithmic(0.1, 10)},
                                Direction::from_degrees(90, random.uniform(0, 180)))
        .correlated(shape);
}

/// Worst errors of brdf and mueller over random surfaces, each with spectra of every length up to 20.
void compare(double tolerance, DiffuseLobe lobe = DiffuseLobe::full,
             const std::optional<hts::Correlation>& shape = {}) {
    const std::string name = std::string{shape ? "of another correlation " : ""} + "with lobe " +
                             hts::name(lobe) + " at " + std::to_string(tolerance);
    WorstCase brdf{"brdf " + name, tolerance};
    WorstCase matrices{"mueller " + name, tolerance};
    Random random{20261122};
    const bool single = tolerance >= hts::accuracy::single_precision_brdf;
    const double floor = single ? hts::accuracy::single_precision_floor : 1e-280;
    const std::size_t points = hts::testing::exhaustive() ? 10'000'000 : single ? 1'000'000 : 100'000;
    while (brdf.count() < points) {
        const Surface gaussian = surface(random);
        const Surface ground = shape ? correlated(gaussian, *shape, random) : gaussian;
        const std::size_t count = 1 + brdf.count() % 20;
        const auto spectrum = samples(random, count);
        const HeTorranceSpectrum fast{ground, spectrum, Tolerance{tolerance}, lobe};
        const HeTorranceSpectrum slow{ground, spectrum, Tolerance{exact}, lobe};
        std::vector<double> f(count);
        std::vector<double> reference(count);
        std::vector<Mueller> m(count);
        std::vector<Mueller> reference_m(count);
        for (int i = 0; i < 20; ++i) {
            const DirectionPair p = any_pair(random);
            fast.brdf(p, f);
            slow.brdf(p, reference);
            fast.mueller(p, m);
            slow.mueller(p, reference_m);
            for (std::size_t j = 0; j < count; ++j) {
                const auto where = [&] { return described(p, ground, spectrum[j]); };
                if (!(std::isfinite(f[j]) && f[j] >= 0)) FAIL(f[j] << " at " << where());
                if (reference[j] < floor) {  // absolute there
                    if (single) brdf.note(std::abs(f[j] - reference[j]) / floor, where);
                    continue;
                }
                brdf.note(relative_error(f[j], reference[j]), where);
                for (std::size_t e = 0; e < 16; ++e) {
                    matrices.note(std::abs(m[j].elements()[e] - reference_m[j].elements()[e]) / reference[j],
                                  where);
                }
            }
        }
    }
    brdf.check();
    matrices.check();
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("lanes keep the tolerance in every regime") {
    compare(1e-3);
    compare(1e-6);
}

TEST_CASE("lanes keep the tolerance whatever the correlation") {
    const std::vector<hts::Correlation::Part> two_scales{{0.9, hts::Correlation::gaussian(), 1},
                                                         {0.1, hts::Correlation::exponential(), 0.05}};
    for (const auto& shape : {hts::Correlation::exponential(), hts::Correlation::matern(1.5),
                              hts::Correlation::sum(two_scales)}) {
        compare(1e-6, DiffuseLobe::full, shape);
        compare(1e-3, DiffuseLobe::full, shape);
    }
    compare(1e-6, DiffuseLobe::first_order, hts::Correlation::exponential());
}

TEST_CASE("lanes keep the tolerance of the lobe's limits") {
    compare(1e-6, DiffuseLobe::first_order);
    compare(1e-6, DiffuseLobe::rough_limit);
    compare(1e-6, DiffuseLobe::none);
    compare(1e-3, DiffuseLobe::first_order);
    compare(1e-3, DiffuseLobe::rough_limit);
}

TEST_CASE("lanes keep the tolerance of the specular term") {
    for (const double tolerance : {1e-6, 1e-3}) {
        WorstCase worst{"specular reflectance at " + std::to_string(tolerance), tolerance};
        Random random{20261123};
        const std::size_t points = hts::testing::exhaustive() ? 10'000'000 : 1'000'000;
        while (worst.count() < points) {
            const Surface gaussian = surface(random);
            const Surface ground = random.uniform(0, 4) < 1
                                       ? correlated(gaussian, hts::Correlation::matern(1.5), random)
                                       : gaussian;
            const auto spectrum = samples(random, 1 + worst.count() % 20);
            const HeTorranceSpectrum fast{ground, spectrum, Tolerance{tolerance}};
            std::vector<double> values(spectrum.size() + 1, -1);
            for (int i = 0; i < 200; ++i) {
                const Direction in = any_direction(random);
                fast.specular_reflectance(in, {values.data(), spectrum.size()});
                for (std::size_t j = 0; j < spectrum.size(); ++j) {
                    const hts::View seen = view(ground.seen_by(spectrum[j].wavelength), in);
                    const double expected =
                        specular_reflectance(ground, seen, spectrum[j].wavelength, spectrum[j].index).value();
                    const auto where = [&] { return described({in, in.mirror()}, ground, spectrum[j]); };
                    if (!(std::isfinite(values[j]) && values[j] >= 0)) FAIL(values[j] << " at " << where());
                    worst.note(expected < 1e-280 ? 0 : relative_error(values[j], expected), where);
                }
            }
            CHECK(values.back() == -1);
        }
        worst.check();
    }
}

TEST_CASE("the limits of the lobe are those of Phi") {
    const DirectionPair p{Direction::from_degrees(30, 0), Direction::from_degrees(35, 170)};
    const auto brdf = [&](double roughness, double tolerance, DiffuseLobe lobe) {
        const SpectralSample sample{Wavelength::from_micrometres(0.5), RefractiveIndex{1.5, 2}, 0.125};
        std::vector<double> f(1);
        HeTorranceSpectrum{Surface{roughness, 10 * roughness}, {sample}, Tolerance{tolerance}, lobe}.brdf(p,
                                                                                                          f);
        return f[0] - 0.125;
    };
    for (const double tolerance : {1e-12, 1e-6}) {
        CAPTURE(tolerance);
        CHECK(brdf(0.3, tolerance, DiffuseLobe::none) == 0);
        // g = 0.0022 and 8700: the next terms are g/4 e^(t/2) and about 0.6/g
        const double smooth = brdf(0.002, tolerance, DiffuseLobe::full);
        const double rough = brdf(4, tolerance, DiffuseLobe::full);
        CHECK(relative_error(brdf(0.002, tolerance, DiffuseLobe::first_order), smooth) < 0.002);
        CHECK(relative_error(brdf(4, tolerance, DiffuseLobe::rough_limit), rough) < 2e-4);
        CHECK(relative_error(brdf(0.3, tolerance, DiffuseLobe::rough_limit),
                             brdf(0.3, tolerance, DiffuseLobe::full)) > 1e-3);
        CHECK(relative_error(brdf(0.3, tolerance, DiffuseLobe::first_order),
                             brdf(0.3, tolerance, DiffuseLobe::full)) > 0.5);
    }
}

TEST_CASE("a pair has the same bits alone, in any batch and anywhere in it") {
    Random random{5};
    for (const std::size_t count : {1U, 3U, 4U, 5U, 8U, 16U, 31U, 100U}) {
        const auto spectrum = samples(random, count);
        for (const double tolerance : {1e-12, 1e-6, 1e-3, 0.0}) {
            const Surface gaussian{0.28, 1.77};
            const HeTorranceSpectrum prepared{
                tolerance > 0 ? gaussian : gaussian.correlated(hts::Correlation::exponential()), spectrum,
                Tolerance{tolerance > 0 ? tolerance : 1e-6}};
            std::vector<DirectionPair> pairs;
            pairs.reserve(150);
            for (int i = 0; i < 150; ++i) pairs.push_back(any_pair(random));
            std::vector<double> alone(pairs.size() * count);
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                prepared.brdf(pairs[i], std::span{alone}.subspan(i * count, count));
            }
            for (const std::size_t first : {0U, 1U, 7U, 64U, 149U}) {
                std::vector<double> batch((pairs.size() - first) * count);
                prepared.brdf(std::span{pairs}.subspan(first), batch);
                INFO(count << " wavelengths from pair " << first << " at " << tolerance);
                CHECK(same_bits(batch,
                                {alone.begin() + static_cast<std::ptrdiff_t>(first * count), alone.end()}));
            }
        }
    }
}

TEST_CASE("a prepared object says what memory it takes") {
    Random random{6};
    const auto few = samples(random, 4);
    const auto many = samples(random, 400);
    const Surface ground{0.28, 1.77};
    const auto bytes = [&](const auto& spectrum, double tolerance) {
        return HeTorranceSpectrum{ground, spectrum, Tolerance{tolerance}}.bytes();
    };
    CHECK(bytes(few, exact) < bytes(few, 1e-6));
    CHECK(bytes(few, 1e-6) < 1200);
    // six columns, and the samples themselves
    CHECK(bytes(many, 1e-6) - bytes(few, 1e-6) ==
          sizeof(double) * 6 * (400 - 8) + sizeof(SpectralSample) * 396);
}

TEST_CASE("a copy of a prepared object is one of its own") {
    Random random{7};
    const auto spectrum = samples(random, 5);
    HeTorranceSpectrum original{Surface{0.28, 1.77}, spectrum, Tolerance{1e-6}};
    const HeTorranceSpectrum copy{original};
    const DirectionPair p{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
    std::vector<double> expected(5);
    original.brdf(p, expected);
    original = HeTorranceSpectrum{Surface{0, 1}, spectrum, Tolerance{1e-6}};
    std::vector<double> f(5);
    copy.brdf(p, f);
    CHECK(same_bits(f, expected));
}

TEST_CASE("a result of another size is an error, and nothing is written") {
    const auto um = Wavelength::from_micrometres(0.5);
    const HeTorranceSpectrum prepared{
        {0.28, 1.77}, {{um, RefractiveIndex{0.8, 6}, 0}, {um, RefractiveIndex{0.8, 6}, 0}}, Tolerance{1e-6}};
    const auto in = Direction::from_degrees(30, 0), out = Direction::from_degrees(40, 180);
    const std::vector<DirectionPair> pairs(3, DirectionPair{in, out});
    for (const std::size_t size : {0U, 1U, 3U, 5U, 7U}) {
        std::vector<double> values(size, -1);
        std::vector<Mueller> matrices(size);
        CHECK_THROWS_AS(prepared.brdf({in, out}, values), hts::Error);
        CHECK_THROWS_AS(prepared.brdf(pairs, values), hts::Error);
        CHECK_THROWS_AS(prepared.specular_reflectance(in, values), hts::Error);
        CHECK_THROWS_AS(prepared.mueller({in, out}, matrices), hts::Error);
        CHECK(values == std::vector<double>(size, -1));
    }
    std::vector<double> values(2), all(6);
    prepared.brdf({in, out}, values);
    prepared.brdf(pairs, all);
    CHECK(all[5] == values[1]);
}
