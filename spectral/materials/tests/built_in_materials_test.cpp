#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "database_folder.hpp"
#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"

using hts::Wavelength;
using hts::spectral::built_in_optical_constants;
using hts::spectral::optical_constants_names;
using hts::spectral::OpticalConstants;
using hts::spectral::read_optical_constants;
using hts::testing::database_folder;

namespace {

Wavelength micrometres(double um) {
    return Wavelength::from_micrometres(um);
}

// The database file that each built-in material was made from.
const std::map<std::string, std::string> originals{{"Ag", "Ag-Johnson"},
                                                   {"Al", "Al-Rakic"},
                                                   {"Al-McPeak", "Al-McPeak"},
                                                   {"Al2O3", "Al2O3-Malitson-o"},
                                                   {"Au", "Au-Johnson"},
                                                   {"BK7", "N-BK7-schott"},
                                                   {"Cr", "Cr-Johnson"},
                                                   {"Cu", "Cu-Johnson"},
                                                   {"Cu-Rakic", "Cu-Rakic-LD"},
                                                   {"Fe", "Fe-Johnson"},
                                                   {"MgF2", ""},  // not in the folder of the test
                                                   {"MgO", "MgO-Stephens"},
                                                   {"Ni", "Ni-Johnson"},
                                                   {"PMMA", "poly_methyl_methacrylate_-Sultanova"},
                                                   {"SiC", "SiC-Shaffer"},
                                                   {"SiO2", "SiO2-Malitson"},
                                                   {"Ti", "Ti-Johnson"},
                                                   {"W", "W-Ordal"},
                                                   {"polycarbonate", "polycarbonate-Sultanova"},
                                                   {"polystyrene", "polystyrene-Sultanova"}};

}  // namespace

TEST_CASE("the built-in materials are these") {
    std::vector<std::string> expected;
    for (const auto& [name, original] : originals) expected.push_back(name);
    CHECK(optical_constants_names() == expected);
    for (const auto& name : expected) {
        const OpticalConstants material = built_in_optical_constants(name);
        CHECK(material.name() == name);
        CHECK_THAT(material.source(),
                   Catch::EndsWith("CC0-1.0, via refractiveindex.info (Polyanskiy, Sci. Data "
                                   "11, 94, 2024)."));
    }
    CHECK_THROWS_WITH(
        built_in_optical_constants("al"),
        "no built-in material \"al\": must be one of Ag, Al, Al-McPeak, Al2O3, Au, BK7, Cr, Cu, Cu-Rakic, "
        "Fe, MgF2, MgO, Ni, PMMA, SiC, SiO2, Ti, W, polycarbonate, polystyrene; did you mean \"Al\"?");
}

TEST_CASE("every built-in material agrees with the database over its range", "[.database]") {
    for (const auto& [name, original] : originals) {
        if (original.empty()) continue;
        const OpticalConstants ours = built_in_optical_constants(name);
        const OpticalConstants theirs = read_optical_constants(database_folder() / (original + ".yml"));
        const auto [shortest, longest] = ours.range();
        CHECK(theirs.range().longest == longest);
        if (name != "Al") CHECK(theirs.range().shortest == shortest);
        for (int i = 0; i <= 2000; ++i) {
            const double um =
                std::clamp(shortest * std::pow(longest / shortest, i / 2000.0), shortest, longest);
            REQUIRE(ours.index(micrometres(um)).n() == theirs.index(micrometres(um)).n());
            REQUIRE(ours.index(micrometres(um)).k() == theirs.index(micrometres(um)).k());
        }
    }
}

TEST_CASE("built-in materials have their published indices") {
    struct Case {
        const char* name;
        double um, n, k;
    };
    // Rows of the published tables; formulas at the sodium or helium d line, to the digits given there.
    const Case cases[] = {
        {"Ag", 0.5486, 0.06, 3.586},       {"Al", 0.5166, 0.8734, 6.2418},
        {"Au", 0.5821, 0.29, 2.863},       {"Cu", 0.6168, 0.30, 3.205},
        {"Cr", 0.549, 3.18, 3.33},         {"Fe", 0.549, 2.95, 2.93},
        {"Ni", 0.549, 1.92, 3.61},         {"Ti", 0.549, 2.54, 3.43},
        {"W", 1.00, 3.0826871, 3.4208368}, {"BK7", 0.5876, 1.5168, 0},
        {"SiO2", 0.5876, 1.4585, 0},       {"Al2O3", 0.5893, 1.7681, 0},
        {"MgO", 0.5893, 1.7375, 0},        {"SiC", 0.5893, 2.6523, 0},
        {"PMMA", 0.5876, 1.491, 0},        {"polycarbonate", 0.5876, 1.585, 0},
        {"polystyrene", 0.5876, 1.592, 0}, {"MgF2", 0.5893, 1.3777, 0},
    };
    for (const auto& [name, um, n, k] : cases) {
        INFO(name);
        const auto index = built_in_optical_constants(name).index(micrometres(um));
        CHECK(index.n() == Approx(n).epsilon(5e-4));
        CHECK(index.k() == Approx(k).epsilon(1e-12).margin(2e-8));
    }
    CHECK_THROWS_WITH(built_in_optical_constants("W").index(micrometres(0.5)),
                      "wavelength 0.5 um: must be from 0.667 to 200 um (range of W)");
}

TEST_CASE("built-in materials may be asked for by many threads at once") {
    std::vector<std::thread> threads;
    std::vector<double> sums(8);
    for (double& sum : sums) {
        threads.emplace_back([&sum] {
            for (const auto& name : optical_constants_names()) {
                const OpticalConstants material = built_in_optical_constants(name);
                sum += material.index(micrometres(material.range().longest)).n();
            }
        });
    }
    for (auto& thread : threads) thread.join();
    for (const double sum : sums) CHECK(sum == sums.front());
}
