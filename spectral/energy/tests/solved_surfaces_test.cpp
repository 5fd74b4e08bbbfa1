#include "spectral/energy/solved_surfaces.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "spectral/text/csv.hpp"

using namespace hts::spectral;
using hts::Direction;
using hts::Surface;

namespace {

constexpr double lambda = 0.7;
const hts::RefractiveIndex metal{1, 7};

hts::SpectralSample sample(const hts::RefractiveIndex& index) {
    return {hts::Wavelength::from_micrometres(lambda), index, 0};
}

}  // namespace

TEST_CASE("each surface that was solved is the nearest to itself") {
    const auto table = CsvTable::read(HTS_SOURCE_DIR "/spectral/energy/data/vector-distances.csv");
    REQUIRE(table.row_count() >= 21);
    const Direction axis = Direction::from_angles(std::numbers::pi / 2, 0.3);
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const auto number = [&](const char* column) { return table.number(row, table.column(column)); };
        const Surface surface = Surface::anisotropic(
            number("sigma0_over_lambda") * lambda,
            {number("tau_x_over_lambda") * lambda, number("tau_y_over_lambda") * lambda}, axis);
        const Direction in = Direction::from_angles(number("theta_i_deg") * std::numbers::pi / 180,
                                                    0.3 + number("azimuth_deg") * std::numbers::pi / 180);
        const auto found = nearest_solved(surface, sample(metal), in);
        REQUIRE(found);
        CHECK(found->he.ss == number("he_ss_db"));
        CHECK(found->he.unpolarised == number("he_db"));
        CHECK(found->unified.cross == number("he_unified_cross_db"));
        CHECK(found->theta_i_deg == number("theta_i_deg"));
    }
}

TEST_CASE("what no solved surface stands for has none") {
    const Direction in = Direction::from_degrees(40, 10);
    const Surface known{0.2 * lambda, 1 * lambda};
    REQUIRE(nearest_solved(known, sample(metal), in));
    CHECK(nearest_solved(Surface{0.22 * lambda, 1.1 * lambda}, sample(metal), Direction::from_degrees(45, 0))
              ->rms_roughness == 0.2);
    CHECK_FALSE(nearest_solved(known, sample({1.5, 0}), in));
    CHECK_FALSE(nearest_solved(known, sample(metal), Direction::from_degrees(75, 0)));
    CHECK_FALSE(nearest_solved(Surface{0.2 * lambda, 4 * lambda}, sample(metal), in));
    CHECK_FALSE(nearest_solved(Surface{2 * lambda, 1 * lambda}, sample(metal), in));
    const Surface grooves =
        Surface::anisotropic(0.2 * lambda, {20 * lambda, 0.7 * lambda}, Direction::from_degrees(90, 45));
    CHECK_FALSE(nearest_solved(grooves, sample(metal), Direction::from_degrees(40, 0)));
    CHECK_FALSE(nearest_solved(Surface{0, lambda}, sample(metal), in));
    CHECK_FALSE(nearest_solved(known.correlated(hts::Correlation::exponential()), sample(metal), in));
}
