#include "validation/topography/surface_study.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <string>

#include "synthetic_map.hpp"

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
    std::map<std::string, double> values{{"rms_um", rms}};
    for (const RoughnessModel& model : roughness_models()) {
        if (model.name != wanted.model) continue;
        for (const RoughnessValue& value : model.values(wanted.scales)) values[value.name] = value.value;
    }
    if (wanted.flaws.noise > 0) values["noise_rms_um"] = wanted.flaws.noise;
    if (wanted.ellipse.ratio > 1)
        values["ratio"] = wanted.ellipse.ratio, values["azimuth"] = wanted.ellipse.azimuth;
    return values;
}

/// How often each value came back within so many of its stated errors, and how its
/// deviations compare with those.
void check_coverage(const Case& wanted, int draws, std::size_t side, double errors_allowed) {
    const SyntheticSurface surface{rms, wanted.scales, wanted.ellipse, step, side};
    const auto expected = truth(wanted);
    std::map<std::string, int> hits;
    std::map<std::string, double> squares, biases, errors;
    int named = 0, three = 0;
    for (int k = 0; k < draws; k += 2) {
        const auto pair = surface.draw(hts::validation::HeightMap::fewest + static_cast<std::uint64_t>(k));
        int which = 0;
        for (const auto* heights : {&pair.first, &pair.second}) {
            const auto seed = static_cast<std::uint64_t>(1000 + k + which++);
            const HeightMap map = surface.map(measured(*heights, surface, wanted.flaws, seed));
            const SurfaceStudy study = studied({map}, {{wanted.level, wanted.gaps, 8}});
            const auto& fits = study.fits;
            const auto& fit = *std::find_if(fits.begin(), fits.end(),
                                            [&](const auto& f) { return f.model == wanted.model; });
            named += best(fits).model == wanted.model ? 1 : 0;
            const double heights_rms = study.statistics.rms;
            three += std::fabs(study.rms_of_spectra() / heights_rms - 1) < 1e-9 &&
                             std::fabs(fit.rms_of_rings / heights_rms - 1) < 0.03
                         ? 1
                         : 0;
            std::map<std::string, FittedValue> found;
            for (const FittedValue& value : fit.values) found[value.name] = value;
            const auto& anisotropy = study.anisotropy;
            found["ratio"] = {"ratio", anisotropy.ellipse.ratio, anisotropy.ratio_error};
            found["azimuth"] = {"azimuth", anisotropy.ellipse.azimuth, anisotropy.azimuth_error};
            for (const auto& [name, value] : expected) {
                const FittedValue& f = found.at(name);
                const double off = (f.value - value) / f.error;
                hits[name] += std::fabs(off) <= errors_allowed ? 1 : 0;
                squares[name] += off * off / draws;
                biases[name] += off / draws;
                errors[name] += f.error / value / draws;
            }
        }
    }
    std::cout << wanted.title << ", " << draws << " maps of " << side << " by " << side << ": named " << named
              << ", three rms within 3 %: " << three << '\n';
    for (const auto& [name, value] : expected) {
        INFO(wanted.title << ": " << name);
        std::cout << "  " << name << " " << value << ": error " << errors[name] * 100 << " %, within "
                  << errors_allowed << " errors " << hits[name] << ", mean " << biases[name] << ", rms "
                  << std::sqrt(squares[name]) << " errors\n";
        CHECK(hits[name] >= 0.95 * draws);
    }
    CHECK(three >= 0.95 * draws);
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

TEST_CASE("100 maps of each kind give their roughness back within the stated errors", "[.][exhaustive]") {
    for (const Case& each : cases()) check_coverage(each, 100, 256, 2);
}
