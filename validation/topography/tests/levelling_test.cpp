#include "validation/topography/levelling.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hts/sampling/random.hpp"

using namespace hts::validation;

namespace {

HeightMap sloping(double bow, double noise, const std::vector<std::pair<std::size_t, double>>& changed = {}) {
    hts::Random random{3};
    std::vector<double> heights;
    for (std::size_t j = 0; j < 20; ++j) {
        for (std::size_t i = 0; i < 30; ++i) {
            const double x = 0.5 * static_cast<double>(i), y = -0.5 * static_cast<double>(j);
            heights.push_back(7 + 0.2 * x - 0.1 * y + bow * x * y + noise * random.uniform(-1, 1));
        }
    }
    for (const auto& [place, height] : changed) heights[place] = height;
    return {"sloping", 30, 20, 0.5, 0.5, heights};
}

double largest(const HeightMap& map) {
    double most = 0;
    for (const double z : map.heights()) most = std::isnan(z) ? most : std::max(most, std::fabs(z));
    return most;
}

}  // namespace

TEST_CASE("levels take off what they name, and tilt is told") {
    const LevelledMap plane = levelled(sloping(0, 0), {Level::plane, Gaps::mask, 0});
    CHECK(largest(plane.map) < 1e-12);
    CHECK(plane.tilt_x == Approx(0.2));
    CHECK(plane.tilt_y == Approx(-0.1));
    CHECK(largest(levelled(sloping(0.03, 0), {Level::plane, Gaps::mask, 0}).map) > 0.1);
    CHECK(largest(levelled(sloping(0.03, 0), {Level::quadratic, Gaps::mask, 0}).map) < 1e-11);
    CHECK(largest(levelled(sloping(0, 0), {Level::mean, Gaps::mask, 0}).map) > 1);
}

TEST_CASE("outliers are marked, and nothing else") {
    const auto map = sloping(0.01, 0.05, {{77, 9.9}, {200, 30.0}, {421, -4.0}, {500, std::nan("")}});
    const LevelledMap found = levelled(map, {Level::plane, Gaps::mask, 8});
    CHECK(found.outliers == 3);
    CHECK(found.gaps == 1);
    for (const std::size_t place : {77U, 200U, 421U, 500U}) CHECK(std::isnan(found.map.heights()[place]));
    CHECK(levelled(map, {Level::plane, Gaps::mask, 0}).outliers == 0);
}

TEST_CASE("gaps are filled by what lies about them") {
    const auto map =
        sloping(0, 0, {{0, std::nan("")}, {155, std::nan("")}, {156, std::nan("")}, {599, std::nan("")}});
    const LevelledMap found = levelled(map, {Level::mean, Gaps::fill, 0});
    CHECK(found.map.value_count() == 600);
    // a plane is harmonic: inside, gaps come back exactly
    const double step = found.map.at(7, 5) - found.map.at(6, 5);
    CHECK(found.map.at(5, 5) - found.map.at(4, 5) == Approx(step).epsilon(1e-9));
    CHECK(step == Approx(0.1).epsilon(1e-9));
}
