// The sampler against its density and against the model, by quadrature of both. HTS_EXHAUSTIVE=1 takes every
// case with 10^6 draws, a few minutes; otherwise every seventh with 4 10^4.
#include "hts/he_torrance.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chi_squared.hpp"
#include "comparison.hpp"
#include "hts/unified/he_unified.hpp"

using hts::Direction;
using hts::HeTorrance;
using hts::HeUnified;
using hts::Lobe;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Wavelength;
using hts::testing::Angles;
using hts::testing::Draw;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;

/// A surface at 0.5 um, lit from an angle.
struct Case {
    double roughness_over_wavelength, slope, theta;
    hts::RefractiveIndex index;
    double albedo;

    [[nodiscard]] Surface surface() const {
        const double sigma = 0.5 * roughness_over_wavelength;
        return {sigma, sigma / slope};
    }
    [[nodiscard]] SpectralSample sample() const {
        return {Wavelength::from_micrometres(0.5), index, hts::uniform_diffuse(albedo)};
    }
    template <class Model>
    [[nodiscard]] Model sampler() const {
        return {surface(), sample(), Tolerance{1e-6}};
    }
    [[nodiscard]] Direction in() const { return Direction::from_degrees(theta, 20); }
    [[nodiscard]] std::string text() const {
        std::ostringstream text;
        text << "sigma0/lambda " << roughness_over_wavelength << ", sigma0/tau " << slope << ", theta_i "
             << theta << ", N " << index.n() << " + " << index.k() << "i, albedo " << albedo;
        return text.str();
    }
};

/// 210 cases, sigma0/lambda 0.02 ... 5, sigma0/tau 0.005 ... 1, 0 ... 89 deg, a metal, a
/// glass and a glass over white.
const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        const std::array<hts::RefractiveIndex, 3> index{{{0.77, 6.08}, {1.5, 0}, {1.5, 0}}};
        std::vector<Case> result;
        for (const double slope : {0.005, 0.02, 0.1, 0.25, 1.0}) {
            for (const double roughness : {0.02, 0.05, 0.1, 0.3, 1.0, 5.0}) {
                for (const double theta : {0.0, 30.0, 45.0, 60.0, 75.0, 80.0, 89.0}) {
                    const std::size_t material = result.size() % index.size();
                    result.push_back({roughness, slope, theta, index[material], material == 2 ? 0.3 : 0.0});
                }
            }
        }
        return result;
    }();
    return all;
}

std::size_t stride() {
    return hts::testing::exhaustive() ? 1 : 11;
}

std::size_t draws() {
    return hts::testing::exhaustive() ? 1'000'000 : 40'000;
}

/// Reflectance of the directional-diffuse term by adaptive quadrature of the exact BRDF, finer about the
/// mirror direction.
template <class Model>
double reflectance_by_quadrature(const Case& c) {
    const Surface surface = c.surface();
    const Direction in = Direction::from_degrees(c.theta, 0);
    const SpectralSample sample{c.sample().wavelength, c.index, 0};
    const std::decay_t<decltype(std::declval<Model>().spectrum())> exact{
        surface, {sample}, Tolerance{hts::accuracy::finest_tolerance}};
    const auto reflected = [&](double theta, double from_mirror) {
        const Direction out = Direction::from_angles(theta, pi + from_mirror);
        double value = 0;
        exact.brdf({in, out}, {&value, 1});
        return value * std::cos(theta);
    };
    const double width = std::min(0.5, surface.slope_width() + 0.2 * c.slope / c.roughness_over_wavelength);
    const double mirror = std::acos(in.cos_theta());
    const hts::testing::Peak peak{mirror, 0, width, width / std::max(0.1, in.sin_theta())};
    return 2 * hts::testing::integral(reflected, {0, pi / 2, 0, pi}, peak, 1e-6);
}

/// Sums over draws from a sampler.
struct Tally {
    double sum = 0, squares = 0, most = 0;
    std::size_t none = 0, diffuse = 0, count = 0;

    void add(double weight) {
        sum += weight;
        squares += weight * weight;
        most = std::max(most, weight);
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    [[nodiscard]] double deviation() const {
        return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean() * mean()));
    }
};

