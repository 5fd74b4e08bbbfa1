#include "spectral/statistics.hpp"

#include <catch2/catch.hpp>
#include <numeric>

using namespace hts::spectral;

TEST_CASE("places of a sorted list, and beyond its end stands the greatest value") {
    const std::vector<double> values{5, 1, 4, 2, 3};
    for (std::size_t place = 0; place < 5; ++place)
        CHECK(in_order(values, place) == static_cast<double>(place + 1));
    CHECK(in_order(values, 99) == 5);
    CHECK(in_order(std::vector<float>{}, 3) == 0);
}

TEST_CASE("a quantile is a value of the list: the one at the place below") {
    std::vector<float> values(101);
    std::iota(values.rbegin(), values.rend(), 0.0F);
    CHECK(quantile(values, 0) == 0);
    CHECK(quantile(values, 0.5) == 50);
    CHECK(quantile(values, 0.996) == 99);
    CHECK(quantile(values, 1) == 100);
    CHECK(quantile(std::vector<double>{1, 2, 3, 4}, 0.5) == 2);
    CHECK(quantile(std::vector<double>{7}, 0.9) == 7);
    CHECK(quantile(std::vector<double>{}, 0.5) == 0);
}

TEST_CASE("median and root mean square of lists") {
    CHECK(median({}) == 0);
    CHECK(median({6}) == 6);
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 3}) == 2.5);
    CHECK(median({2, 9}) == 5.5);
    CHECK(root_mean_square({}) == 0);
    CHECK(root_mean_square(std::vector{3.0, 4.0}) == Approx(std::sqrt(12.5)));
}
