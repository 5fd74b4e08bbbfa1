#include "validation/curves/comparison.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "temporary_folder.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/curves/comparison_section.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

/// Values measured by nobody: 1, 2, 4 with 10 % each.
CurveSet small_set() {
    CurveSet set{.stem = "small",
                 .surface = "slate",
                 .by = "the test",
                 .source = "none",
                 .licence = "CC0-1.0",
                 .how = "by hand",
                 .uncertainty = "stated",
                 .curves = {}};
    Curve curve{{0.5, 0.5}, Sweep::outgoing, {}};
    for (const double angle : {-10.0, 20.0, 50.0}) {
        const double value = std::pow(2, (angle + 10) / 30);
        curve.points.push_back(in_plane_point(Sweep::outgoing, 30, angle, value, 0.1 * value));
    }
    set.curves = {curve};
    return set;
}

spectral::Material aluminium(double rms_roughness, double correlation_length) {
    return spectral::he_torrance_material("aluminium", {rms_roughness, correlation_length},
                                          spectral::built_in_optical_constants("Al"));
}

/// A set whose values are those of a model.
CurveSet computed(CurveSet set, const spectral::Material& material) {
    const auto values = Prediction{set}.values(material);
    std::size_t i = 0;
    for (Curve& curve : set.curves)
        for (CurvePoint& p : curve.points) p.value = values[i++];
    return set;
}

bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("figures of merit are what their definitions say") {
    const auto result = comparison(small_set(), {1.1, 2.0, 3.0}, 1);
    CHECK(result.scale == 1);
    const FiguresOfMerit& f = result.figures;
    CHECK(f.points == 3);
    const double a = std::log(1.1), b = std::log(0.75);
    CHECK(f.median_abs_log == Approx(a));
    CHECK(f.rms_log == Approx(std::sqrt((a * a + b * b) / 3)));
    CHECK(f.mean_log == Approx((a + b) / 3));
    CHECK(f.rms == Approx(std::sqrt((0.01 + 1) / 3)));
    CHECK(f.relative_rms == Approx(std::sqrt(1.01 / 21)));
    CHECK(f.reduced_chi_squared.value() == Approx((1 + 6.25) / 2));
    CHECK_FALSE(comparison(small_set(), {1.1, 2, 3}, 3).figures.reduced_chi_squared);
    CHECK_THROWS_WITH(comparison(small_set(), {1, 2}), Catch::Contains("model values 2: must be 3"));
    CHECK(comparison(small_set(), {0, 2, 4}).figures.without_log == 1);
}

TEST_CASE("a model that made the data fits them, in any unknown scale") {
    const auto material = aluminium(0.3, 2);
    CurveSet set = computed(small_set(), material);
    CHECK(comparison(set, Prediction{set}.values(material)).figures.rms_log == 0);
    set.scale = Scale::unknown;
    for (Curve& curve : set.curves)
        for (CurvePoint& p : curve.points) p.value *= 7;
    const auto scaled = comparison(set, Prediction{set}.values(material));
    CHECK(scaled.scale == Approx(7));
    CHECK(scaled.figures.rms_log == Approx(0).margin(1e-14));
}

TEST_CASE("maxima and ranges are those of the points") {
    const auto result = comparison(small_set(), {1, 5, 4});
    REQUIRE(result.maxima.size() == 1);
    CHECK(result.maxima[0].fixed_angle == 30);
    CHECK(result.maxima[0].measured_angle == 50);
    CHECK(result.maxima[0].computed_angle == 20);
    CHECK(result.maxima[0].off() == -30);
    CHECK(result.maxima[0].at_end);
    const auto far = figures_of_merit(small_set(), result.model, {.least_from_mirror = 15});
    CHECK(far.points == 2);  // 20 deg is 10 deg from the mirror direction
    CHECK(figures_of_merit(small_set(), result.model, {.largest_theta_i = 20}).points == 0);
    const Plateau middle = plateau(small_set(), result.model, {});
    CHECK(middle.measured == 2);
    CHECK(middle.computed == 4);
}

