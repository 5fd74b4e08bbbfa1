#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

TEST_CASE("hts figures needs a paper that it knows and a folder") {
    const Workplace place;
    CHECK(place.hts("figures").exit_code == 2);
    CHECK(place.hts("figures kurt").exit_code == 2);
    CHECK(place.hts("figures nobody --output f").exit_code == 2);
    CHECK(place.hts("figures --help").output.find("hts figures kurt --output") != std::string::npos);
    CHECK(place.names().empty());
}

TEST_CASE("hts figures kurt draws the albedo and where it stays below 1", "[.exhaustive]") {
    const Workplace place;
    REQUIRE(place.hts("figures kurt --output f --json").exit_code == 0);
    for (const std::string name : {"figure-2", "figure-3", "plausible-alpha"}) {
        CHECK(place.read("f/" + name + ".svg").find("</svg>") != std::string::npos);
    }
    // narrow lobes conserve energy up to alpha = 1/2, whatever the angle
    const auto rows = cells(place.read("f/plausible-alpha.csv"));
    REQUIRE(rows.size() > 10);
    for (std::size_t column = 1; column < 5; ++column) {
        CHECK(std::stod(rows[1][column]) == Approx(0.5).epsilon(2e-3));
    }
    CHECK(std::stod(rows.back()[4]) < std::stod(rows.back()[3]));
}

TEST_CASE("hts figures he1991 draws Figs 7 to 11 with their numbers") {
    const Workplace place;
    const auto result = place.hts("figures he1991 --output he");
    CHECK(result.exit_code == 0);
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 5);
    for (const std::string figure : {"7", "8", "9", "10", "11"}) {
        INFO(figure);
        const std::string picture = place.read("he/he-figure-" + figure + ".svg");
        CHECK(picture.find("</svg>") != std::string::npos);
        CHECK(picture.find("not available") != std::string::npos);
    }
    const auto rows = cells(place.read("he/he-figure-11.csv"));
    CHECK(rows[0][5] == "radius");
    CHECK(std::stod(rows[100][5]) == Approx(0.15 / 3.14159265358979));
}

TEST_CASE("hts figures walter draws normals, shadowing and lobes with their numbers") {
    const Workplace place;
    const auto result = place.hts("figures walter --output walter --json");
    CHECK(result.exit_code == 0);
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 6);
    for (const std::string figure : {"2", "8", "10", "11", "13", "14"}) {
        INFO(figure);
        CHECK(place.read("walter/figure-" + figure + ".svg").find("</svg>") != std::string::npos);
    }
    // light at 0 deg through ground glass, straight on, times the paper's scale
    const auto rows = cells(place.read("walter/figure-10-lobes.csv"));
    CHECK(rows[0][0] == "theta_o_deg");
    CHECK(rows[0][2] == "ggx_0_deg");
    REQUIRE(rows[121][0] == "0");
    const double eta = 1.51;
    CHECK(std::stod(rows[121][2]) == Approx(0.755 * 4 * std::pow(eta, 3) / std::pow(eta * eta - 1, 2) /
                                            (3.14159265358979 * 0.394 * 0.394)));
    CHECK(nlohmann::json::accept(place.read("walter/figure-8-shadowing.json")));
}
