#include "hts/roughness.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::effective_roughness_ratio;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

TEST_CASE("effective roughness agrees with the root of the paper's equation at 50 digits") {
    const ReferenceTable table{"tests/reference/effective_roughness.csv"};
    WorstCase worst{"sigma / sigma_0", hts::accuracy::effective_roughness};
    for (std::size_t row = 0; row < table.size(); ++row) {
        worst.note(
            relative_error(effective_roughness_ratio(table(row, "K")), table(row, "sigma_over_sigma0")),
            [&] { return table.describe(row, {"K"}); });
    }
    worst.check();
}

TEST_CASE("effective roughness solves (80) and (81)") {
    for (const double K : {1e-3, 0.1, 1.0, 30.0, 1e5, 1e100}) {
        const double ratio = effective_roughness_ratio(K);
        const double z = std::sqrt(1 / (ratio * ratio) - 1);  // z_0 / sigma_0
        CHECK(z * std::sqrt(std::numbers::pi / 2) == Approx(K / 4 * std::exp(-z * z / 2)).epsilon(1e-7));
    }
}

TEST_CASE("the slope of the effective roughness is that of its logarithm") {
    WorstCase worst{"d ln(sigma/sigma_0) / d ln K", 1e-9};
    for (double K = 1e-6; K < 1e40; K *= 1.7) {
        const double step = 1e-4;
        const double above = effective_roughness_ratio(K * std::exp(step));
        const double below = effective_roughness_ratio(K * std::exp(-step));
        worst.note(std::abs(hts::effective_roughness_log_slope(effective_roughness_ratio(K)) -
                            std::log(above / below) / (2 * step)),
                   [&] { return "K = " + std::to_string(K); });
    }
    worst.check();
    CHECK(hts::effective_roughness_log_slope(1) == 0);
    CHECK(hts::effective_roughness_log_slope(0) == 0);
}

TEST_CASE("effective roughness has both limits and falls in between") {
    CHECK(std::isnan(effective_roughness_ratio(-1)));
    CHECK(std::isnan(effective_roughness_ratio(std::numeric_limits<double>::quiet_NaN())));
    CHECK(effective_roughness_ratio(0) == 1);
    CHECK(effective_roughness_ratio(std::numeric_limits<double>::infinity()) == 0);
    double before = 1;
    for (double K = 1e-3; K < 1e300; K *= 10) {
        CHECK(effective_roughness_ratio(K) < before);
        before = effective_roughness_ratio(K);
    }
}

TEST_CASE("phase variance is the square of (9)") {
    const auto wavelength = hts::Wavelength::from_micrometres(0.5);
    CHECK(hts::phase_variance(0.28, 2, wavelength) ==
          Approx(std::pow(2 * std::numbers::pi * 0.28 / 0.5 * 2, 2)).epsilon(1e-15));
    CHECK(hts::phase_variance(0, 2, wavelength) == 0);
}
