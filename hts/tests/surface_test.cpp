#include "hts/surface.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "hts/wavelength.hpp"

using hts::Correlation;
using hts::Direction;
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

TEST_CASE("Surface: light sees the slopes of frequencies up to 1/lambda") {
    const double sigma = 0.2, wavelength = 0.5;
    const auto exponential = Surface::anisotropic(sigma, {3, 0.7}, Direction::from_degrees(90, 20))
                                 .correlated(Correlation::exponential());
    const Surface seen = exponential.seen_by(Wavelength::from_micrometres(wavelength));
    CHECK(!seen.correlation());
    CHECK(seen.azimuth() == exponential.azimuth());
    // s^2 = sigma^2/l^2 ((1 + U/2)/sqrt(1 + U) - 1), U = (2 pi l/lambda)^2, and tau = sqrt(2) sigma/s
    const auto expected = [&](double length) {
        const double u = std::pow(2 * std::numbers::pi * length / wavelength, 2);
        const double slope = sigma / length * std::sqrt((1 + u / 2) / std::sqrt(1 + u) - 1);
        return std::sqrt(2.0) * sigma / slope;
    };
    CHECK(seen.correlation_lengths().along == Approx(expected(3)).epsilon(1e-8));
    CHECK(seen.correlation_lengths().across == Approx(expected(0.7)).epsilon(1e-8));
    // nu = 1/2: the share below F is 1 - (1 + (2 pi l F)^2)^(-1/2)
    const Surface isotropic = Surface{sigma, 3}.correlated(Correlation::exponential());
    const auto below = [](double f) { return 1 - 1 / std::hypot(1, 2 * std::numbers::pi * 3 * f); };
    CHECK(isotropic.variance_share(0.1, 2) == Approx(below(2) - below(0.1)).epsilon(1e-7));
    CHECK(Surface{sigma, 3}.variance_share(0, 0.2) ==
          Approx(1 - std::exp(-std::pow(2 * std::numbers::pi * 3 * 0.2, 2) / 4)));
    const Surface gaussian{sigma, 3};
    CHECK(gaussian.seen_by(Wavelength::from_micrometres(wavelength)).correlation_length() == 3);
}