TEST_CASE("criteria pass for the data themselves and fail for a model that is off") {
    for (const std::string name : {"mwir-aluminium-sandblasted", "blue-acrylic"}) {
        const CurveSet set = built_in_curves(name);
        std::vector<double> same, bright;
        for (const Curve& curve : set.curves) {
            for (const CurvePoint& p : curve.points) {
                same.push_back(p.value);
                bright.push_back(1.4 * p.value * (p.theta_i < 30 ? 2 : 1));
            }
        }
        const auto good = criteria(set, comparison(set, same));
        REQUIRE_FALSE(good.empty());
        for (const Check& check : good) {
            INFO(check.claim << ": " << check.measured);
            CHECK(check.passed);
        }
        const auto bad = criteria(set, comparison(set, bright));
        CHECK_FALSE(bad.front().passed);
    }
    CHECK(criteria(small_set(), comparison(small_set(), {1, 2, 3})).empty());
}

TEST_CASE("a maximum in the wrong place fails its criterion alone") {
    const CurveSet set = built_in_curves("mwir-aluminium-sandblasted");
    std::vector<double> model;
    for (const Curve& curve : set.curves) {
        const std::size_t first = model.size();
        double largest = 0;
        for (const CurvePoint& p : curve.points) {
            model.push_back(p.value);
            largest = std::max(largest, p.value);
        }
        model[first] = 1.1 * largest;  // far on the side of the light
    }
    const auto found = criteria(set, comparison(set, model));
    REQUIRE(found.size() == 2);
    CHECK(found[0].passed);
    CHECK(mentions(found[1].claim, "maxima"));
    CHECK_FALSE(found[1].passed);
}

TEST_CASE("the measured maxima of sandblasted aluminium are where they were reported") {
    const CurveSet set = built_in_curves("mwir-aluminium-sandblasted");
    const std::map<double, double> reported{{20, 25}, {30, 42}, {40, 68}, {45, 68},
                                            {50, 76}, {60, 80}, {70, 82}};
    std::size_t found = 0;
    for (const CurveMaximum& m : comparison(set, std::vector<double>(set.point_count(), 1)).maxima) {
        const auto at = reported.find(m.fixed_angle);
        if (at == reported.end()) continue;
        CHECK(m.measured_angle == at->second);
        ++found;
    }
    CHECK(found == reported.size());
}

TEST_CASE("a section names whose measurement it shows") {
    const CurveSet set = built_in_curves("mwir-steel-galvanised");
    const Section section = comparison_section(set, aluminium(0.5, 10), {.model = "a guess"});
    CHECK(section.stem == "mwir-steel-galvanised");
    REQUIRE(section.figures.size() == 3);
    for (const Figure& figure : section.figures) {
        INFO(figure.stem);
        CHECK(mentions(figure.script, "measured by MT-MRT"));
        CHECK(mentions(figure.caption, "measured by MT-MRT"));
        CHECK(figure.tables.at(0).rows.size() == set.point_count());
    }
    CHECK(mentions(section.text, "CC0-1.0"));
    CHECK(mentions(section.text, "45 pairs") == false);  // thinned: fewer are left
    CHECK(section.tables.at(0).rows.size() == set.curves.size() + 1);
    CHECK(comparison_section(built_in_curves("curet-sandpaper"), aluminium(0.5, 1), {.model = "a guess"})
              .figures.size() == 2);
}

TEST_CASE(
    "curves of the paper that nobody has are named as not available, and compared once somebody has them") {
    const hts::testing::TemporaryFolder folder;
    const Section none = slots_section(folder.path());
    REQUIRE(none.not_available.size() == 5);
    CHECK(mentions(none.not_available[0], "he91-figure-7"));
    CHECK(mentions(none.not_available[0], "measurement not available"));
    CHECK(none.figures.empty());

    CurveSet set = small_set();
    set.scale = Scale::specular;
    set.source_solid_angle = set.detector_solid_angle = std::acos(-1.0) / 1024;
    folder.write("he91-figure-8.json", curves_text(computed(set, measurement_slots()[1].model)));
    const Section one = slots_section(folder.path());
    CHECK(one.not_available.size() == 4);
    CHECK(one.figures.size() == 3);
    CHECK(one.tables.at(0).rows.at(0).at(2) == "0");  // the median deviation from itself
}
