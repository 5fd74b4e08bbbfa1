#include "hts/films/coated_index.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "film_stacks.hpp"
#include "hts/error.hpp"
#include "hts/he_torrance_spectrum.hpp"
#include "hts/unified/he_unified_spectrum.hpp"

using Catch::Matchers::Contains;
using hts::CoatedIndex;
using hts::Direction;
using hts::Film;
using hts::fresnel;
using hts::FresnelAmplitudes;
using hts::RefractiveIndex;
using hts::Wavelength;
using hts::testing::least_root;
using hts::testing::one_um;
using hts::testing::Random;
using hts::testing::random_stack;
using hts::testing::Stack;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;
double largest_change(const FresnelAmplitudes& a, const FresnelAmplitudes& b) {
    return std::max(std::abs(a.s - b.s), std::abs(a.p - b.p));
}

}  // namespace

TEST_CASE("Films: amplitudes and transmittance against the product of matrices in 50 digits") {
    WorstCase amplitudes{"amplitudes of films", hts::accuracy::films};
    WorstCase transmittance{"transmittance of films", hts::accuracy::films};
    Random random{1};
    for (int i = 0; i < 4000; ++i) {
        const Stack stack = random_stack(random, i % 3 == 0);
        const CoatedIndex index = stack.index();
        const hts::testing::films::Answer expected = hts::testing::films::answer(stack);
        const double scale = stack.thickness() / std::min(1.0, least_root(stack));
        const FresnelAmplitudes f = index.amplitudes(stack.cos_theta);
        amplitudes.note(std::max(hts::testing::films::distance(f.s, expected.s),
                                 hts::testing::films::distance(f.p, expected.p)) /
                            scale,
                        [&] { return stack.text(); });
        transmittance.note(
            std::abs(index.transmittance(stack.cos_theta) - static_cast<double>(expected.transmitted)) /
                scale,
            [&] { return stack.text(); });
    }
    amplitudes.check();
    transmittance.check();
}

TEST_CASE("Films: none, and none of any thickness, are Fresnel's amplitudes to the bit") {
    Random random{2};
    for (int i = 0; i < 200; ++i) {
        const Stack stack = random_stack(random, false);
        const FresnelAmplitudes bare = fresnel(stack.cos_theta, stack.substrate);
        for (const CoatedIndex& index :
             {CoatedIndex{stack.substrate}, CoatedIndex{stack.substrate, {}, one_um},
              CoatedIndex{stack.substrate, std::vector<Film>{{{2, 1}, 0}, {{3, 0}, 0}}, one_um}}) {
            CHECK_FALSE(index.coated());
            CHECK(index.amplitudes(stack.cos_theta).s == bare.s);
            CHECK(index.amplitudes(stack.cos_theta).p == bare.p);
        }
        const CoatedIndex thin{stack.substrate, std::vector<Film>{{{2, 1}, 1e-18}}, one_um};
        CHECK(largest_change(thin.amplitudes(stack.cos_theta), bare) < 1e-12 / least_root(stack));
    }
}

TEST_CASE("Films: a quarter of a wavelength, a half, and a film of the substrate's or of no substance") {
    const RefractiveIndex glass{1.52, 0};
    const auto coated = [&](double n, double thickness) {
        return CoatedIndex{glass, std::vector<Film>{{{n, 0}, thickness}}, one_um};
    };
    for (const double n : {1.1, 1.2328828005937953, 1.38, 2.35}) {
        const double quarter = std::pow((1.52 - n * n) / (1.52 + n * n), 2);
        CHECK(std::abs(coated(n, 0.25 / n).amplitudes(1).unpolarised_reflectance() - quarter) < 1e-15);
        CHECK(largest_change(coated(n, 0.5 / n).amplitudes(1), fresnel(1, glass)) < 2e-15);
    }
    for (const double c : {1.0, 0.7, 0.2, 0.01}) {
        CHECK(largest_change(coated(1.52, 3.7).amplitudes(c), fresnel(c, glass)) < 1e-13);
        const FresnelAmplitudes vacuum = coated(1, 3.7).amplitudes(c), bare = fresnel(c, glass);
        const auto phase = std::polar(1.0, 2 * one_um.wave_number() * 3.7 * c);
        CHECK(largest_change(vacuum, {phase * bare.s, phase * bare.p}) < 1e-13);
    }
}

