#include "validation/fit/least_squares.hpp"

#include <catch2/catch.hpp>

#include "hts/tests/support/comparison.hpp"

using namespace hts;
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

TEST_CASE("what is left beside columns is at right angles to them") {
    Random random{8};
    Columns columns(3, std::vector<double>(7)), others(2, std::vector<double>(7));
    for (Columns* matrix : {&columns, &others}) {
        for (auto& column : *matrix) {
            for (double& x : column) x = random.uniform(-1, 1);
        }
    }
    others.push_back(others.front());  // which depends on another
    const Columns left = beside(columns, others);
    for (const auto& column : left) {
        for (const auto& other : others) {
            double sum = 0;
            for (std::size_t i = 0; i < column.size(); ++i) sum += column[i] * other[i];
            CHECK(sum == Approx(0).margin(1e-14));
        }
    }
    CHECK(beside(left, others)[1][3] == Approx(left[1][3]).epsilon(1e-13));
    CHECK(beside(columns, {}) == columns);
}
