// The lanes against the exact path of unified_terms.hpp, and that every valid input has a finite answer.
// HTS_EXHAUSTIVE=1 takes 10^7 points, otherwise 10^5.
#include "hts/unified/he_unified_spectrum.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "any_input.hpp"
#include "comparison.hpp"
#include "hts/unified/lanes/unified_simd.hpp"
#include "hts/unified/unified_mirror.hpp"

using hts::Direction;
using hts::DirectionPair;
using hts::HeUnifiedSpectrum;
using hts::Mueller;
using hts::RefractiveIndex;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::UnifiedChoices;
using hts::Wavelength;
using hts::testing::any_direction;
using hts::testing::any_index;
using hts::testing::any_pair;
using hts::testing::described;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

std::size_t points() {
    return hts::testing::exhaustive() ? 10'000'000 : 100'000;
}

std::vector<SpectralSample> samples(Random& random, std::size_t count, bool metals) {
    std::vector<SpectralSample> result;
    for (std::size_t i = 0; i < count; ++i) {
        const RefractiveIndex of =
            metals ? RefractiveIndex{random.uniform(0.1, 4), random.uniform(3.4, 12)} : any_index(random);
        result.push_back({Wavelength::from_micrometres(random.logarithmic(0.3, 13)), of, 0});
    }
    return result;
}

void compare(double tolerance, const std::optional<hts::Correlation>& shape = {}, bool two_lengths = false) {
    const std::string name = std::string{" of he_unified"} + (shape ? " of another correlation" : "") +
                             (two_lengths ? " and two lengths" : "") + " at " + std::to_string(tolerance);
    WorstCase brdf{"brdf" + name, tolerance};
    WorstCase matrices{"mueller" + name, tolerance};
    WorstCase mirrors{"specular reflectance" + name, hts::accuracy::unified_mirror_in_lanes};
    Random random{20261128};
    while (brdf.count() < points()) {
        const double sigma = random.logarithmic(1e-3, 16);
        const double tau = sigma / random.logarithmic(3e-3, 2);
        const Surface gaussian =
            two_lengths
                ? Surface::anisotropic(sigma, {tau, tau * random.logarithmic(0.1, 10)}, any_direction(random))
                : Surface{sigma, tau};
        const Surface ground = shape ? gaussian.correlated(*shape) : gaussian;
        const std::size_t count = 1 + brdf.count() % 20;
        const bool metals = random.uniform(0, 2) < 1;
        const auto spectrum = samples(random, count, metals);
        const UnifiedChoices choices{.polarisation_mixing = !shape && brdf.count() % 2 == 0,
                                     .conductor_shortcut = metals && brdf.count() % 3 == 0};
        const HeUnifiedSpectrum fast{ground, spectrum, Tolerance{tolerance}, hts::DiffuseLobe::full, choices};
        const HeUnifiedSpectrum slow{ground, spectrum, Tolerance{hts::accuracy::finest_tolerance},
                                     hts::DiffuseLobe::full, choices};
        std::vector<DirectionPair> pairs;
        for (int i = 0; i < 20; ++i) pairs.push_back(any_pair(random));
        std::vector<double> f(count), reference(count), batch(count * pairs.size()), mirror(count),
            reference_mirror(count);
        std::vector<Mueller> m(count), reference_m(count);
        fast.brdf(pairs, batch);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            fast.brdf(pairs[i], f);
            slow.brdf(pairs[i], reference);
            fast.mueller(pairs[i], m);
            slow.mueller(pairs[i], reference_m);
            fast.specular_reflectance(pairs[i].in, mirror);
            slow.specular_reflectance(pairs[i].in, reference_mirror);
            for (std::size_t j = 0; j < count; ++j) {
                const auto where = [&] { return described(pairs[i], ground, spectrum[j]); };
                if (!(std::isfinite(f[j]) && f[j] >= 0)) FAIL(f[j] << " at " << where());
                if (f[j] != batch[i * count + j]) FAIL("other bits in a batch at " << where());
                if (reference_mirror[j] > 1e-280)
                    mirrors.note(relative_error(mirror[j], reference_mirror[j]), where);
                else
                    CHECK(mirror[j] <= 1e-279);
                if (reference[j] < 1e-280) continue;
                brdf.note(relative_error(f[j], reference[j]), where);
                for (std::size_t e = 0; e < 16; ++e) {
                    const double error = std::abs(m[j].elements()[e] - reference_m[j].elements()[e]);
                    matrices.note(error / reference_m[j].elements()[0], where);
                }
            }
        }
    }
    brdf.check();
    matrices.check();
    mirrors.check();
}

