#include "spectral/materials/optical_constants.hpp"

#include <catch2/catch.hpp>

#include "hts/error.hpp"

using hts::Wavelength;
using hts::spectral::ConstantValue;
using hts::spectral::DispersionFormula;
using hts::spectral::OpticalConstants;
using hts::spectral::OutsideRange;
using hts::spectral::PiecewiseLinear;

namespace {

Wavelength micrometres(double um) {
    return Wavelength::from_micrometres(um);
}

OpticalConstants table(double n_shortest, double n_longest, double k_shortest, double k_longest) {
    return {"glass", "somewhere", PiecewiseLinear{{{n_shortest, 1.4}, {n_longest, 1.6}}},
            PiecewiseLinear{{{k_shortest, 0.1}, {k_longest, 0.3}}}};
}

}  // namespace

TEST_CASE("a constant material is the same at every wavelength") {
    const auto metal = OpticalConstants::constant({0.77, 6.08});
    CHECK(metal.name() == "n = 0.77, k = 6.08");
    for (const double um : {1e-20, 0.5, 1e20}) {
        CHECK(metal.index(micrometres(um)).n() == 0.77);
        CHECK(metal.index(micrometres(um)).k() == 6.08);
    }
}

TEST_CASE("a material without k absorbs nothing") {
    const OpticalConstants glass{"glass", "somewhere", DispersionFormula{5, {1.5}, {0.3, 2.5}}, std::nullopt};
    CHECK(glass.name() == "glass");
    CHECK(glass.source() == "somewhere");
    CHECK(glass.range().shortest == 0.3);
    CHECK(glass.range().longest == 2.5);
    CHECK(glass.index(micrometres(1)).n() == 1.5);
    CHECK(glass.index(micrometres(1)).k() == 0);
}

TEST_CASE("a material is known where both n and k are") {
    const auto glass = table(0.4, 0.8, 0.6, 1.0);
    CHECK(glass.range().shortest == 0.6);
    CHECK(glass.range().longest == 0.8);
    CHECK(glass.index(micrometres(0.6)).n() == Approx(1.5).epsilon(1e-15));
    CHECK(glass.index(micrometres(0.6)).k() == 0.1);
    CHECK(glass.index(micrometres(0.8)).k() == Approx(0.2).epsilon(1e-15));
    CHECK(table(0.4, 0.6, 0.6, 0.8).index(micrometres(0.6)).n() == 1.6);
    CHECK_THROWS_WITH(table(0.4, 0.5, 0.6, 0.8),
                      "n is known from 0.4 to 0.5 um, k from 0.6 to 0.8 um: the two ranges must overlap");
}

TEST_CASE("outside its range a material refuses, or keeps to the end") {
    const auto glass = table(0.4, 0.8, 0.6, 1.0);
    CHECK_THROWS_WITH(glass.index(micrometres(0.5)),
                      "wavelength 0.5 um: must be from 0.6 to 0.8 um (range of glass)");
    CHECK_THROWS_AS(glass.index(micrometres(0.9)), hts::Error);
    CHECK(glass.index(micrometres(0.1), OutsideRange::hold).k() == 0.1);
    CHECK(glass.index(micrometres(9), OutsideRange::hold).n() == 1.6);
}

TEST_CASE("beyond the range of k alone n is what it is there") {
    // ZnSe-like: n to 18 um, k to 0.9 um
    const OpticalConstants window{"window", "", PiecewiseLinear{{{0.5, 2.7}, {10, 2.4}, {18, 2.3}}},
                                  PiecewiseLinear{{{0.5, 1e-5}, {0.9, 1e-7}}}};
    const auto held = window.index(micrometres(10), OutsideRange::hold);
    CHECK(held.n() == 2.4);
    CHECK(held.k() == 1e-7);
    CHECK(window.index(micrometres(20), OutsideRange::hold).n() == 2.3);
    CHECK_THROWS_AS(window.index(micrometres(10)), hts::Error);
    CHECK_THROWS_AS(window.index(micrometres(10), OutsideRange::zero), hts::Error);
}

TEST_CASE("a range's end has one rounding of slack") {
    const auto glass = table(0.3, 0.9, 0.3, 0.9);
    const double sum = 0.3 + 6 * 0.1;
    REQUIRE(sum > 0.9);
    CHECK(glass.index(micrometres(sum)).n() == glass.index(micrometres(0.9)).n());
    CHECK_THROWS_AS(glass.index(micrometres(0.9000001)), hts::Error);
}

TEST_CASE("a curve that leaves the physical range says where") {
    const OpticalConstants formula{"X", "", DispersionFormula{3, {1, -1, 1}, {0.5, 4}}, std::nullopt};
    CHECK(formula.index(micrometres(0.75)).n() == 0.5);
    CHECK_THROWS_WITH(formula.index(micrometres(1)),
                      "X at 1 um: refractive index n 0: must be > 0 and at most 1e+24");
    CHECK_THROWS_WITH(
        formula.index(micrometres(2)),
        Catch::Matchers::Matches("X at 2 um: refractive index n -?nan: must be > 0 and at most .*"));
    const OpticalConstants gain{"gain", "", ConstantValue{1.5}, ConstantValue{-1e-9}};
    CHECK_THROWS_WITH(gain.index(micrometres(1)),
                      "gain at 1 um: extinction coefficient k -1e-09: must be >= 0 and at most 1e+24");
}
