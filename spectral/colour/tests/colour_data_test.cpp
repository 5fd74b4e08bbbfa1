#include "spectral/colour/colour_data.hpp"

#include <catch2/catch.hpp>

#include "colour_comparison.hpp"
#include "spectral/colour/colour.hpp"

using namespace hts::spectral;
using namespace hts::testing;

TEST_CASE("the tables have the CIE's sums and landmarks", "[colour_data]") {
    Xyz sum{0, 0, 0};
    double d65 = 0;
    double nanometres = 360;
    for (const ColourRow& row : colour_rows) {
        CHECK(row.nanometres == nanometres);
        nanometres += 5;
        sum = sum + Xyz{row.x, row.y, row.z};
        d65 += row.d65;
    }
    // Sums over the 5 nm values; times 5 they are those at 1 nm, 106.8655, 106.8569 and 106.8923.
    CHECK(sum.X == Approx(21.373139988621).epsilon(1e-13));
    CHECK(sum.Y == Approx(21.371407850470).epsilon(1e-13));
    CHECK(sum.Z == Approx(21.378664308990).epsilon(1e-13));
    CHECK(d65 == Approx(7880.3178).epsilon(1e-13));
    check_at_most("5 nm sums against 1 nm sums, relative",
                  worst_of(5 * sum, {106.8655, 106.8569, 106.8923}) / 106.8655, 1e-5);
    CHECK(colour_matching(0.555).Y == Approx(1).epsilon(1e-12));
    CHECK(relative_power(0.560, Illuminant::D65) == Approx(100).epsilon(1e-12));
}