double length(Random& random) {
    return random.uniform(0, 4) < 1 ? random.one_of({1e-24, 1e-12, 1e-3, 0.5, 1, 1e6, 1e24})
                                    : random.logarithmic(1e-24, 1e24);
}

double part_of_index(Random& random, double lowest) {
    return random.uniform(0, 4) < 1 ? random.one_of({lowest, 1, 1 + 1e-15, 1e24})
                                    : random.logarithmic(1e-24, 1e24);
}

}  // namespace

TEST_CASE("he_unified in lanes at 1e-6 is as exact as asked for") {
    compare(1e-6);
}

TEST_CASE("he_unified in lanes at 1e-3 is as exact as asked for") {
    compare(1e-3);
}

TEST_CASE("he_unified in lanes is as exact as asked for whatever the correlation") {
    compare(1e-6, hts::Correlation::exponential());
    compare(1e-6, hts::Correlation::matern(1.5));
    compare(1e-6, hts::Correlation::exponential(), true);
}

TEST_CASE("the table of the mean number of kicks joins the sums") {
    for (const double t : {0.1, 5.0, 40.0, 700.0}) {
        CHECK(hts::unified_detail::far_mean_kicks(3, t) ==
              Approx(hts::kicks(3, t).rest / hts::kicks(3, t).beta).epsilon(1e-12));
    }
    CHECK(hts::unified_detail::far_mean_kicks(3, 1e9) == 0);
    CHECK(hts::unified_detail::far_mean_kicks(0, 1) == 0);
}

TEST_CASE("every valid input of he_unified has a finite answer") {
    constexpr int pairs_of_a_wave = 10;  // to prepare a wave takes a hundred times as long as a pair
    const std::size_t blocks = points() / 1000;
    std::size_t failures = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : failures)
    for (std::size_t block = 0; block < blocks; ++block) {
        Random random{block};
        for (int i = 0; i < 1000 / pairs_of_a_wave; ++i) {
            const bool ordinary = random.uniform(0, 2) < 1;
            const double wavelength = ordinary ? random.logarithmic(0.3, 13) : length(random);
            const double sigma = ordinary                   ? random.logarithmic(1e-3, 16)
                                 : random.uniform(0, 8) < 1 ? 0
                                                            : length(random);
            const double tau = ordinary ? sigma / random.logarithmic(3e-3, 5) : length(random);
            const Surface surface{sigma, tau};
            const RefractiveIndex of{part_of_index(random, 1e-24), part_of_index(random, 0)};
            const hts::ReturnFactor m{surface.slope_width() / 2};
            const hts::UnifiedWave wave{surface, m, Wavelength::from_micrometres(wavelength), of};
            for (int j = 0; j < pairs_of_a_wave; ++j) {
                const DirectionPair p = any_pair(random);
                const auto lobe = unified_lobe({surface, m, p.in}, {surface, m, p.out}, wave);
                bool fine = std::isfinite(lobe.brdf()) && lobe.brdf() >= 0;
                const Mueller matrix = unified_mueller(lobe.jones, mixed_share(surface));
                for (const double e : matrix.elements()) fine = fine && std::isfinite(e);
                const double mirror = unified_mirror(p.in, wave).unpolarised_reflectance();
                fine = fine && mirror >= 0 && mirror <= 1 + 1e-12;
                if (!fine) {
#pragma omp critical
                    UNSCOPED_INFO(described(p, surface, {Wavelength::from_micrometres(wavelength), of, 0})
                                  << ", f " << lobe.brdf() << ", mirror " << mirror);
                    ++failures;
                }
            }
        }
    }
    CHECK(failures == 0);
}
