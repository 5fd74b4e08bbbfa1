#include "validation/fit/sections/fit_section.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "hts/error.hpp"
#include "hts/tests/support/comparison.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/fit/fit_curves.hpp"
#include "validation/fit/fit_table.hpp"
#include "validation/report/recorded.hpp"

namespace {

using namespace hts::validation;

Fit lambert_fit(const CurveSet& set, const FitSelection& selection = {}) {
    return fitted({.model = "lambert", .freed = {"scale"}}, fit_data(set, selection));
}

}  // namespace

TEST_CASE("fitted curves are those selected, as the instrument saw them") {
    const CurveSet set = built_in_curves("mwir-aluminium-sandblasted");
    const FitSelection selection{60, 40, {3, 1}};
    const CurveSet chosen = selected(set, selection);
    CHECK(chosen.point_count() <= 40);
    CHECK(chosen.point_count() > 20);
    for (const Curve& curve : chosen.curves) {
        for (const CurvePoint& point : curve.points) CHECK(std::max(point.theta_i, point.theta_r) <= 60);
    }
    const FitData data = fit_data(set, selection);
    REQUIRE(data.values.size() == chosen.point_count());
    CHECK(data.uncertainties.size() == data.values.size());
    CHECK(std::ranges::all_of(data.channels, [](std::size_t channel) { return channel == 0; }));
    const FitModel model{"he", {1, {3.0}, {0}, "\"Al\""}};
    const auto material = hts::spectral::material_from_text(
        model.material_text(std::vector<double>{0.5, 3, 0.1}, "aluminium"), "");
    CHECK(data.instrument->values(material) == Prediction{chosen, {3, 1}}.values(material));
    CHECK_THROWS_WITH(fit_data(set, {1, 0, {3, 1}}),
                      Catch::Contains("mwir-aluminium-sandblasted: no point > 0 up to"));
}

TEST_CASE("two bands are two channels with an albedo each") {
    CurveSet set = built_in_curves("blue-acrylic");
    Curve red = set.curves.front();
    red.band = {0.6, 0.7};
    for (CurvePoint& point : red.points) point.value /= 3;
    set.curves = {set.curves.front(), red};
    const Fit fit =
        fitted({.model = "lambert", .residual = Residual::relative}, fit_data(set, {70, 0, {4, 0}}));
    REQUIRE(fit.parameters.size() == 3);
    CHECK(fit.parameters[0].name == "a@0.46um");
    CHECK(fit.parameters[1].value == Approx(fit.parameters[0].value / 3).epsilon(1e-9));
    CHECK(fit.material.find("\"table\"") != std::string::npos);
}

TEST_CASE("curves over their own mirror value leave the scale open") {
    CurveSet set = built_in_curves("curet-sandpaper");
    set.scale = Scale::specular;
    set.uncertainty = "";
    const Fit fit = lambert_fit(set);
    CHECK(std::isinf(fit.parameter("a").standard_error));
    REQUIRE_FALSE(fit.statements.empty());
    CHECK(fit.statements.front() == "a: the data leave it open");
}

TEST_CASE("sandblasted aluminium: one roughness carries ten camera angles") {
    const auto sections = fits_sections(Effort::quick);
    const Section& fits = sections.front();
    REQUIRE(fits.tables.size() == 2);
    const auto names = built_in_curve_names();
    const auto unseen = static_cast<std::size_t>(
        std::ranges::count_if(names, [](const std::string& name) { return name.ends_with("-emissivity"); }));
    CHECK(unseen == 8);
    CHECK(fits.tables[0].rows.size() > names.size() - unseen);
    for (const auto& row : fits.tables[0].rows) CHECK(row.size() == fits.tables[0].columns.size());

    CHECK(sections.size() == 3 + names.size() - unseen);
    for (const Section& section : sections) {
        INFO(section.stem);
        CHECK((section.stem == "fits" || section.stem == "emissivity" || section.figures.size() >= 2));
        CHECK((section.stem == "fits" || !section.checks.empty()));  // every surface has a verdict
        if (section.stem != "mwir-aluminium-sandblasted" && section.stem != "blue-acrylic") continue;
        for (const Check& check : section.checks) {
            INFO(check.claim << ": " << check.measured);
            CHECK(check.passed);
        }
        CHECK(section.checks.size() == 2);
    }
    const auto section_of = [&](const char* stem) {
        return *std::ranges::find(sections, stem, &Section::stem);
    };
    // eight surfaces, one of them with two fits, at ten angles each; two coatings
    CHECK(section_of("emissivity").checks.size() == 8);
    REQUIRE(section_of("emissivity").tables.size() == 1);
    CHECK(section_of("emissivity").tables[0].rows.size() == 9);
    CHECK(section_of("predicted").checks.size() == 2);
    CHECK(section_of("predicted").tables.size() == 2);
    for (const Section& section : {section_of("emissivity"), section_of("predicted")})
        for (const auto& table : section.tables)
            for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
    CHECK(Record::kept().contradictions(sections, Effort::quick) == std::vector<std::string>{});
    CHECK(fits.learned.find(" of 15 measured surfaces have a median |ln(model / measured)|") !=
          std::string::npos);
}

TEST_CASE("every model takes part in a comparison, and more lobes come closer") {
    const CurveSet set = built_in_curves("curet-ceramic-quarry-tile");
    const Residual residual = hts::testing::exhaustive() ? Residual::logarithmic : Residual::cosine;
    const auto fits = fits_of(compared_models(), set, {residual, {80, 24, {3, 0}}, "", 2});
    REQUIRE(fits.size() == compared_models().size());
    std::set<std::string> models;
    for (const Fit& fit : fits) {
        models.insert(fit.model);
        CHECK(std::isfinite(fit.statistics.aic));
        CHECK(fit.statistics.cost > 0);
    }
    CHECK(models.size() + 1 == fit_families().size());  // all but Ashikhmin's, whose trials take long
    const auto cost = [&](const ModelChoice& wanted) {
        return std::ranges::find_if(fits,
                                    [&](const Fit& fit) { return choice_of(fit).label() == wanted.label(); })
            ->statistics.cost;
    };
    CHECK(cost({"kurt", 2}) <= cost({"kurt"}) * 1.001);
    CHECK(cost({"kurt", 3}) <= cost({"kurt", 2}) * 1.001);
    CHECK(cost({"he"}) < cost({"lambert"}));
}
