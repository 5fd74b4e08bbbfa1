#include "spectral/colour/colour_difference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "colour_comparison.hpp"
#include "spectral/colour/display_colour.hpp"

using namespace hts::spectral;
using namespace hts::testing;

TEST_CASE("CIELAB of landmarks", "[colour_difference]") {
    const Xyz white = white_point(Illuminant::D65);
    const auto lab = [&](const LinearRgb& rgb) { return cielab(tristimulus(rgb, Illuminant::D65), white); };
    CHECK(cielab(white, white).L == Approx(100).epsilon(1e-14));
    CHECK(std::abs(cielab(white, white).a) + std::abs(cielab(white, white).b) < 1e-12);
    CHECK(cielab({0, 0, 0}, white).L == Approx(0).margin(1e-13));
    CHECK(cielab(0.125 * white, white).L == Approx(42).epsilon(1e-13));
    CHECK(cielab(216. / 24389 * white, white).L == Approx(8).epsilon(1e-12));  // where the two branches meet
    CHECK(cielab(0.001 * white, white).L == Approx(0.9032963).epsilon(1e-6));  // 24389/27 Y below
    // The primary red of sRGB under D65, as tabulated for (0.3127, 0.3290).
    CHECK(lab({1, 0, 0}).L == Approx(53.24).margin(0.02));
    CHECK(lab({1, 0, 0}).a == Approx(80.09).margin(0.05));
    CHECK(lab({1, 0, 0}).b == Approx(67.20).margin(0.05));
}

TEST_CASE("CIEDE2000 reproduces the 34 pairs of Sharma, Wu and Dalal", "[colour_difference]") {
    struct Pair {
        Lab a, b;
        double difference;
    };
    // Table 1 of Color Res. Appl. 30, 21 (2005); ciede2000testdata.txt on the first author's page.
    const std::vector<Pair> pairs = {
        {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
        {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
        {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
        {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
        {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
        {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
        {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
        {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
        {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
        {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
        {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
        {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
        {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
        {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
        {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
        {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
        {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
        {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
        {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
        {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
        {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
        {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
        {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
        {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
        {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
        {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
        {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
        {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
        {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
        {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
        {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    double worst = 0, asymmetry = 0;
    for (const Pair& p : pairs) {
        worst = std::max(worst, std::abs(colour_difference(p.a, p.b) - p.difference));
        asymmetry = std::max(asymmetry, std::abs(colour_difference(p.a, p.b) - colour_difference(p.b, p.a)));
        CHECK(colour_difference(p.a, p.a) == 0);
    }
    check_at_most("CIEDE2000, printed with 4 decimals", worst, 5.001e-5);
    check_at_most("asymmetry of CIEDE2000", asymmetry, 1e-12);
}