TEST_CASE("Films: an absorbing film that is thick is its own bulk, and nothing overflows") {
    const RefractiveIndex gold{0.18, 3.43};
    for (const double thickness : {3.0, 30.0, 1000.0}) {
        const CoatedIndex index{{1.5, 0}, std::vector<Film>{{gold, thickness}, {{1.3, 0}, 0.2}}, one_um};
        for (const double c : {1.0, 0.5, 1e-3}) {
            CHECK(largest_change(index.amplitudes(c), fresnel(c, gold)) < 1e-14);
            CHECK(index.transmittance(c) >= 0);
            CHECK(index.transmittance(c) < 1e-40);
        }
    }
    const CoatedIndex extreme{
        {1e20, 1e20}, std::vector<Film>(CoatedIndex::most_films, Film{{1e24, 1e24}, 1000}), one_um};
    CHECK(extreme.amplitudes(0.3).unpolarised_reflectance() == Approx(1));
}

TEST_CASE("Films: light tunnels through a gap, and a wide gap reflects all") {
    // from glass across vacuum into glass, beyond the critical angle: s by the formula of the square barrier
    const double n = 1.5, sine = 0.8, c = 0.6, inside = std::sqrt(n * n * sine * sine - 1) / n;
    for (const double gap : {0.01, 0.1, 0.5, 2.0}) {
        const CoatedIndex seen = CoatedIndex{{n, 0}, std::vector<Film>{{{1, 0}, gap}}, one_um}.seen_from(n);
        const FresnelAmplitudes f = seen.amplitudes(c);
        const double x = one_um.wave_number() * n * gap * inside;
        const double barrier = (c * c + inside * inside) / (2 * c * inside) * std::sinh(x);
        CHECK(1 - std::norm(f.s) == Approx(1 / (1 + barrier * barrier)).epsilon(1e-12).margin(1e-15));
        CHECK(f.unpolarised_reflectance() + seen.transmittance(c) == Approx(1).epsilon(1e-14));
    }
    const CoatedIndex wide = CoatedIndex{{n, 0}, std::vector<Film>{{{1, 0}, 50}}, one_um}.seen_from(n);
    CHECK(std::abs(wide.amplitudes(c).s) == Approx(1).epsilon(1e-14));
    CHECK(std::abs(wide.amplitudes(c).p) == Approx(1).epsilon(1e-14));
}

TEST_CASE("Films: energy, from both sides") {
    WorstCase lossless{"R + T - 1 of films that do not absorb", 3e-14};
    WorstCase turned{"R and T from both sides", 1.6e-15};
    Random random{3};
    for (int i = 0; i < 2000; ++i) {
        const Stack stack = random_stack(random, true, 2);
        const CoatedIndex index = stack.index();
        const double c = stack.cos_theta, r = index.amplitudes(c).unpolarised_reflectance();
        const double scale = stack.thickness() / std::min(1.0, least_root(stack));
        lossless.note(std::abs(r + index.transmittance(c) - 1) / scale, [&] { return stack.text(); });
        const double sine = std::sqrt(1 - c * c) / stack.substrate.n();
        if (sine < 1) {  // the same ray, backwards, whose angle the last bit of the substrate's index moves
            const CoatedIndex back = index.turned_over();
            const double c_back = std::sqrt((1 - sine) * (1 + sine));
            turned.note(std::max(std::abs(back.transmittance(c_back) - index.transmittance(c)),
                                 std::abs(back.amplitudes(c_back).unpolarised_reflectance() - r)) /
                            scale * std::pow(c / std::max(1.0, stack.substrate.n()), 2),
                        [&] { return stack.text(); });
        }
        const Stack absorbing = random_stack(random, false);
        const FresnelAmplitudes f = absorbing.index().amplitudes(absorbing.cos_theta);
        const double t = absorbing.index().transmittance(absorbing.cos_theta);
        INFO(absorbing.text());
        CHECK(std::abs(f.s) <= 1 + 1e-13);
        CHECK(std::abs(f.p) <= 1 + 1e-13);
        CHECK(t >= 0);
        CHECK(f.unpolarised_reflectance() + t <= 1 + 1e-11);
    }
    lossless.check();
    turned.check();
}

TEST_CASE("Films: every amplitude is a number at every angle") {
    Random random{4};
    for (int i = 0; i < 2000; ++i) {
        Stack stack = random_stack(random, i % 2 == 0, 1000);
        if (i % 5 == 0) stack.films.push_back({{1, 0}, 1});
        if (i % 7 == 0) stack.substrate = {1, 0};
        for (const double c : {0.0, std::numeric_limits<double>::min(), 1e-9, stack.cos_theta, 1.0}) {
            const FresnelAmplitudes f = stack.index().amplitudes(c);
            INFO(stack.text());
            CHECK(std::norm(f.s) <= 1 + 1e-9);
            CHECK(std::norm(f.p) <= 1 + 1e-9);
        }
    }
}

