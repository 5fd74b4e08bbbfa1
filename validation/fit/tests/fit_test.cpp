#include "validation/fit/fit.hpp"

#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "fit_samples.hpp"
#include "hts/error.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("He-Torrance parameters come back from noisy data") {
    const auto [rms, length, albedo] =
        GENERATE(table<double, double, double>({{0.05, 0.8, 0.02}, {0.2, 1.5, 0.1}, {0.35, 2.0, 0.3}}));
    const auto data = seen(he(rms, length, albedo), in_plane(), 0.01);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = Residual::weighted}, data);
    INFO(in_words(fit));
    CHECK(fit.parameter("sigma0").value == Approx(rms).epsilon(0.01));
    CHECK(fit.parameter("tau").value == Approx(length).epsilon(0.01));
    CHECK(fit.parameter("a").value == Approx(albedo).epsilon(0.01));
    for (const auto& [name, truth] :
         std::map<std::string, double>{{"sigma0", rms}, {"tau", length}, {"a", albedo}}) {
        const auto& found = fit.parameter(name);
        CHECK(std::abs(found.value - truth) < 4 * found.standard_error);
    }
    CHECK(fit.statistics.reduced_chi_squared.value() == Approx(1).margin(0.25));
    CHECK(fit.starts_at_best >= 2);
}

TEST_CASE("optical constants and scale come back where they are asked for") {
    const auto truth = spectral::he_torrance_material(
        "glass", {0.1, 1.2}, spectral::OpticalConstants::constant({1.6, 0}), spectral::DiffuseAlbedo{0.2});
    auto data = seen(truth, in_plane(), 0.002);
    for (double& value : data.values) value *= 1.3;
    const Fit fit = fitted({.model = "he", .freed = {"scale"}, .residual = Residual::relative}, data);
    INFO(in_words(fit));
    for (const auto& [name, expected] :
         std::map<std::string, double>{{"n", 1.6}, {"scale", 1.3}, {"sigma0", 0.1}}) {
        CHECK(fit.parameter(name).value == Approx(expected).epsilon(0.03));
        CHECK(std::abs(fit.parameter(name).value - expected) < 4 * fit.parameter(name).standard_error);
    }
}

TEST_CASE("albedos come back channel by channel") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.46, 0.55, 0.65});
    const spectral::DiffuseAlbedo albedo{spectral::PiecewiseLinear{{{0.46, 0.5}, {0.55, 0.2}, {0.65, 0.05}}}};
    const auto truth = spectral::he_torrance_material("paint", {0.12, 1.5},
                                                      spectral::built_in_optical_constants("Al"), albedo);
    const auto data = seen(truth, in_plane(), 0.01, grid);
    const Residual residual = GENERATE(Residual::relative, Residual::logarithmic);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = residual}, data);
    INFO(in_words(fit));
    CHECK(fit.parameter("sigma0").value == Approx(0.12).epsilon(0.01));
    CHECK(fit.parameter("a@0.46um").value == Approx(0.5).epsilon(0.01));
    CHECK(fit.parameter("a@0.55um").value == Approx(0.2).epsilon(0.01));
    CHECK(fit.parameter("a@0.65um").value == Approx(0.05).epsilon(0.02));
}

TEST_CASE("Kurt's parameters come back to 1 % with 1 % noise") {
    const std::vector<WeightedLobe<KurtLobe>> lobes{{0.3, KurtLobe{0.1, 0.12, 0.3, 0.2}}};
    const auto data = seen(constantly(Kurt{0.1, lobes}), all_around(1500), 0.01);
    const Fit fit = fitted({.model = "kurt", .freed = {"my"}, .residual = Residual::weighted}, data);
    INFO(in_words(fit));
    const std::map<std::string, double> truth{{"kd", 0.1},  {"ks", 0.3}, {"f0", 0.1},
                                              {"mx", 0.12}, {"my", 0.3}, {"alpha", 0.2}};
    for (const auto& [name, value] : truth) {
        INFO(name);
        CHECK(fit.parameter(name).value == Approx(value).epsilon(0.01));
    }
}

TEST_CASE("two lobes are told apart") {
    const std::vector<WeightedLobe<KurtLobe>> lobes{{0.3, KurtLobe{0.8, 0.08, 0.08, 0}},
                                                    {0.5, KurtLobe{0.8, 0.4, 0.4, 0}}};
    const auto data = seen(constantly(Kurt{0.05, lobes}), in_plane(), 0.01);
    const Fit fit = fitted(
        {.model = "kurt", .lobes = 2, .fixed = {{"f0", 0.8}, {"alpha", 0}}, .residual = Residual::relative},
        data);
    INFO(in_words(fit));
    const bool narrow_first = fit.parameter("mx1").value < fit.parameter("mx2").value;
    CHECK(fit.parameter(narrow_first ? "mx1" : "mx2").value == Approx(0.08).epsilon(0.01));
    CHECK(fit.parameter(narrow_first ? "mx2" : "mx1").value == Approx(0.4).epsilon(0.01));
    CHECK(fit.parameter(narrow_first ? "ks1" : "ks2").value == Approx(0.3).epsilon(0.02));
    CHECK(fit.parameter("kd").value == Approx(0.05).epsilon(0.02));
}

TEST_CASE("wild values do not mislead a robust fit") {
    auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01);
    for (std::size_t i = 0; i < data.values.size(); i += 15) data.values[i] *= 5;
    FitRequest request{.model = "he", .index = "\"Al\"", .loss_scale = 0.03};
    const double plain = std::abs(fitted(request, data).parameter("a").value - 0.1);
    request.loss = GENERATE(Loss::huber, Loss::cauchy);
    const Fit robust = fitted(request, data);
    CHECK(std::abs(robust.parameter("a").value - 0.1) < 0.2 * plain);
    CHECK(robust.parameter("sigma0").value == Approx(0.2).epsilon(0.02));
}

