#include "validation/topography/surface_study.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <string>

#include "spectral/parallel.hpp"
#include "synthetic_map.hpp"
#include "validation/topography/surface_report.hpp"

using namespace hts::validation;

namespace {

/// What is done to a surface before it is measured.
struct Flaws {
    double noise = 0;  // rms [um]
    double tilt = 0;   // slope
    double bow = 0;    // height of a paraboloid at the rim [um]
    double gaps = 0;   // share of the field, in round holes
    int outliers = 0;  // spikes
};

std::vector<double> measured(std::vector<double> heights, const SyntheticSurface& surface, const Flaws& flaws,
                             std::uint64_t seed) {
    hts::Random random{seed};
    const std::size_t n = surface.side();
    const auto side = static_cast<double>(n);
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const double x = static_cast<double>(i) / side - 0.5, y = static_cast<double>(j) / side - 0.5;
            double& z = heights[j * n + i];
            z += flaws.tilt * side * surface.step() * (x - 0.5 * y) +
                 4 * flaws.bow * (x * x + 0.5 * y * y + 0.3 * x * y);
            if (flaws.noise > 0) z += flaws.noise * SyntheticSurface::normal_pair(random).real();
        }
    }
    for (int k = 0; k < flaws.outliers; ++k)
        heights[random.bits() % heights.size()] += random.uniform(5, 50) * (random.uniform() < 0.5 ? -1 : 1);
    constexpr double radius = 6;
    const auto holes = static_cast<int>(flaws.gaps * side * side / (std::numbers::pi * radius * radius));
    for (int k = 0; k < holes; ++k) {
        const double x = random.uniform(0, side), y = random.uniform(0, side);
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                if (std::hypot(static_cast<double>(i) - x, static_cast<double>(j) - y) < radius)
                    heights[j * n + i] = std::nan("");
            }
        }
    }
    return heights;
}

struct Case {
    std::string title;
    std::string model;
    RoughnessScales scales;
    Ellipse ellipse{};
    Flaws flaws{};
    Level level = Level::plane;
    Gaps gaps = Gaps::fill;
};

constexpr double rms = 0.4, step = 0.25;

/// What a case must give back, by the names of values.
std::map<std::string, double> truth(const Case& wanted) {
    std::map<std::string, double> values{{"rms_um", rms}, {"free_rms_um", rms}};
    for (const RoughnessModel& model : roughness_models()) {
        if (model.name != wanted.model) continue;
        for (const RoughnessValue& value : model.values(wanted.scales)) values[value.name] = value.value;
    }
    if (wanted.flaws.noise > 0) values["noise_rms_um"] = wanted.flaws.noise;
    if (wanted.ellipse.ratio > 1)
        values["ratio"] = wanted.ellipse.ratio, values["azimuth"] = wanted.ellipse.azimuth;
    return values;
}

/// Integral of the spectrum that was fitted, and its noise, over the frequencies of a map, by quadrature.
double rms_by_quadrature(const SpectrumFit& fit, double first) {
    double variance = std::pow(fit.value("noise_rms_um").value, 2);
    constexpr int parts = 4000;
    const double width = std::log(1e4) / parts;
    for (int k = 0; k < parts; ++k) {
        const double f = first * std::exp(width * (k + 0.5));
        variance += fit.power(f) * 2 * std::numbers::pi * f * f * width;
    }
    return std::sqrt(variance);
}

/// What one map gave back: deviations from the truth in stated errors, and errors over values.
struct Found {
    std::map<std::string, std::pair<double, double>> values;
    bool named = false;
    double rms_apart = 0;   // greatest relative difference from the heights' of what is held to it
    double free_apart = 0;  // that of the fitted spectrum, its amplitude left free
};

Found found_in(const HeightMap& map, const Case& wanted, const std::map<std::string, double>& expected) {
    const SurfaceStudy study = studied({map}, {{wanted.level, wanted.gaps, 8}});
    const auto& fit = fit_named(study, wanted.model);
    Found found;
    found.named = best(study.fits).model == wanted.model;
    const double rms_of_heights = study.statistics.rms;
    for (const double other : {study.rms_of_spectra(), rms_by_quadrature(fit, study.known.first)})
        found.rms_apart = std::max(found.rms_apart, std::fabs(other / rms_of_heights - 1));
    found.free_apart = fit.free_rms.value / rms_of_heights - 1;
    std::map<std::string, FittedValue> given;
    for (const FittedValue& value : fit.values) given[value.name] = value;
    given["free_rms_um"] = fit.free_rms;
    const auto& anisotropy = study.anisotropy;
    given["ratio"] = {"ratio", anisotropy.ellipse.ratio, anisotropy.ratio_error};
    given["azimuth"] = {"azimuth", anisotropy.ellipse.azimuth, anisotropy.azimuth_error};
    for (const auto& [name, value] : expected)
        found.values[name] = {(given.at(name).value - value) / given.at(name).error,
                              given.at(name).error / value};
    found.values["free_rms_um"].first = found.free_apart * rms_of_heights / fit.free_rms.error;
    return found;
}

