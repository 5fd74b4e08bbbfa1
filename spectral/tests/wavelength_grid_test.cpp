#include "spectral/wavelength_grid.hpp"

#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "hts/error.hpp"

using hts::spectral::WavelengthGrid;

TEST_CASE("a linear grid has its ends exactly and equal steps") {
    const auto grid = WavelengthGrid::linear(0.38, 0.78, 41);
    REQUIRE(grid.size() == 41);
    CHECK(grid.micrometres().front() == 0.38);
    CHECK(grid.micrometres().back() == 0.78);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        CHECK(grid[i].micrometres() == Approx(0.38 + 0.01 * static_cast<double>(i)).epsilon(1e-15));
    }
    CHECK(WavelengthGrid::linear(0.5, 0.5, 1).size() == 1);
}

TEST_CASE("a grid is read from text") {
    CHECK(WavelengthGrid::parse("0.38:0.78:41").size() == 41);
    CHECK(WavelengthGrid::parse(" 0.38 : 0.78 : 3 ")[1].micrometres() == Approx(0.58));
    CHECK(WavelengthGrid::parse("0.5:0.5:1").size() == 1);
    const auto list = WavelengthGrid::parse("0.45, 0.55,6.5e-1");
    REQUIRE(list.size() == 3);
    CHECK(list[0].micrometres() == 0.45);
    CHECK(list[2].micrometres() == 0.65);
    CHECK(WavelengthGrid::parse("0.55").size() == 1);
}

TEST_CASE("grids that cannot be are refused") {
    CHECK_THROWS_WITH(WavelengthGrid::linear(0.4, 0.7, 0),
                      "number of wavelengths 0: must be from 1 to 1000000");
    CHECK_THROWS_AS(WavelengthGrid::linear(0.4, 0.7, 1000001), hts::Error);
    CHECK_THROWS_WITH(WavelengthGrid::linear(0.4, 0.7, 1),
                      "last wavelength 0.7 um: must be the first, 0.4 um, if there is only one");
    CHECK_THROWS_WITH(WavelengthGrid::linear(0.7, 0.4, 2),
                      "last wavelength 0.4 um: must be > the first, 0.7 um");
    CHECK_THROWS_WITH(WavelengthGrid::linear(0, 0.4, 2),
                      "wavelength 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    CHECK_THROWS_AS(WavelengthGrid::linear(0.4, std::numeric_limits<double>::quiet_NaN(), 2), hts::Error);
    // More wavelengths than there are doubles between the ends.
    CHECK_THROWS_AS(WavelengthGrid::linear(0.5, 0.5000000000000002, 100), hts::Error);
    CHECK_THROWS_WITH(WavelengthGrid::from_micrometres({}),
                      "list of wavelengths without an entry: must have at least one");
    CHECK_THROWS_WITH(WavelengthGrid::from_micrometres({0.5, 0.5}),
                      "wavelength 0.5 um: must be > the one before it, 0.5 um");
    CHECK_THROWS_WITH(WavelengthGrid::from_micrometres({-1}),
                      "wavelength -1 um: must be > 0 (from 1e-24 to 1e+24 um)");
}

TEST_CASE("text that is no grid is refused with the text") {
    const std::pair<std::string, std::string> cases[] = {
        {"", "\"\" is not a number"},
        {"abc", "\"abc\" is not a number"},
        {"0.4,", "\"\" is not a number"},
        {"0.4 0.5", "\"0.4 0.5\" is not a number"},
        {"0.4,nan", "\"nan\" is not a finite number"},
        {"0.4,1e999", "\"1e999\" is too large or too small for a number"},
        {"0.5,0.4", "wavelength 0.4 um: must be > the one before it, 0.5 um"},
        {"0.4:0.7", "must be first:last:count or a list such as 0.45,0.55,0.65 [um]"},
        {"0.4:0.7:3:4", "must be first:last:count or a list such as 0.45,0.55,0.65 [um]"},
        {"0.4:x:3", "\"x\" is not a number"},
        {"0.4:0.7:3.5", "number of wavelengths \"3.5\": must be a whole number from 1 to 1000000"},
        {"0.4:0.7:99999999999",
         "number of wavelengths \"99999999999\": must be a whole number from 1 to 1000000"},
        {"0.4:0.7:-3", "number of wavelengths -3: must be from 1 to 1000000"},
    };
    for (const auto& [text, message] : cases) {
        CHECK_THROWS_WITH(WavelengthGrid::parse(text), "wavelengths \"" + text + "\": " + message);
    }
}
