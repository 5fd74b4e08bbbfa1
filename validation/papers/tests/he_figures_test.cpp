#include "validation/papers/he_figures.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"

using namespace hts::validation;

TEST_CASE("the figures of He et al. 1991 are in the paper's axes") {
    for (const int number : {7, 8, 9, 10}) {
        const HeFigure figure = he_figure(number);
        for (const double theta_i : figure.theta_i) {
            const PolarCurve curve = figure.curve(theta_i);
            const auto mirror =
                std::find_if(curve.points.begin(), curve.points.end(),
                             [&](const PolarPoint& point) { return point.view_angle == theta_i; });
            REQUIRE(mirror != curve.points.end());
            CHECK(mirror->radius == Approx(1).epsilon(1e-14));  // eq. 11
        }
    }
    const PolarCurve absolute = he_figure(11).curve(30);
    CHECK(absolute.points[100].radius == Approx(0.15 / std::numbers::pi));
    CHECK_THROWS_AS(he_figure(6), hts::Error);
}

TEST_CASE("figures 7 to 11 are drawn with their numbers, and say that they are theory") {
    const auto figures = he_figures();
    REQUIRE(figures.size() == 5);
    for (const Figure& figure : figures) {
        CHECK(figure.script.find("not available") != std::string::npos);
        CHECK(figure.script.find(figure.tables.front().stem + ".csv") != std::string::npos);
        for (const auto& row : figure.tables.front().rows) {
            CHECK(std::all_of(row.begin(), row.end(), [](double value) { return std::isfinite(value); }));
        }
    }
}

TEST_CASE("what the text of He et al. 1991 says of its figures") {
    const Section section = paper_figures_section(Effort::quick);
    CHECK(section.checks.size() >= 12);
    std::vector<std::string> missed;
    for (const Check& check : section.checks) {
        INFO(check.claim << ": " << check.measured);
        CHECK((check.passed || !check.remark.empty()));  // a miss is explained
        if (!check.passed) missed.push_back(check.claim.substr(0, 30));
    }
    CHECK(missed == std::vector<std::string>{"Fig. 9: that peak is specular:"});
}
