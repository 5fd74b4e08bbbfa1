#include "tables/table/spline.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/tests/support/comparison.hpp"
#include "tables/table/crc64.hpp"
#include "tables/table/table_coordinates.hpp"

namespace {

using namespace hts;
using namespace hts::tables;

double spline_error(double (*f)(double), std::size_t nodes, SplineStart start) {
    std::vector<double> c(nodes + spline_ghosts);
    for (std::size_t i = 0; i < nodes; ++i)
        c[i + 1] = f(static_cast<double>(i) / static_cast<double>(nodes - 1));
    to_spline_coefficients(c, nodes, 1, start);
    double worst = 0;
    for (double x = 0; x <= 1; x += 0.001) {
        const SplinePlace place = spline_place(x, nodes);
        double value = 0;
        for (std::size_t k = 0; k < 4; ++k) value += place.weights[k] * c[place.first + k];
        worst = std::max(worst, std::abs(value - f(x)));
    }
    return worst;
}

}  // namespace

TEST_CASE("splines are exact for cubics, and for even ones from an even start") {
    for (const std::size_t nodes : {fewest_nodes, std::size_t{6}, std::size_t{17}}) {
        CHECK(spline_error([](double x) { return 1 + x * (2 - x * (3 - 4 * x)); }, nodes, SplineStart::free) <
              1e-14);
        CHECK(spline_error([](double x) { return 1 - 3 * x * x; }, nodes, SplineStart::even) < 1e-14);
    }
}

TEST_CASE("splines are of fourth order") {
    const auto wave = [](double x) { return std::cos(5 * x); };
    for (const auto start : {SplineStart::free, SplineStart::even}) {
        const double ratio = spline_error(wave, 65, start) / spline_error(wave, 129, start);
        INFO("errors fall by a factor of " << ratio);
        CHECK(ratio > 12);
    }
}

TEST_CASE("CRC-64 of the standard text, and in parts") {
    CHECK(crc64("123456789") == 0x995dc9bbdf1939fa);
    CHECK(crc64("56789", crc64("1234")) == crc64("123456789"));
    CHECK(crc64("") == 0);
}

TEST_CASE("coordinates lead back to the pair, and know every symmetry") {
    hts::testing::Random random{3};
    hts::testing::WorstCase back{"coordinates there and back", 1e-9},
        exchanged{"light and view exchanged", 1e-13}, turned{"turned about the normal", 1e-9};
    for (int i = 0; i < 20'000; ++i) {
        const CoordinateMap map{{random.logarithmic(0.1, 100), random.logarithmic(0.1, 100)}};
        const double theta_i = random.uniform(0, steepest_theta), theta_r = random.uniform(0, steepest_theta);
        const double phi = random.uniform(-7, 7), turn = random.uniform(-7, 7);
        const DirectionPair pair{Direction::from_angles(theta_i, 0), Direction::from_angles(theta_r, phi)};
        const auto where = [&] {
            return std::to_string(theta_i) + " " + std::to_string(theta_r) + " " + std::to_string(phi);
        };
        const auto difference = [](const Coordinates& a, const Coordinates& b) {
            return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
        };
        const Coordinates at = map(pair);
        for (const double x : at) REQUIRE((x >= 0 && x <= 1));
        back.note(difference(map(map.pair(at)), at), where);
        exchanged.note(difference(map({pair.out, pair.in}), at), where);
        turned.note(difference(map({Direction::from_angles(theta_i, turn),
                                    Direction::from_angles(theta_r, turn - phi)}),
                               at),
                    where);
    }
    back.check();
    exchanged.check();
    turned.check();
}
