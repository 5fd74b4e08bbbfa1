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
    const ReferenceTable table{"shadowing.csv"};
    WorstCase shadowing{"S_1", hts::accuracy::shadowing};
    WorstCase quotient{"S_1 / cos theta", hts::accuracy::shadowing};
    WorstCase obstruction{"K, absolute below 1", hts::accuracy::obstruction};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Surface surface{table(row, "sigma_over_tau"), 1};
        const auto computed = visibility(surface, Direction::from_degrees(table(row, "theta_deg"), 0));
        const auto where = [&] { return table.describe(row, {"theta_deg", "sigma_over_tau"}); };
        shadowing.note(relative_error(computed.shadowing, table(row, "S1")), where);
        quotient.note(relative_error(computed.shadowing_over_cosine, table(row, "S1_over_cos")), where);
        const double expected = table(row, "K");
        obstruction.note(std::abs(computed.obstruction - expected) / std::fmax(1, expected), where);
    }
    shadowing.check();
    quotient.check();
    obstruction.check();
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
