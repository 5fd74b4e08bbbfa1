#include "validation/fit/fit_findings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "fit_samples.hpp"
#include "hts/error.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/curves/comparison.hpp"
#include "validation/fit/fit_table.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;
using Catch::Contains;
using Catch::StartsWith;

namespace {

/// Curves in the plane of incidence that a material shows to an instrument, with noise.
CurveSet shown_by(const spectral::Material& material, std::optional<double> detector, double noise = 0.02) {
    CurveSet set{.stem = "made-up",
                 .surface = "made up",
                 .kind = CurveKind::theory,
                 .by = "the test",
                 .source = "none",
                 .licence = "none",
                 .how = "by the test",
                 .detector_solid_angle = detector,
                 .curves = {}};
    for (const double theta_i : {10.0, 30.0, 50.0, 70.0}) {
        Curve curve{{1, 1}, Sweep::outgoing, {}};
        for (double theta_r = -75; theta_r < 80; theta_r += 5)
            curve.points.push_back(in_plane_point(Sweep::outgoing, theta_i, theta_r, 0, 0));
        set.curves.push_back(std::move(curve));
    }
    hts::testing::Random random{7};
    const auto values = Prediction{set}.values(material);
    std::size_t i = 0;
    for (Curve& curve : set.curves)
        for (CurvePoint& point : curve.points) point.value = values[i++] * std::exp(noise * gaussian(random));
    return set;
}

Fit fit_of(const CurveSet& set, FitRequest request = {.index = "\"Al\"", .followed_starts = 3}) {
    return fitted(request, set, {});
}

/// The first statement with a text; empty if there is none.
std::string statement(const Fit& fit, const std::string& part) {
    const auto found = std::ranges::find_if(
        fit.statements, [&](const auto& text) { return text.find(part) != std::string::npos; });
    return found == fit.statements.end() ? "" : *found;
}

}  // namespace

TEST_CASE("a fit without solid angles says first that the specular term was not compared") {
    for (const std::string name : {"anodised-ec1", "anodised-nite"}) {
        CurveSet set = built_in_curves(name);
        const Fit fit = fitted({.followed_starts = 4}, set, {});
        INFO(in_words(fit));
        const auto first = std::ranges::find_if_not(
            fit.statements, [](const auto& text) { return text.ends_with("ended at its bound"); });
        REQUIRE(first != fit.statements.end());
        CHECK_THAT(*first, StartsWith("the specular term was not compared"));
        CHECK_THAT(*first, Contains("not separable"));
        CHECK(fit.slope_alone);
        CHECK_THAT(statement(fit, "sigma0 and tau apart"), Contains("only sigma0/tau"));

        // with the detector stated the slope alone is left, and sigma0 may be as large as measured
        set.detector_solid_angle = 1e-4;
        const Fit seen = fitted({.followed_starts = 4}, set, {});
        INFO(in_words(seen));
        CHECK(statement(seen, "specular term").empty());
        CHECK_THAT(statement(seen, "only sigma0/tau"),
                   StartsWith("sigma0 and tau apart: only sigma0/tau = "));
        CHECK(seen.slope_alone);
        CHECK(std::isinf(seen.parameter("sigma0").standard_error));
        CHECK(seen.parameter("sigma0").value > 1.5 * fit.parameter("sigma0").value);
    }
}

TEST_CASE(
    "a smooth surface is told from the limit of rough ones, which curves with gains of their own resemble") {
    for (const double tau : {2.0, 3.0}) {
        std::vector<DirectionPair> pairs;
        for (const double theta_i : {10.0, 40.0, 60.0})
            for (double theta_r = 0; theta_r < 80; theta_r += 3)
                pairs.push_back({Direction::from_degrees(theta_i, 0), Direction::from_degrees(theta_r, 180)});
        const auto red = spectral::WavelengthGrid::from_micrometres({0.633});
        const Fit fit =
            fitted({.index = "\"Al\"", .followed_starts = 3}, seen(he(0.05, tau, 0), pairs, 0.03, red));
        INFO(in_words(fit));
        CHECK_FALSE(fit.slope_alone);
        const FittedParameter& sigma0 = fit.parameter("sigma0");
        CHECK(std::abs(sigma0.value - 0.05) < 3 * sigma0.standard_error);
        CHECK(sigma0.standard_error < 0.001);
    }
}

