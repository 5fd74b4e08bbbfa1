#include <catch2/catch.hpp>

#include <string>

#include "command.hpp"
#include "comparison.hpp"

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

TEST_CASE("hts figures kurt draws the albedo and where it stays below 1 (HTS_EXHAUSTIVE=1: a minute)") {
    if (!hts::testing::exhaustive()) return;
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
