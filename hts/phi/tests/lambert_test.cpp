#include "hts/phi/lambert.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "comparison.hpp"

using hts::lambert_w0_of_square;
using hts::testing::WorstCase;

TEST_CASE("Lambert's W solves its equation over the whole range of a double") {
    WorstCase worst{"W_0(a^2), residual of w + ln w = 2 ln a", hts::accuracy::lambert};
    for (double a = 0.5; a < 1e307; a *= 3.7) {
        const double w = lambert_w0_of_square(a);
        // d(w + ln w) = (1 + w) dw/w
        worst.note(std::abs(w + std::log(w) - 2 * std::log(a)) / (1 + w), [a] { return std::to_string(a); });
    }
    worst.check();
}

TEST_CASE("Lambert's W at its ends and across its two forms") {
    CHECK(lambert_w0_of_square(0) == 0);
    CHECK(lambert_w0_of_square(1e-200) == 0);
    CHECK(lambert_w0_of_square(std::sqrt(std::exp(1.0))) == Approx(1).epsilon(1e-15));
    CHECK(lambert_w0_of_square(1e140 * (1 - 1e-13)) == Approx(lambert_w0_of_square(1e140)).epsilon(1e-14));
    CHECK(std::isfinite(lambert_w0_of_square(std::numeric_limits<double>::max())));
}