TEST_CASE("a measured roughness is set beside the fitted one") {
    CurveSet set = built_in_curves("anodised-ec1");
    const Fit fit = fitted({.followed_starts = 4}, set, {});
    CHECK_THAT(statement(fit, "rms roughness measured"),
               Contains("times below the rms roughness measured, 1.222 um (optical profiler, 50x)"));
    CHECK(roughness_statement(0.25, {3.25, "profiler"}) ==
          "sigma0 0.25 um is 13 times below the rms roughness measured, 3.25 um (profiler)");
    CHECK(roughness_statement(2, {1, "profiler"}) ==
          "sigma0 2 um is 2 times above the rms roughness measured, 1 um (profiler)");
    CHECK(roughness_statement(1, {1.01, "profiler"}) ==
          "sigma0 1 um is as large as the rms roughness measured, 1.01 um (profiler)");
    set.roughness.reset();
    CHECK(statement(fitted({.followed_starts = 1}, set, {}), "rms roughness measured").empty());
}

TEST_CASE("optical constants are not held beyond their range unless asked, and it is said") {
    const CurveSet brass = built_in_curves("mwir-brass");
    const FitRequest request{.index = R"({"table": [[2.5, 2, 10], [3, 2.2, 11]]})", .followed_starts = 1};
    const FitSelection few{.largest_theta = 80, .most_points = 30, .nodes = {2, 0}};
    CHECK_THROWS_AS(fitted(request, brass, few), RequestError);
    FitSelection held = few;
    held.outside = spectral::OutsideRange::hold;
    CHECK_THAT(statement(fitted(request, brass, held), "held at the end"),
               Contains("optical constants held"));
}

TEST_CASE("a fitted surface that reflects more than all of the light is named") {
    CurveSet bright = shown_by(he(0.15, 1, 0.2), 1e-3);
    for (Curve& curve : bright.curves)
        for (CurvePoint& point : curve.points) point.value *= 2;
    const Fit scaled = fit_of(bright, {.index = "\"Al\"", .freed = {"scale"}, .followed_starts = 3});
    INFO(in_words(scaled));
    CHECK_THAT(statement(scaled, "with the factor scale"), Contains("more than all"));
    const Fit fit = fit_of(bright);
    INFO(in_words(fit));
    CHECK_THAT(statement(fit, "the fitted material reflects"), Contains("more than all"));
    CHECK(statement(fit_of(shown_by(he(0.15, 1, 0.01), 1e-3)), "more than all").empty());
}

TEST_CASE("curves of ground metal are called not isotropic") {
    CurveSet set = shown_by(he(2, 14, 0), 1e-3);
    CHECK(statement(fit_of(set), "not isotropic").empty());
    for (Curve& curve : set.curves)
        for (CurvePoint& point : curve.points) point.value *= 30;
    CHECK_THAT(statement(fit_of(set), "not isotropic"), StartsWith("not isotropic: the curve at "));
}

TEST_CASE("values of noise are data where a floor is stated, and counted where they cannot be") {
    CurveSet set = shown_by(he(0.2, 1.5, 0.01), {}, 0);
    hts::testing::Random random{9};
    const double floor = 0.02;  // larger than what the albedo shows far from the lobe
    for (Curve& curve : set.curves)
        for (CurvePoint& point : curve.points) point.value += floor * gaussian(random);
    set.noise_floor = floor;
    const FitRequest request{
        .index = "\"Al\"", .fixed = {{"sigma0", 0.2}, {"tau", 1.5}}, .followed_starts = 1};
    const Fit kept = fit_of(set, request);
    CHECK(kept.statistics.data == set.point_count());
    CHECK(kept.parameter("a").value == Approx(0.01).margin(4 * kept.parameter("a").standard_error));

    CurveSet positive = set;
    positive.noise_floor.reset();
    for (Curve& curve : positive.curves)
        for (CurvePoint& point : curve.points) point.value = std::max(point.value, 0.0);
    const Fit biased = fit_of(positive, request);
    CHECK(biased.parameter("a").value > 1.5 * kept.parameter("a").value);
    CHECK_THAT(statement(biased, "left out"),
               Contains("values that are not > 0 left out, which log residuals"));
    CHECK(fit_of(positive, {.index = "\"Al\"", .residual = Residual::cosine, .followed_starts = 1})
              .statistics.data == positive.point_count());
}