/// How often each value came back within so many of its stated errors, and how its
/// deviations compare with those.
void check_coverage(const Case& wanted, int draws, std::size_t side, double errors_allowed) {
    const SyntheticSurface surface{rms, wanted.scales, wanted.ellipse, step, side};
    const auto expected = truth(wanted);
    std::vector<Found> all(static_cast<std::size_t>(draws));
    hts::spectral::parallel_for(all.size() / 2, [&](std::size_t k) {
        const auto [first, second] = surface.draw(HeightMap::fewest + 2 * k);
        for (std::size_t i : {2 * k, 2 * k + 1}) {
            const auto& heights = i % 2 == 0 ? first : second;
            all[i] =
                found_in(surface.map(measured(heights, surface, wanted.flaws, 1000 + i)), wanted, expected);
        }
    });
    std::map<std::string, int> hits;
    std::map<std::string, double> squares, biases, errors;
    int named = 0, agreeing = 0, free_agreeing = 0;
    double farthest = 0, free_mean = 0, free_square = 0;
    for (const Found& each : all) {
        named += each.named ? 1 : 0;
        agreeing += each.rms_apart <= 0.01 ? 1 : 0;
        farthest = std::max(farthest, each.rms_apart);
        free_agreeing += std::fabs(each.free_apart) <= 0.01 ? 1 : 0;
        free_mean += each.free_apart / draws;
        free_square += each.free_apart * each.free_apart / draws;
        for (const auto& [name, off] : each.values) {
            hits[name] += std::fabs(off.first) <= errors_allowed ? 1 : 0;
            squares[name] += off.first * off.first / draws;
            biases[name] += off.first / draws;
            errors[name] += off.second / draws;
        }
    }
    std::cout << wanted.title << ", " << draws << " maps of " << side << " by " << side << ": named " << named
              << ", the rms of three places within 1 % in " << agreeing << ", worst " << 100 * farthest
              << " %; with a free amplitude in " << free_agreeing << ", mean " << 100 * free_mean
              << " %, rms " << 100 * std::sqrt(free_square) << " %\n";
    for (const auto& [name, value] : expected) {
        INFO(wanted.title << ": " << name);
        std::cout << "  " << name << " " << value << ": error " << errors[name] * 100 << " %, within "
                  << errors_allowed << " errors " << hits[name] << ", mean " << biases[name] << ", rms "
                  << std::sqrt(squares[name]) << " errors\n";
        CHECK(hits[name] >= 0.95 * draws);
    }
    CHECK(agreeing == draws);
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"Gaussian", "gaussian", {{1, 2, HUGE_VAL}}},
        {"exponential", "exponential", {{1, 2, 0.5}}},
        {"K-correlation", "k_correlation", {{1, 1, 1.4}}},
        {"two scales", "two_scales", {{0.7, 3, HUGE_VAL}, {0.3, 0.7, HUGE_VAL}}},
        {"anisotropic Gaussian", "gaussian", {{1, 1.5, HUGE_VAL}}, {3, 0.6}},
        {"Gaussian with noise and tilt", "gaussian", {{1, 2, HUGE_VAL}}, {}, {0.02, 0.01}},
        {"K-correlation with noise, tilt, outliers",
         "k_correlation",
         {{1, 1, 1.4}},
         {},
         {0.01, 0.01, 0, 0.002, 30}},
        {"exponential with form and gaps",
         "exponential",
         {{1, 2, 0.5}},
         {},
         {0, 0, 2, 0.08},
         Level::quadratic,
         Gaps::mask}};
    return all;
}

}  // namespace

TEST_CASE("maps of known roughness give it back within the stated errors") {
    for (const std::size_t number : {0U, 2U, 4U, 7U}) check_coverage(cases()[number], 2, 128, 4);
}

TEST_CASE("larger maps have a free amplitude nearer to the rms of their heights", "[.][exhaustive]") {
    for (const std::size_t side : {256U, 512U}) check_coverage(cases()[2], 20, side, 3);
}

TEST_CASE("100 maps of each kind give their roughness back within twice the stated errors in 95",
          "[.][exhaustive]") {
    for (const Case& each : cases()) check_coverage(each, 100, 128, 2);
    check_coverage(cases()[2], 100, 256, 2);
}
