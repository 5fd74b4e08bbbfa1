#include "hts/surface.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "hts/wavelength.hpp"

using hts::Surface;
using hts::Wavelength;

TEST_CASE("surfaces with lengths that cannot be are refused") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(Surface(-0.1, 1), "rms roughness -0.1 um: must be >= 0 (0, or from 1e-24 to 1e+24 um)");
    CHECK_THROWS_WITH(Surface(0.1, 0), "correlation length 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    for (const double bad : {-1.0, 1e-30, 1e30, infinity, nan}) {
        CHECK_THROWS_AS(Surface(bad, 1), hts::Error);
        CHECK_THROWS_AS(Surface(1, bad), hts::Error);
    }
    CHECK(Surface(0, 1).slope_width() == 0);
    CHECK(Surface(0.28, 1.77).slope_width() == Approx(0.56 / 1.77));
}

TEST_CASE("wavelengths are positive lengths") {
    CHECK(Wavelength::from_nanometres(500).micrometres() == 0.5);
    CHECK(Wavelength::from_micrometres(0.5).wave_number() == Approx(12.566370614359172));
    CHECK_THROWS_WITH(Wavelength::from_micrometres(0),
                      "wavelength 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    CHECK_THROWS_AS(Wavelength::from_micrometres(-1), hts::Error);
    CHECK_THROWS_AS(Wavelength::from_micrometres(std::numeric_limits<double>::quiet_NaN()), hts::Error);
    CHECK_THROWS_AS(Wavelength::from_micrometres(std::numeric_limits<double>::infinity()), hts::Error);
}
