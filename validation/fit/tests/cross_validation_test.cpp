#include "validation/fit/cross_validation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "validation/curves/built_in_curves.hpp"
#include "validation/fit/fit_table.hpp"

using namespace hts::validation;

namespace {

/// A set of a material's own values at some angles of the light.
CurveSet made_of(const char* text, double noise) {
    CurveSet set = built_in_curves("anodised-ec1");
    const auto material = hts::spectral::material_from_text(text, "m.json");
    const auto values = Prediction{set, {1, 0}}.values(material);
    std::size_t i = 0;
    for (Curve& curve : set.curves) {
        for (CurvePoint& point : curve.points) {
            point.value = values[i] * std::exp(noise * std::sin(static_cast<double>(7 * i)));
            ++i;
        }
    }
    set.uncertainty = "";
    for (Curve& curve : set.curves)
        for (CurvePoint& point : curve.points) point.uncertainty = 0;
    return set;
}

}  // namespace

TEST_CASE("a fit predicts the angle that was left out of data of its own model") {
    const CurveSet set = made_of(R"({"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": 2,
        "index": {"n": 1.5, "k": 0}, "diffuse_albedo": 0.05})",
                                 0.01);
    const FitSelection selection{.nodes = {1, 0}};
    const Fit fit = fitted({.model = "he", .followed_starts = 2}, fit_data(set, selection));
    const auto result = cross_validated(fit, {&set, 1}, selection);
    REQUIRE(result.parts.size() == set.curves.size());
    std::size_t count = 0;
    for (const LeftOut& part : result.parts) {
        CHECK(part.first_angle == part.last_angle);
        CHECK(part.error.median_abs_log < 0.02);
        count += part.error.data;
    }
    CHECK(count == result.all.data);
    CHECK(count == fit.statistics.data);
    CHECK(result.all.rms_log < 0.02);
    CHECK(result.all.rms_log > 0.5 * fit.statistics.rms_log);
}

TEST_CASE("what was left out is not seen: a point that no fit can foresee is missed by its whole") {
    CurveSet set = made_of(R"({"model": "lambert", "diffuse_albedo": 0.3})", 0);
    for (CurvePoint& point : set.curves.back().points) point.value *= 2;
    const FitSelection selection{.nodes = {1, 0}};
    const Fit fit = fitted({.model = "lambert"}, fit_data(set, selection));
    const auto result = cross_validated(fit, {&set, 1}, selection);
    CHECK(result.parts.back().error.median_abs_log == Approx(std::log(2)).epsilon(1e-6));
    CHECK(fit.statistics.rms_log < std::log(2) / 2);
}

TEST_CASE("many angles are left out in ten groups of neighbours, and one angle alone is refused") {
    const CurveSet set = built_in_curves("curet-sandpaper");
    const FitSelection selection{.nodes = {1, 0}};
    const Fit fit = fitted({.model = "lambert"}, fit_data(set, selection));
    const auto result = cross_validated(fit, {&set, 1}, selection);
    CHECK(result.parts.size() == 10);
    for (std::size_t i = 1; i < result.parts.size(); ++i)
        CHECK(result.parts[i].first_angle > result.parts[i - 1].last_angle);
    CHECK(result.all.data == fit.statistics.data);
    const double theta = set.curves.front().points.front().theta_i;
    CurveSet alone = set;
    std::erase_if(alone.curves.front().points, [&](const CurvePoint& p) { return p.theta_i != theta; });
    CHECK_THROWS_WITH(cross_validated(fit, {&alone, 1}, selection),
                      Catch::Contains("one angle of incidence alone: must be two, to leave one out"));
}
