// Whether standard errors mean what they say: many made-up measurements with errors of gain, each fitted.

#include <catch2/catch.hpp>
#include <cstdio>

#include "fit_samples.hpp"
#include "spectral/parallel.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;

namespace {

constexpr double gain_error = 0.05;

/// A surface and how it is measured.
struct Regime {
    const char* name;
    double least_rms, largest_rms;      // [um], at a wavelength of 1 um
    double least_slope, largest_slope;  // sigma0/tau
    bool rough;                         // so that only the slope can be told
};

constexpr std::array regimes{
    Regime{"smooth", 0.03, 0.12, 0.03, 0.12, false},
    Regime{"between", 0.15, 0.3, 0.08, 0.25, false},
    Regime{"rough", 2, 10, 0.08, 0.3, true},
};

/// z = (fitted - true)/standard error, and what was said.
struct Trial {
    std::vector<double> of_parameters;  // sigma0, tau and a, where they are not said to be open
    double of_slope;
    bool apart;
};

Trial trial(const Regime& regime, int number) {
    hts::testing::Random random{1000U + static_cast<unsigned>(number)};
    const double rms = random.logarithmic(regime.least_rms, regime.largest_rms);
    const double slope = random.logarithmic(regime.least_slope, regime.largest_slope);
    const std::map<std::string, double> truth{
        {"sigma0", rms}, {"tau", rms / slope}, {"a", random.uniform(0.02, 0.3)}};
    FitData data = seen(he(rms, rms / slope, truth.at("a")), in_plane(), 0.0);
    std::vector<double> gains;
    for (int curve = 0; curve < 4; ++curve) gains.push_back(std::exp(gain_error * gaussian(random)));
    for (std::size_t i = 0; i < data.values.size(); ++i)
        data.values[i] *= gains[data.curves[i]] * std::exp(0.02 * gaussian(random));
    const Fit fit = fitted({.model = "he", .index = "\"Al\""}, data);
    Trial result{{}, (fit.slope->value - slope) / fit.slope->standard_error, fit.slope_alone};
    for (const auto& [name, value] : truth) {
        const FittedParameter& found = fit.parameter(name);
        if (found.outcome == validation::Outcome::fitted && std::isfinite(found.standard_error))
            result.of_parameters.push_back((found.value - value) / found.standard_error);
    }
    return result;
}

double rms(const std::vector<double>& values) {
    double sum = 0;
    for (const double z : values) sum += z * z;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

TEST_CASE("standard errors hold with errors of gain from curve to curve", "[.exhaustive]") {
    constexpr int each = 80;
    std::vector<double> all;
    for (const Regime& regime : regimes) {
        std::vector<Trial> trials(each);
        spectral::parallel_for(each, [&](std::size_t i) { trials[i] = trial(regime, static_cast<int>(i)); });
        std::vector<double> parameters, slopes;
        int apart = 0;
        for (const Trial& o : trials) {
            parameters.insert(parameters.end(), o.of_parameters.begin(), o.of_parameters.end());
            slopes.push_back(o.of_slope);
            apart += o.apart ? 1 : 0;
        }
        std::printf(
            "%-8s %d fits: rms of z %.2f of %zu parameters, %.2f of sigma0/tau; \"apart\" said of %d\n",
            regime.name, each, rms(parameters), parameters.size(), rms(slopes), apart);
        if (regime.rough) CHECK(apart >= 0.95 * each);
        if (!regime.rough) CHECK(apart <= 0.2 * each);
        all.insert(all.end(), parameters.begin(), parameters.end());
        all.insert(all.end(), slopes.begin(), slopes.end());
    }
    std::printf("all: rms of z %.2f of %zu\n", rms(all), all.size());
    CHECK(rms(all) > 0.8);
    CHECK(rms(all) < 1.3);
}
