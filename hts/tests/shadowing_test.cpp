#include "hts/shadowing.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::Direction;
using hts::Surface;
using hts::visibility;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

TEST_CASE("shadowing and obstruction agree with 50 digits") {
    const ReferenceTable table{"tests/reference/shadowing.csv"};
    WorstCase shadowing{"S_1", hts::accuracy::shadowing};
    WorstCase quotient{"S_1 / cos theta", hts::accuracy::shadowing};
    WorstCase obstruction{"K, absolute below 1", hts::accuracy::obstruction};
    WorstCase masked{"cos theta Lambda, beside cos theta and itself", hts::accuracy::masked};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Surface surface{table(row, "sigma_over_tau"), 1};
        const auto computed = visibility(surface, Direction::from_degrees(table(row, "theta_deg"), 0));
        const auto where = [&] { return table.describe(row, {"theta_deg", "sigma_over_tau"}); };
        shadowing.note(relative_error(computed.shadowing, table(row, "S1")), where);
        quotient.note(relative_error(computed.shadowing_over_cosine, table(row, "S1_over_cos")), where);
        const double expected = table(row, "K");
        obstruction.note(std::abs(computed.obstruction - expected) / std::fmax(1, expected), where);
        const double cosine = Direction::from_degrees(table(row, "theta_deg"), 0).cos_theta();
        const double hidden = cosine * table(row, "Lambda");
        masked.note(std::abs(computed.masked - hidden) / (cosine + hidden), where);
    }
    shadowing.check();
    quotient.check();
    obstruction.check();
    masked.check();
}

TEST_CASE("derivatives of shadowing and obstruction agree with differences at 80 digits") {
    const ReferenceTable table{"tests/reference/visibility_gradient.csv"};
    WorstCase obstruction{"derivatives of ln K", hts::accuracy::obstruction_gradient};
    WorstCase shadowing{"derivatives of ln S_1", hts::accuracy::shadowing_gradient};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Surface surface{table(row, "sigma_over_tau"), 1};
        const auto seen =
            hts::visibility_gradient(surface, Direction::from_degrees(table(row, "theta_deg"), 0));
        const auto where = [&] { return table.describe(row, {"theta_deg", "sigma_over_tau"}); };
        const auto beside = [&](double computed, const char* column) {
            const double expected = table(row, column);
            return std::abs(computed - expected) / (1 + std::abs(expected));
        };
        obstruction.note(relative_error(seen.log_obstruction_by_theta, table(row, "log_K_by_theta")), where);
        obstruction.note(relative_error(seen.log_obstruction_by_log_slope, table(row, "log_K_by_log_slope")),
                         where);
        shadowing.note(beside(seen.log_shadowing_by_theta, "log_S1_by_theta"), where);
        shadowing.note(beside(seen.log_shadowing_by_log_slope, "log_S1_by_log_slope"), where);
        shadowing.note(beside(seen.log_shadowing_by_log_slope, "log_S1_over_cos_by_log_slope"), where);
        shadowing.note(beside(seen.log_quotient_by_theta, "log_S1_over_cos_by_theta"), where);
        CHECK(seen.value.shadowing ==
              visibility(surface, Direction::from_degrees(table(row, "theta_deg"), 0)).shadowing);
    }
    obstruction.check();
    shadowing.check();
}

TEST_CASE("derivatives of shadowing where there is none") {
    for (const auto& [slope, theta] : {std::pair{0.3, 0.0}, {0.0, 50.0}, {1e-3, 50.0}}) {
        const auto seen = hts::visibility_gradient(Surface{slope, 1}, Direction::from_degrees(theta, 0));
        CHECK(seen.log_obstruction_by_theta == 0);
        CHECK(seen.log_obstruction_by_log_slope == 0);
        CHECK(seen.log_shadowing_by_theta == 0);
        CHECK(seen.log_shadowing_by_log_slope == 0);
        CHECK(seen.log_quotient_by_theta == Approx(std::tan(theta * std::numbers::pi / 180)));
    }
    const auto horizon = hts::visibility_gradient(Surface{0.3, 1}, Direction::from_degrees(90, 0));
    CHECK(horizon.log_quotient_by_theta ==
          Approx(std::sqrt(std::numbers::pi) / 0.6 - 2 / (0.6 * std::sqrt(std::numbers::pi))));
}

TEST_CASE("shadowing at the normal and at the horizon") {
    const Surface rough{0.3, 1};
    const auto normal = visibility(rough, Direction::from_degrees(0, 0));
    CHECK(normal.obstruction == 0);
    CHECK(normal.shadowing == 1);
    const auto horizon = visibility(rough, Direction::from_degrees(90, 0));
    CHECK(std::isinf(horizon.obstruction));
    CHECK(horizon.shadowing == 0);
    CHECK(horizon.shadowing_over_cosine == Approx(std::sqrt(std::numbers::pi) / 0.6).epsilon(1e-15));
    const auto near = visibility(rough, Direction::from_degrees(90 - 1e-9, 0));
    CHECK(near.shadowing_over_cosine == Approx(horizon.shadowing_over_cosine).epsilon(1e-9));
}

TEST_CASE("a mirror hides nothing") {
    const Surface mirror{0, 1};
    const auto slanted = visibility(mirror, Direction::from_degrees(60, 0));
    CHECK(slanted.obstruction == 0);
    CHECK(slanted.shadowing == 1);
    CHECK(slanted.shadowing_over_cosine == Approx(2).epsilon(1e-15));
    CHECK(visibility(mirror, Direction::from_degrees(90, 0)).shadowing_over_cosine == 0);
    // the limit of little roughness meets it
    CHECK(visibility(Surface{1e-20, 1}, Direction::from_degrees(60, 0)).shadowing == 1);
}

TEST_CASE("shadowing falls with angle and with slope") {
    for (const double slope : {0.01, 0.1, 1.0, 4.4}) {
        double before = 1;
        for (double theta = 1; theta <= 90; ++theta) {
            const auto seen = visibility(Surface{slope, 1}, Direction::from_degrees(theta, 0));
            CHECK(seen.shadowing <= before * (1 + 1e-15));
            const double gentler =
                visibility(Surface{slope / 2, 1}, Direction::from_degrees(theta, 0)).shadowing;
            CHECK(seen.shadowing <= gentler * (1 + 1e-15));
            before = seen.shadowing;
        }
    }
}
