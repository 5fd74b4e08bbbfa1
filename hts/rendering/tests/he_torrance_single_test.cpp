// Single precision against the exact path of terms.hpp. HTS_EXHAUSTIVE=1 takes 10^7 points, otherwise 10^6.
#include "hts/rendering/he_torrance_single.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::HeTorranceRendering;
using hts::HeTorranceSingle;
using hts::HeTorranceSpectrum;
using hts::RefractiveIndex;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Vector3f;
using hts::VectorPair;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

Vector3f rounded(hts::Vector3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Direction exactly(const Vector3f& v) {
    return Direction::from_unit_vector({v.x, v.y, v.z});
}

/// How much of ln f lies in the rounding of the vectors' lengths: Phi falls with t no faster than exp(-t).
double by_length(const VectorPair& p, const Surface& s, Wavelength wavelength) {
    const auto [along, across] = s.correlation_lengths();
    const double per_length = std::numbers::pi / wavelength.micrometres();
    const double root_t =
        per_length * s.correlation_length() * hts::stretched_horizontal(s, exactly(p.in), exactly(p.out));
    return 2e-7 * root_t * per_length * std::max(along, across);
}

/// Often near the mirror direction, backscatter or the horizon.
VectorPair pair(Random& random) {
    const auto any = [&random] {
        if (random.uniform() < 0.2)
            return Direction::from_degrees(90 - random.logarithmic(1e-5, 10), 360 * random.uniform());
        return random.direction(1e-4);
    };
    const Direction in = any();
    const double pick = random.uniform();
    if (pick < 0.1) return {rounded(in.vector()), rounded(in.mirror().vector())};
    if (pick < 0.2) return {rounded(in.vector()), rounded(in.vector())};
    if (pick < 0.5) {
        const hts::Vector3 near = in.mirror().vector();
        const double step = random.logarithmic(1e-7, 0.3);
        return {
            rounded(in.vector()),
            rounded(Direction::from_vector({near.x + step, near.y - step / 3, near.z + step / 2}).vector())};
    }
    return {rounded(in.vector()), rounded(any().vector())};
}

Surface surface(Random& random, bool isotropic) {
    const double sigma = random.logarithmic(1e-3, 16);
    const double tau = sigma / random.logarithmic(3e-3, 2);
    if (isotropic) return {sigma, tau};
    return Surface::anisotropic(sigma, {tau, tau * random.logarithmic(0.1, 10)},
                                Direction::from_degrees(90, 180 * random.uniform()));
}

std::vector<SpectralSample> samples(Random& random, std::size_t count) {
    std::vector<SpectralSample> result;
    for (std::size_t i = 0; i < count; ++i) {
        const RefractiveIndex index{random.logarithmic(0.02, 20), random.logarithmic(1e-3, 50)};
        result.push_back(
            {Wavelength::from_micrometres(random.logarithmic(0.3, 13)), index, i % 2 == 0 ? 0.1 : 0});
    }
    return result;
}

std::string describe(const VectorPair& p, const Surface& s, const SpectralSample& sample) {
    std::ostringstream text;
    text.precision(9);
    text << "in (" << p.in.x << ", " << p.in.y << ", " << p.in.z << "), out (" << p.out.x << ", " << p.out.y
         << ", " << p.out.z << "), sigma0 " << s.rms_roughness() << ", tau " << s.correlation_lengths().along
         << " along " << s.azimuth() << " and " << s.correlation_lengths().across << " across, lambda "
         << sample.wavelength.micrometres() << ", N " << sample.index.substrate().n() << " + "
         << sample.index.substrate().k() << 'i';
    return text.str();
}

HeTorranceRendering aluminium() {
    std::vector<SpectralSample> metal;
    for (int i = 0; i < 6; ++i)
        metal.push_back(
            {Wavelength::from_micrometres(0.42 + 0.05 * i), RefractiveIndex{0.6 + 0.1 * i, 5.5}, 0.02});
    return {Surface{0.28, 1.77}, metal};
}

}  // namespace

TEST_CASE("single precision keeps its contract, and the same bits in any batch") {
    WorstCase worst{"brdf in single precision", hts::accuracy::single_precision_brdf};
    Random random{20261128};
    const std::size_t points = hts::testing::exhaustive() ? 10'000'000 : 1'000'000;
    constexpr std::size_t count = 10;
    for (std::size_t round = 0; worst.count() < points; ++round) {
        const Surface ground = surface(random, round % 4 != 0);
        const auto spectrum = samples(random, count);
        const HeTorranceSpectrum exact{ground, spectrum, Tolerance{hts::accuracy::finest_tolerance}};
        // the first are evaluated four at a time, which a single vector holds
        const std::size_t taken = round % 2 == 0 ? count : 4;
        const HeTorranceSingle single{ground, {spectrum.begin(), spectrum.begin() + static_cast<int>(taken)}};
        std::vector<VectorPair> pairs;
        for (int i = 0; i < 2000; ++i) pairs.push_back(pair(random));
        std::vector<float> batch(pairs.size() * taken), alone(pairs.size() * taken);
        std::vector<double> reference(count);
        const std::size_t first = round % 70;
        single.brdf(std::span{pairs}.subspan(first), std::span{batch}.subspan(first * taken));
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const auto f = std::span{alone}.subspan(i * taken, taken);
            single.brdf(pairs[i].in, pairs[i].out, f);
            exact.brdf({exactly(pairs[i].in), exactly(pairs[i].out)}, reference);
            for (std::size_t j = 0; j < taken; ++j) {
                const auto where = [&] { return describe(pairs[i], ground, spectrum[j]); };
                if (!(std::isfinite(f[j]) && f[j] >= 0)) FAIL(f[j] << " at " << where());
                const double e = reference[j];
                const double scale = std::max(e, hts::accuracy::single_precision_floor);
                const double error = std::abs(double{f[j]} - e) / scale;
                const double allowed = by_length(pairs[i], ground, spectrum[j].wavelength);
                worst.note(error - std::min(error, allowed), where);
            }
        }
        CHECK(std::memcmp(batch.data() + first * taken, alone.data() + first * taken,
                          (pairs.size() - first) * taken * sizeof(float)) == 0);
    }
    worst.check();
}