TEST_CASE("Films: the lobe and the mirror of a rough surface") {
    const hts::Surface surface{0.1, 1.2};
    std::vector<hts::SpectralSample> bare, coated;
    const std::vector<Film> films{{{1.38, 0}, 0.1}, {{2.3, 0.01}, 0.06}};
    for (const double um : {0.4, 0.5, 0.6, 0.7, 0.8}) {
        const auto wavelength = Wavelength::from_micrometres(um);
        bare.push_back({wavelength, {0.8, 5}, 0.02});
        coated.push_back({wavelength, {{0.8, 5}, films, wavelength}, 0.02});
    }
    const hts::HeTorranceSpectrum exact{surface, coated, hts::Tolerance{1e-12}}, quick{surface, coated};
    WorstCase lanes{"lobe under films in lanes", 1e-6};
    Random random{5};
    std::vector<hts::DirectionPair> pairs;
    for (int i = 0; i < 300; ++i) pairs.push_back({random.direction(1e-4), random.direction(1e-4)});
    std::vector<double> batch(pairs.size() * coated.size());
    quick.brdf(pairs, batch);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::vector<double> slow(coated.size()), alone(coated.size());
        std::vector<hts::Mueller> matrices(coated.size());
        exact.brdf(pairs[i], slow);
        quick.brdf(pairs[i], alone);
        quick.mueller(pairs[i], matrices);
        const hts::PairFactors factors{surface, pairs[i].in, pairs[i].out};
        for (std::size_t j = 0; j < coated.size(); ++j) {
            const auto& sample = coated[j];
            lanes.note(hts::testing::relative_error(alone[j], slow[j]), [&] { return std::to_string(i); });
            CHECK(batch[i * coated.size() + j] == alone[j]);
            lanes.note(hts::testing::relative_error(matrices[j](0, 0), slow[j]),
                       [&] { return std::to_string(i) + ", Mueller"; });
            // by definition: the lobe of perfect mirrors times what the stack reflects at theta_d
            const auto term = hts::directional_diffuse(factors, sample.wavelength, bare[j].index);
            CHECK(slow[j] ==
                  Approx(0.02 +
                         term.lobe * sample.index.amplitudes(factors.cos_theta_d()).unpolarised_reflectance())
                      .epsilon(1e-11));
        }
    }
    const Direction in = Direction::from_degrees(50, 20);
    std::vector<double> mirror(coated.size()), quick_mirror(coated.size());
    std::vector<hts::Mueller> matrices(coated.size());
    exact.specular_reflectance(in, mirror);
    quick.specular_reflectance(in, quick_mirror);
    quick.specular_mueller(in, matrices);
    for (std::size_t j = 0; j < coated.size(); ++j) {
        const auto f = coated[j].index.amplitudes(in.cos_theta());
        const double left = hts::coherent_fraction(surface, view(surface, in), coated[j].wavelength);
        lanes.note(hts::testing::relative_error(quick_mirror[j], mirror[j]), [] { return "mirror"; });
        CHECK(mirror[j] == Approx(f.unpolarised_reflectance() * left).epsilon(1e-12));
        CHECK(matrices[j](0, 1) == Approx((std::norm(f.s) - std::norm(f.p)) / 2 * left).margin(1e-15));
        CHECK(matrices[j](2, 2) == Approx((f.s * std::conj(f.p)).real() * left).margin(1e-15));
    }
    lanes.check();
}

TEST_CASE("Films: stacks that cannot be are refused by name") {
    const auto of = [](std::vector<Film> films) { return CoatedIndex{{1.5, 0}, films, one_um}; };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(of({{{2, 0}, -0.1}}), Contains("film thickness -0.1 um: must be from 0 to 1000"));
    CHECK_THROWS_WITH(of({{{2, 0}, nan}}), Contains("film thickness"));
    CHECK_THROWS_WITH(of({{{2, 0}, 1001}}), Contains("film thickness 1001 um"));
    CHECK_THROWS_WITH(of(std::vector<Film>(101, {{2, 0}, 0.1})),
                      Contains("101 of them: must be at most 100"));
    CHECK_NOTHROW(of(std::vector<Film>(100, {{2, 0}, 0.1})));
    const hts::SpectralSample sample{one_um, of({{{2, 0}, 0.1}}), 0};
    const hts::UnifiedChoices second{.mirror = hts::UnifiedChoices::Mirror::second_order};
    const hts::UnifiedChoices mixed{.polarisation_mixing = true};
    CHECK_THROWS_WITH((hts::HeUnifiedSpectrum{{0.1, 1}, {sample}, {}, hts::DiffuseLobe::full, second}),
                      Contains("mirror second_order: must be closed where there are films"));
    CHECK_THROWS_WITH((hts::HeUnifiedSpectrum{{0.1, 1}, {sample}, {}, hts::DiffuseLobe::full, mixed}),
                      Contains("polarisation_mixing"));
}
