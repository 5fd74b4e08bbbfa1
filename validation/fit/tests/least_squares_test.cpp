#include "validation/fit/least_squares.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "hts/tests/support/comparison.hpp"

using namespace hts::validation;
using hts::testing::Random;

TEST_CASE("bounded linear least squares finds what a search finds") {
    Random random{3};
    for (int trial = 0; trial < 200; ++trial) {
        Columns columns(4, std::vector<double>(9));
        for (auto& column : columns) {
            for (double& x : column) x = random.uniform(-1, 1);
        }
        std::vector<double> target(9);
        for (double& x : target) x = random.uniform(-2, 2);
        const std::vector<Bounds> bounds{{0, 1}, {0, 0.5}, {-0.2, 0.2}, {0, 1e6}};
        const auto x = bounded_linear_solution(columns, target, bounds);
        // the conditions of Karush, Kuhn and Tucker, which only the minimum of a convex problem fulfils
        for (std::size_t j = 0; j < x.size(); ++j) {
            double gradient = 0;
            for (std::size_t i = 0; i < target.size(); ++i) {
                double rest = -target[i];
                for (std::size_t k = 0; k < x.size(); ++k) rest += x[k] * columns[k][i];
                gradient += rest * columns[j][i];
            }
            REQUIRE(x[j] >= bounds[j].lowest);
            REQUIRE(x[j] <= bounds[j].highest);
            if (x[j] > bounds[j].lowest) CHECK(gradient < 1e-12);
            if (x[j] < bounds[j].highest) CHECK(gradient > -1e-12);
        }
    }
}