TEST_CASE("what single precision does not hold is rounded from double") {
    const auto um = Wavelength::from_micrometres(0.5);
    const Vector3f in{0.6F, 0, 0.8F}, out{-0.6F, 0, 0.8F}, grazing{1, 0, 1e-7F};
    for (const Surface& ground : {Surface{0.28, 2e4}, Surface{1e-4, 1.0}, Surface{0.28, 1.77}}) {
        const std::vector<SpectralSample> spectrum{{um, RefractiveIndex{1.5, 0}, 0.1},
                                                   {um, RefractiveIndex{0.5, 0}, 0}};
        const HeTorranceSingle single{ground, spectrum};
        const HeTorranceSpectrum exact{ground, spectrum, Tolerance{}};
        for (const Vector3f& view : {out, grazing}) {
            std::vector<float> f(2);
            std::vector<double> reference(2);
            single.brdf(in, view, f);
            exact.brdf({exactly(in), exactly(view)}, reference);
            for (std::size_t j = 0; j < 2; ++j) CHECK(relative_error(f[j], reference[j]) < 1e-6);
        }
    }
}

TEST_CASE("single precision is 0 below the horizon") {
    const HeTorranceRendering metal = aluminium();
    const Vector3f up{0.6F, 0, 0.8F}, level{1, 0, 0}, down{0.6F, 0, -0.8F};
    std::vector<float> f(metal.size(), -1);
    for (const auto& [in, out] : {VectorPair{up, level}, {level, up}, {up, down}, {down, up}, {down, down}}) {
        CHECK(metal.brdf_and_pdf(in, out, f) == 0);
        for (const float value : f) CHECK(value == 0);
    }
    CHECK(metal.sample(down, {0.5F, 0.5F, 0.5F, 0.5F}, f).lobe == hts::Lobe::none);
    CHECK_THROWS_AS(metal.brdf(up, up, std::span{f}.first(2)), hts::Error);
    CHECK_THROWS_AS(metal.brdf(std::vector<VectorPair>(3), f), hts::Error);
}

TEST_CASE("draws in single precision have the density they state, and their weights the albedo") {
    const HeTorranceRendering metal = aluminium();
    Random random{3};
    for (const double degrees : {10.0, 60.0, 80.0}) {
        const Vector3f in = rounded(Direction::from_degrees(degrees, 30).vector());
        std::vector<float> f(metal.size()), again(metal.size());
        constexpr int draws = 100000;
        double drawn_sum = 0, uniform_sum = 0, squares = 0, total_density = 0, mirror = 0;
        WorstCase density{"density of a draw", 2.5e-5};
        for (int i = 0; i < draws; ++i) {
            const std::array<float, 4> u{static_cast<float>(random.uniform(0, 0.9999999)),
                                         static_cast<float>(random.uniform(0, 0.9999999)),
                                         static_cast<float>(random.uniform(0, 0.9999999)),
                                         static_cast<float>(random.uniform(0, 0.9999999))};
            const auto drawn = metal.sample(in, u, f);
            if (drawn.lobe == hts::Lobe::specular) {
                mirror += 1.0 / draws;
                CHECK(drawn.pdf == Approx(metal.specular_probability(in)));
            } else if (drawn.pdf > 0) {
                const double weight = f[2] * drawn.out.z / drawn.pdf;
                drawn_sum += weight / draws;
                squares += weight * weight / draws;
                const float pdf = metal.brdf_and_pdf(in, drawn.out, again);
                density.note(relative_error(drawn.pdf, pdf), [&] { return "draw " + std::to_string(i); });
                CHECK(std::memcmp(f.data(), again.data(), f.size() * sizeof(float)) == 0);
            }
            const auto any = rounded(random.direction().vector());
            total_density += 2 * 3.14159265358979 * metal.brdf_and_pdf(in, any, again) / draws;
            uniform_sum += 2 * 3.14159265358979 * again[2] * any.z / draws;
        }
        density.check();
        INFO(degrees << " degrees: " << drawn_sum << " by draws, " << uniform_sum
                     << " by uniform directions");
        CHECK(mirror == Approx(metal.specular_probability(in)).margin(0.006));
        CHECK(total_density + mirror <= 1.03);
        CHECK(drawn_sum == Approx(uniform_sum).epsilon(0.05));
        CHECK(std::sqrt(squares - drawn_sum * drawn_sum) < 2 * drawn_sum);
    }
}