TEST_CASE("other ways to fit are shown where they lead further than the errors") {
    const CurveSet coating = built_in_curves("anodised-ec1");
    const Fit fit = fitted({.followed_starts = 4}, coating, {}, {.energy = false, .other_ways = true});
    INFO(in_words(fit));
    CHECK_FALSE(statement(fit, "further from this fit than the errors").empty());
    const Fit sound = fitted({.index = "\"Al\"", .followed_starts = 3}, shown_by(he(0.2, 1.5, 0.1), 1e-3), {},
                             {.energy = false, .other_ways = true});
    INFO(in_words(sound));
    CHECK(statement(sound, "further from this fit").empty());
}

TEST_CASE("hemispherical reflectances are predicted as they are integrated") {
    const double slope = GENERATE(0.03, 0.1, 0.3);
    const auto material = he(0.4, 0.4 / slope, 0.1);
    CurveSet set;
    set.quantity = Quantity::hemispherical_reflectance;
    Curve curve{{1, 1}, Sweep::incident, {}};
    for (const double theta : {0.0, 30.0, 60.0, 80.0})
        curve.points.push_back(in_plane_point(Sweep::incident, 0, theta, 0, 0));
    set.curves = {curve};
    const auto predicted = Prediction{set}.values(material);
    const auto reflectance = material.at(Wavelength::from_micrometres(1));
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        INFO("sigma0/tau " << slope << ", " << curve.points[i].theta_i << " deg");
        const double exact =
            reflectance.albedo(Direction::from_degrees(curve.points[i].theta_i, 0), 0).total();
        CHECK(predicted[i] == Approx(exact).epsilon(validation::accuracy::hemisphere_average));
    }
}

TEST_CASE("a hemispherical reflectance is a datum that the scale leaves alone") {
    const auto truth = he(0.2, 1.5, 0.15);
    CurveSet curves = shown_by(truth, 1e-3, 0.01);
    for (Curve& curve : curves.curves)
        for (CurvePoint& point : curve.points) point.value *= 0.6;  // a reference that nobody knew
    CurveSet whole = curves;
    whole.quantity = Quantity::hemispherical_reflectance;
    Curve curve{{1, 1}, Sweep::incident, {}};
    for (double theta = 10; theta < 80; theta += 10)
        curve.points.push_back(in_plane_point(Sweep::incident, 0, theta, 0, 0));
    whole.curves = {curve};
    const auto values = Prediction{whole}.values(truth);
    for (std::size_t i = 0; i < values.size(); ++i) whole.curves[0].points[i].value = values[i];
    const std::vector<CurveSet> both{curves, whole};
    const Fit fit = fitted({.fixed = {{"k", 1.3}}, .freed = {"scale"}, .followed_starts = 4}, both, {});
    INFO(in_words(fit));
    CHECK(fit.data == "made-up and made-up");
    CHECK(fit.statistics.data == curves.point_count() + 7);
    for (std::size_t i = 0; i < 7; ++i)
        CHECK(fit.predicted[curves.point_count() + i] == Approx(values[i]).epsilon(0.05));
}

TEST_CASE("energy is conserved where that is asked for") {
    CurveSet bright = shown_by(he(0.15, 1, 0.2), 1e-3);
    for (Curve& curve : bright.curves)
        for (CurvePoint& point : curve.points) point.value *= 2;
    const FitRequest request{
        .index = "\"Al\"", .freed = {"scale"}, .conserve_energy = true, .followed_starts = 3};
    const Fit fit = fit_of(bright, request);
    INFO(in_words(fit));
    const auto reflectance = fitted_material(fit).at(Wavelength::from_micrometres(1));
    for (const double theta : {0.0, 45.0, 75.0})
        CHECK(std::max(1.0, fit.parameter("scale").value) *
                  reflectance.albedo(Direction::from_degrees(theta, 0), 0).total() <
              1.012);
}
