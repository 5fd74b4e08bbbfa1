#include "hts/tolerance.hpp"

#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "hts/error.hpp"

using hts::Tolerance;

TEST_CASE("a tolerance keeps its relative error") {
    static_assert(Tolerance{1e-6}.relative_error() == 1e-6);
    CHECK(Tolerance{1e-12}.relative_error() == 1e-12);
    CHECK(Tolerance{1}.relative_error() == 1);
}

TEST_CASE("a tolerance that cannot be met is refused") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad :
         {0.9e-12, 0.0, -1e-3, 1.0000001, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_AS(Tolerance{bad}, hts::Error);
    }
    CHECK_THROWS_WITH(Tolerance{1e-13}, "tolerance 1e-13: must be a relative error from 1e-12 to 1");
}