/// Polar angle and azimuth of a draw, from -pi to pi about the mirror's.
Angles angles(const Direction& in, const Direction& out) {
    const Direction mirror = in.mirror();
    const double x = out.cos_phi() * mirror.cos_phi() + out.sin_phi() * mirror.sin_phi();
    const double y = out.sin_phi() * mirror.cos_phi() - out.cos_phi() * mirror.sin_phi();
    return {std::atan2(out.sin_theta(), out.cos_theta()), std::atan2(y, x)};
}

}  // namespace

TEMPLATE_TEST_CASE("draws fall as their density says, and density, specular and none make 1", "", HeTorrance,
                   HeUnified) {
    const double significance = 0.01;
    std::size_t tests = 0;
    double least = 1;
    WorstCase sums{"density, specular and none, from 1, in standard errors", 4.5};
    for (std::size_t k = 0; k < cases().size(); k += stride()) {
        const Case& c = cases()[k];
        const auto sampler = c.sampler<TestType>();
        const Direction in = c.in();
        Random random{1000 + k};
        const auto draw = [&]() -> Draw {
            const auto drawn = sampler.draw(in, random.uniforms());
            if (drawn.lobe == Lobe::none || drawn.lobe == Lobe::specular)
                return {{}, drawn.lobe == Lobe::specular};
            return {angles(in, drawn.out)};
        };
        const double mirror = std::atan2(in.mirror().sin_phi(), in.mirror().cos_phi());
        const auto density = [&](double theta, double phi) {
            return theta < pi / 2 ? sampler.pdf(in, Direction::from_angles(theta, mirror + phi)) : 0;
        };
        const auto fit = hts::testing::fit_of(draw, density, draws(), sampler.specular_probability(in));
        const double p = fit.p_value;
        if (p < least) least = p;
        ++tests;
        INFO(c.text() << ", total " << fit.total << ", none " << fit.none);
        CHECK(p > 1 - std::pow(1 - significance,
                               static_cast<double>(stride()) / static_cast<double>(cases().size())));
        sums.note(fit.deviation_of_sum(draws()), [&] { return c.text(); });
    }
    std::cout << "sampler: least p " << least << " of " << tests << " chi-squared tests\n";
    sums.check();
}

TEMPLATE_TEST_CASE("the mean weight is the reflectance, and weights stay near it", "", HeTorrance,
                   HeUnified) {
    WorstCase means{"mean weight from the reflectance, in standard errors", 4};
    WorstCase to_45{"relative deviation of weights to 45 deg, sigma0/tau <= 0.25", 0.3};
    WorstCase at_60{"the same at 60 deg", 1};
    WorstCase to_80{"the same at 75 and 80 deg", 1.5};
    WorstCase beyond{"the same at 89 deg", 2.5};
    WorstCase steep{"the same for sigma0/tau = 1", 2.5};
    WorstCase most{"greatest weight over the mean", 20};
    WorstCase none{"share of draws that are none", 0.1};
    for (std::size_t k = 0; k < cases().size(); k += stride()) {
        const Case& c = cases()[k];
        const auto where = [&] { return c.text(); };
        const auto sampler = c.sampler<TestType>();
        const Direction in = c.in();
        Random random{5000 + k};
        Tally all;
        Tally lobe;  // all but the specular draws
        for (std::size_t i = 0; i < draws(); ++i) {
            const auto drawn = sampler.sample(in, random.uniforms());
            all.add(drawn.weight);
            if (drawn.lobe != Lobe::specular) lobe.add(drawn.weight);
            if (drawn.lobe == Lobe::none) ++lobe.none;
        }
        const double specular = sampler.specular_reflectance(in).value();
        const double reflectance = specular + reflectance_by_quadrature<TestType>(c) + c.albedo;
        const double error = all.deviation() / std::sqrt(static_cast<double>(draws())) + 1e-5 * reflectance;
        means.note(std::abs(all.mean() - reflectance) / error, where);
        if (lobe.count < draws() / 100) continue;
        const double relative = lobe.deviation() / lobe.mean();
        WorstCase& bound = c.slope > 0.25  ? steep
                           : c.theta <= 45 ? to_45
                           : c.theta <= 60 ? at_60
                           : c.theta <= 80 ? to_80
                                           : beyond;
        if (c.albedo == 0) bound.note(relative, where);
        most.note(lobe.most / lobe.mean(), where);
        none.note(static_cast<double>(lobe.none) / static_cast<double>(lobe.count), where);
    }
    means.check();
    to_45.check();
    at_60.check();
    to_80.check();
    if (beyond.count() > 0) beyond.check();  // where the mirror does not take nearly all
    steep.check();
    most.check();
    none.check();
}