TEST_CASE("a very rough surface shows its slope alone, and the fit says so") {
    const auto data = seen(he(8, 80, 0.05), in_plane(), 0.01);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = Residual::relative}, data);
    INFO(in_words(fit));
    REQUIRE_FALSE(fit.statements.empty());
    CHECK_THAT(fit.statements.front(), StartsWith("sigma0 and tau apart: only sigma0/tau = 0.1"));
    CHECK(fit.parameter("sigma0").value / fit.parameter("tau").value == Approx(0.1).epsilon(0.01));
    CHECK(fit.parameter("sigma0").standard_error > 0.3 * fit.parameter("sigma0").value);
}

TEST_CASE("albedo against scale cannot be told from a matt surface") {
    const auto data = seen(constantly(LambertianModel{0.4}), in_plane(), 0.01);
    const Fit fit = fitted({.model = "lambert", .freed = {"scale"}, .residual = Residual::relative}, data);
    INFO(in_words(fit));
    REQUIRE_FALSE(fit.statements.empty());
    CHECK_THAT(fit.statements.front(), StartsWith("a and scale apart: only a scale = 0.4 +-"));
    CHECK(std::isinf(fit.parameter("a").standard_error));
}

TEST_CASE("a fit stays within bounds and says where it ended at one") {
    const auto data = seen(he(0.2, 1.5, 0), in_plane(), 0.01);
    for (const FittedParameter& p : fitted({.model = "oren_nayar"}, data).parameters) {
        CHECK(p.value >= p.lowest);
        CHECK(p.value <= p.highest);
    }
    const Fit fit = fitted({.model = "kurt", .residual = Residual::cosine}, data);
    CHECK(fit.parameter("alpha").value >= 0);
    for (const FittedParameter& p : fit.parameters) {
        CHECK(p.value >= p.lowest);
        CHECK(p.value <= p.highest);
        const bool said =
            std::ranges::find(fit.statements, p.name + ": ended at its bound") != fit.statements.end();
        CHECK(said == (p.outcome == Outcome::at_bound));
    }
}

TEST_CASE("a fit has the same bits for any number of threads") {
    const auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.05);
    const FitRequest request{.model = "kurt", .residual = Residual::relative, .followed_starts = 3};
    omp_set_num_threads(1);
    const Fit one = fitted(request, data);
    omp_set_num_threads(3);
    const Fit three = fitted(request, data);
    omp_set_num_threads(omp_get_num_procs());
    CHECK(one.material == three.material);
    CHECK(one.predicted == three.predicted);
    CHECK(one.statistics.cost == three.statistics.cost);
}

TEST_CASE("what cannot be fitted is named") {
    const auto good = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01);
    CHECK_THROWS_WITH(fitted({.model = "gloss"}, good),
                      Contains("model \"gloss\" is not known: must be one of he, "));
    CHECK_THROWS_WITH(
        fitted({.model = "he", .fixed = {{"gloss", 1}}}, good),
        Contains("parameter \"gloss\" of model \"he\" is not known: must be one of sigma0, tau, a"));
    CHECK_THROWS_WITH(fitted({.model = "he", .starts = {{"sigma0", 5000}}}, good),
                      Contains("sigma0: start 5000 um: must be 1e-04 ... 1000"));
    CHECK_THROWS_WITH(fitted({.model = "he", .fixed = {{"a", -0.1}}}, good),
                      Contains("a: fixed at -0.1: must be 0 ... 1"));
    CHECK_THROWS_WITH(fitted({.model = "lambert", .lobes = 2}, good), Contains("has no lobes"));
    CHECK_THROWS_WITH(fitted({.model = "kurt", .lobes = 4}, good), Contains("4 lobes: must be 1 ... 3"));
    CHECK_THROWS_WITH(fitted({.model = "kurt", .index = "\"Al\""}, good), Contains("has no index"));
    CHECK_THROWS_WITH(fitted({.model = "he", .index = "\"Unobtainium\""}, good), Contains("Unobtainium"));

    const std::vector<FitSample> few{
        {in_plane()[0], 0, 0.1, 0}, {in_plane()[1], 0, 0.1, 0}, {in_plane()[2], 0, 0.1, 0}};
    CHECK_THROWS_WITH(fitted({.model = "he", .index = "\"Al\""}, fit_data("three", one_micron, few)),
                      Contains("three: 3 values for 3 free parameters: must be more"));
    CHECK_THROWS_WITH(
        fitted({.model = "lambert", .residual = Residual::weighted}, fit_data("three", one_micron, few)),
        Contains("no uncertainties"));
    const auto bad = [&](double value, double uncertainty, std::size_t wavelength) {
        auto samples = few;
        samples[1] = {in_plane()[1], wavelength, value, uncertainty};
        return fit_data("bad", one_micron, samples);
    };
    CHECK_THROWS_WITH(bad(std::nan(""), 0, 0),
                      Contains("bad: sample 2: value nan: must be a finite number >= 0"));
    CHECK_THROWS_WITH(bad(-1, 0, 0), Contains("must be a finite number >= 0"));
    CHECK_THROWS_WITH(bad(1, 0.1, 0), Contains("bad: sample 1: uncertainty 0"));
    CHECK_THROWS_WITH(bad(1, 0, 7), Contains("wavelength 7: must be one of the grid's 1"));
    CHECK_THROWS_WITH(fitted({.model = "lambert"}, bad(0, 0, 0)),
                      Contains("value 2 is 0: must be > 0 for log residuals"));
}
