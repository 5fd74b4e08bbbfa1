#include "spectral/materials/piecewise_linear.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Wavelength;
using hts::spectral::OutsideRange;
using hts::spectral::PiecewiseLinear;
using hts::spectral::WavelengthRange;

TEST_CASE("straight lines go through their points and between them") {
    const PiecewiseLinear line{{{0.4, 1.0}, {0.5, 3.0}, {1.0, 2.0}}};
    CHECK(line(0.4) == 1.0);
    CHECK(line(0.5) == 3.0);
    CHECK(line(1.0) == 2.0);
    CHECK(line(0.45) == Approx(2.0).epsilon(1e-15));
    CHECK(line(0.75) == 2.5);
    CHECK(line.range().shortest == 0.4);
    CHECK(line.range().longest == 1.0);
}

TEST_CASE("outside its points a line keeps the value at the nearer end") {
    const PiecewiseLinear line{{{0.4, 1.0}, {0.5, 3.0}}};
    CHECK(line(0.1) == 1.0);
    CHECK(line(9) == 3.0);
    const PiecewiseLinear point{{{0.4, 7.0}}};
    CHECK(point(0.1) == 7.0);
    CHECK(point(0.4) == 7.0);
    CHECK(point(9) == 7.0);
}

TEST_CASE("points are sorted, those of equal wavelength averaged") {
    const PiecewiseLinear line{{{1.0, 2.0}, {0.5, 1.0}, {0.4, 1.0}, {0.5, 4.0}, {0.5, 4.0}}};
    REQUIRE(line.points().size() == 3);
    CHECK(line.points()[0].um == 0.4);
    CHECK(line.points()[1].um == 0.5);
    CHECK(line.points()[1].value == Approx(3.0).epsilon(1e-15));
    CHECK(line.points()[2].um == 1.0);
    const PiecewiseLinear same{{{0.5, 0.1}, {0.5, 0.1}, {0.5, 0.1}}};
    CHECK(same(0.5) == 0.1);
}

TEST_CASE("a line is monotonic between points, whatever the rounding") {
    hts::testing::Random random{1};
    for (int repeat = 0; repeat < 100; ++repeat) {
        const double left = random.logarithmic(1e-6, 1e6);
        const double right = left * random.logarithmic(1.0001, 100);
        const PiecewiseLinear line{{{left, 1.0}, {right, 1.0 + random.logarithmic(1e-12, 1)}}};
        double before = 1.0;
        for (int step = 1; step <= 20; ++step) {
            const double value = line(left + (right - left) * step / 20);
            CHECK(value >= before);
            before = value;
        }
    }
}

TEST_CASE("tables that cannot be are refused") {
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(PiecewiseLinear{{}}, "table without a row: must have at least one");
    CHECK_THROWS_WITH((PiecewiseLinear{{{0.0, 1.0}}}),
                      "wavelength 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    CHECK_THROWS_WITH((PiecewiseLinear{{{0.5, infinity}}}), "tabulated value inf: must be finite");
    CHECK_THROWS_AS((PiecewiseLinear{{{infinity, 1.0}}}), hts::Error);
}

TEST_CASE("a range admits what is inside, and outside does as it is told") {
    const WavelengthRange range{0.3, 2.5};
    const auto admit = [&range](double um, OutsideRange policy) {
        return range.admit(Wavelength::from_micrometres(um), policy, "N-BK7");
    };
    CHECK(admit(0.3, OutsideRange::error) == 0.3);
    CHECK(admit(1.0, OutsideRange::error) == 1.0);
    CHECK(admit(2.5, OutsideRange::error) == 2.5);
    CHECK_THROWS_WITH(admit(3, OutsideRange::error),
                      "wavelength 3 um: must be from 0.3 to 2.5 um (range of N-BK7)");
    CHECK_THROWS_WITH(admit(0.2, OutsideRange::error),
                      "wavelength 0.2 um: must be from 0.3 to 2.5 um (range of N-BK7)");
    CHECK(admit(3, OutsideRange::hold) == 2.5);
    CHECK(admit(0.2, OutsideRange::hold) == 0.3);
    CHECK(admit(1.0, OutsideRange::hold) == 1.0);
}
