#include "hts/films/cosine_table.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/he_torrance_spectrum.hpp"
#include "hts/unified/he_unified_spectrum.hpp"

using hts::CoatedIndex;
using hts::CosineTable;
using hts::Direction;
using hts::Film;
using hts::FilmTable;
using hts::Mueller;
using hts::RefractiveIndex;
using hts::Tolerance;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

const auto green = Wavelength::from_micrometres(0.55);

CoatedIndex stack(Random& random) {
    std::vector<Film> films;
    const int count = 1 + static_cast<int>(random.uniform(0, 3));
    for (int i = 0; i < count; ++i)
        films.push_back(
            {{random.uniform(1.2, 3), random.one_of({0, 0, 1e-3, 0.1, 2})}, random.logarithmic(1e-3, 5)});
    const bool metal = random.uniform(0, 2) < 1;
    return {metal ? RefractiveIndex{random.uniform(0.05, 4), random.uniform(1, 10)}
                  : RefractiveIndex{random.uniform(1.1, 4), random.one_of({0, 1e-4, 0.1})},
            films, green};
}

std::string text(const CoatedIndex& of, double cosine) {
    return std::to_string(of.substrate().n()) + " + " + std::to_string(of.substrate().k()) +
           "i under films, cosine " + std::to_string(cosine);
}

/// HeTorranceSpectrum or HeUnifiedSpectrum in lanes against its exact path.
template <class Spectrum>
void compare(const std::string& name) {
    // the lanes' own 1e-6, and of dark films twice tabled_films over |F|
    WorstCase lobes{"lobes of " + name + " under films", 1e-6},
        mirrors{"mirrors of " + name + " under films", 1e-6},
        matrices{"matrices of " + name + " under films", 1e-6};
    Random random{42};
    for (int i = 0; i < 60; ++i) {
        std::vector<hts::SpectralSample> samples;
        const double diffuse = random.one_of({0, 0.05});
        for (int j = 0; j <= i % 9; ++j) samples.push_back({green, stack(random), diffuse});
        if (i % 5 == 0) samples.push_back({green, {1.5, 0}, diffuse});  // and one that is bare
        const hts::Surface surface{random.logarithmic(0.01, 2), random.logarithmic(0.5, 10)};
        const Spectrum lanes{surface, samples, Tolerance{1e-6}}, exact{surface, samples, Tolerance{1e-12}};
        std::vector<double> f(samples.size()), g(samples.size());
        std::vector<Mueller> m(samples.size()), n(samples.size());
        std::vector<hts::DirectionPair> pairs;
        for (int k = 0; k < 40; ++k)
            pairs.push_back({Direction::from_degrees(random.uniform(0, 89), random.uniform(-180, 180)),
                             Direction::from_degrees(random.uniform(0, 89), random.uniform(-180, 180))});
        std::vector<double> batch(samples.size() * pairs.size());
        lanes.brdf(pairs, batch);
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const double cosine = hts::wave_vector_change(pairs[k].in, pairs[k].out).cos_theta_d();
            lanes.brdf(pairs[k], f);
            exact.brdf(pairs[k], g);
            lanes.mueller(pairs[k], m);
            exact.mueller(pairs[k], n);
            for (std::size_t j = 0; j < samples.size(); ++j) {
                const auto where = [&] { return text(samples[j].index, cosine); };
                if (f[j] != batch[k * samples.size() + j]) FAIL("other bits in a batch at " << where());
                if (g[j] < 1e-280) continue;
                const double reflectance = samples[j].index.amplitudes(cosine).unpolarised_reflectance();
                const double dark = 1 + 2 * hts::accuracy::tabled_films / std::sqrt(reflectance) / 1e-6;
                lobes.note(hts::testing::relative_error(f[j], g[j]) / dark, where);
                for (std::size_t e = 0; e < 16; ++e)
                    matrices.note(std::abs(m[j].elements()[e] - n[j].elements()[e]) / g[j] / dark, where);
            }
            lanes.specular_reflectance(pairs[k].in, f);
            exact.specular_reflectance(pairs[k].in, g);
            for (std::size_t j = 0; j < samples.size(); ++j) {
                const double reflectance =
                    samples[j].index.amplitudes(pairs[k].in.cos_theta()).unpolarised_reflectance();
                const double dark = 1 + 2 * hts::accuracy::tabled_films / std::sqrt(reflectance) / 1e-6;
                if (g[j] > 1e-280)
                    mirrors.note(hts::testing::relative_error(f[j], g[j]) / dark,
                                 [&] { return text(samples[j].index, pairs[k].in.cos_theta()); });
            }
        }
    }
    lobes.check();
    matrices.check();
    mirrors.check();
}

}  // namespace

TEST_CASE("Films: amplitudes of tables are those of the matrices") {
    WorstCase worst{"amplitudes of films from tables", hts::accuracy::tabled_films};
    Random random{41};
    int tabled = 0;
    for (int i = 0; i < 200; ++i) {
        const CoatedIndex index = stack(random);
        const FilmTable table{index};
        tabled += table.tabled() ? 1 : 0;
        for (int j = 0; j < 200; ++j) {
            const double cosine =
                random.uniform(0, 4) < 1 ? random.logarithmic(1e-8, 1) : random.uniform(0, 1);
            const auto exact = index.amplitudes(cosine), found = table.amplitudes(cosine);
            worst.note(std::max(std::abs(exact.s - found.s), std::abs(exact.p - found.p)),
                       [&] { return text(index, cosine); });
        }
    }
    worst.check();
    CHECK(tabled >= 190);  // three films of 5 um and index 3 have more fringes
}

TEST_CASE("Films: what no table of bounded size holds is computed one by one") {
    const std::vector<Film> thick{{{1.5, 0}, 1000}}, thin{{{1.3, 0}, 0.05}};
    for (const CoatedIndex& index :
         {CoatedIndex{{2, 0}, thick, green}, CoatedIndex{{0.7, 0}, thin, green}}) {  // fringes, a kink
        const FilmTable table{index};
        CHECK_FALSE(table.tabled());
        for (const double cosine : {0.0, 0.3, 0.71, 1.0}) {
            CHECK(table.amplitudes(cosine).s == index.amplitudes(cosine).s);
            CHECK(table.amplitudes(cosine).p == index.amplitudes(cosine).p);
        }
    }
    const auto none = CosineTable::made(
        1, [](double cosine, std::span<double> value) { value[0] = std::abs(cosine - 0.3); }, 1e-10);
    CHECK_FALSE(none.has_value());
}

TEST_CASE("Films: lobes, mirrors and Mueller matrices in lanes are those of the exact path") {
    compare<hts::HeTorranceSpectrum>("he");
    compare<hts::HeUnifiedSpectrum>("he_unified");
}
