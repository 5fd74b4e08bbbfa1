#include "spectral/colour/display_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "colour_comparison.hpp"
#include "comparison.hpp"

using namespace hts::spectral;
using namespace hts::testing;

TEST_CASE("the perfect white is white on the screen", "[display_colour]") {
    for (const Illuminant illuminant : both) {
        for (const auto& wavelengths : {grid(0.4, 0.7, 2), grid(0.38, 0.78, 41), grid(0.2, 2.5, 1000)}) {
            const std::vector<double> ones(wavelengths.size(), 1);
            const Xyz white = tristimulus(wavelengths, ones, illuminant);
            const LinearRgb rgb = linear_srgb(white, illuminant);
            CHECK(worst_of(rgb, {1, 1, 1}) < 1e-13);
            const DisplayRgb display = DisplayRgb::from_linear(rgb);
            CHECK(display.in_gamut());
            CHECK(display.hex() == "#ffffff");
        }
    }
}

TEST_CASE("bands of blue, green and red are that on the screen", "[display_colour]") {
    for (const Illuminant illuminant : both) {
        const LinearRgb at_450 = linear_srgb(band(450, illuminant), illuminant),
                        at_530 = linear_srgb(band(530, illuminant), illuminant),
                        at_630 = linear_srgb(band(630, illuminant), illuminant);
        CHECK(at_450.blue > std::max(at_450.red, at_450.green));
        CHECK(at_530.green > std::max(at_530.red, at_530.blue));
        CHECK(at_630.red > std::max(at_630.green, at_630.blue));
        CHECK_FALSE(DisplayRgb::from_linear(at_530).in_gamut());
    }
}

TEST_CASE("Bradford adaptation agrees with the matrices of B. Lindbloom", "[display_colour]") {
    const Xyz d65{0.95047, 1, 1.08883};  // the whites that he uses
    struct Case {
        Xyz from, of_x, of_y, of_z;
    };
    const std::vector<Case> cases = {
        {{1, 1, 1},
         {0.9531874, -0.0382467, 0.0026068},
         {-0.0265906, 1.0288406, -0.0030332},
         {0.0238731, 0.0094060, 1.0892565}},
        {{1.09850, 1, 0.35585},
         {0.8446965, -0.1366303, 0.0798489},
         {-0.1179225, 1.1041226, -0.1348999},
         {0.3948108, 0.1291718, 3.1924009}},
    };
    double worst = 0;
    for (const Case& c : cases) {
        worst = std::max(worst, worst_of(bradford_adaptation({1, 0, 0}, c.from, d65), c.of_x));
        worst = std::max(worst, worst_of(bradford_adaptation({0, 1, 0}, c.from, d65), c.of_y));
        worst = std::max(worst, worst_of(bradford_adaptation({0, 0, 1}, c.from, d65), c.of_z));
        CHECK(worst_of(bradford_adaptation(c.from, c.from, d65), d65) < 1e-14);
    }
    check_at_most("Bradford matrices, printed with 7 decimals", worst, 1e-7);
}

TEST_CASE("linear sRGB follows the matrices of IEC 61966-2-1", "[display_colour]") {
    // Printed with four decimals, for a white 1e-4 from that of the table.
    check_at_most(
        "XYZ of the sRGB primaries",
        std::max({worst_of(tristimulus(LinearRgb{1, 0, 0}, Illuminant::D65), {0.4124, 0.2126, 0.0193}),
                  worst_of(tristimulus(LinearRgb{0, 1, 0}, Illuminant::D65), {0.3576, 0.7152, 0.1192}),
                  worst_of(tristimulus(LinearRgb{0, 0, 1}, Illuminant::D65), {0.1805, 0.0722, 0.9505})}),
        1e-4);
    check_at_most("linear sRGB of X, Y, Z",
                  std::max({worst_of(linear_srgb({1, 0, 0}, Illuminant::D65), {3.2406, -0.9689, 0.0557}),
                            worst_of(linear_srgb({0, 1, 0}, Illuminant::D65), {-1.5372, 1.8758, -0.2040}),
                            worst_of(linear_srgb({0, 0, 1}, Illuminant::D65), {-0.4986, 0.0415, 1.0570})}),
                  1e-3);
}

TEST_CASE("the way to the screen can be gone back", "[display_colour]") {
    Random random{7};
    double worst_xyz = 0, worst_display = 0;
    for (int i = 0; i < 10000; ++i) {
        const LinearRgb rgb{random.uniform(0, 1), std::pow(random.uniform(0, 1), 8),
                            std::exp(-20 * random.uniform(0, 1))};
        for (const Illuminant illuminant : both) {
            worst_xyz =
                std::max(worst_xyz, worst_of(linear_srgb(tristimulus(rgb, illuminant), illuminant), rgb));
        }
        const DisplayRgb display = DisplayRgb::from_linear(rgb);
        CHECK(display.in_gamut());
        worst_display = std::max(worst_display, worst_of(display.linear(), rgb));
    }
    for (const double joint : {0.0031307, 0.0031308, std::nextafter(0.0031308, 1.), 0.0031309}) {
        const LinearRgb rgb{joint, joint, joint};
        worst_display = std::max(worst_display, worst_of(DisplayRgb::from_linear(rgb).linear(), rgb));
    }
    check_at_most("linear sRGB over XYZ and back", worst_xyz, 5e-15);
    check_at_most("linear sRGB over display sRGB and back", worst_display, hts::accuracy::srgb_round_trip);
}

TEST_CASE("display sRGB encodes, clips and reports", "[display_colour]") {
    CHECK(DisplayRgb::from_linear({0.18, 0.18, 0.18}).red() == Approx(0.46135613).epsilon(1e-7));
    CHECK(DisplayRgb::from_linear({0.002, 0, 1}).red() == Approx(0.02584).epsilon(1e-12));
    CHECK(DisplayRgb::from_linear({0.21586050, 0, 1}).hex() == "#8000ff");
    const auto bytes = DisplayRgb::from_linear({0.0331047666, 0.5271151257, 0.0802198203}).eight_bit();
    CHECK(bytes == std::array<std::uint8_t, 3>{51, 192, 80});

    const DisplayRgb clipped = DisplayRgb::from_linear({-0.1, 0.5, 3});
    CHECK_FALSE(clipped.in_gamut());
    CHECK(clipped.red() == 0);
    CHECK(clipped.green() > 0);
    CHECK(clipped.blue() == 1);
    CHECK(clipped.hex() == "#00bcff");
    CHECK(DisplayRgb::from_linear({-1e-12, 1 + 1e-12, 0}).in_gamut());
    CHECK_FALSE(DisplayRgb::from_linear({-1e-6, 0, 0}).in_gamut());
    CHECK_FALSE(DisplayRgb::from_linear({0, 1 + 1e-6, 0}).in_gamut());

    const double infinity = std::numeric_limits<double>::infinity();
    const DisplayRgb broken = DisplayRgb::from_linear({std::nan(""), infinity, -infinity});
    CHECK_FALSE(broken.in_gamut());
    CHECK(broken.red() == 0);
    CHECK(broken.hex() == "#00ff00");
}

TEST_CASE("each component out of gamut is reported and clipped by itself", "[display_colour]") {
    const double infinity = std::numeric_limits<double>::infinity();
    struct Case {
        double component, clipped;
    };
    const std::vector<Case> cases = {{std::nan(""), 0}, {-std::nan(""), 0}, {infinity, 1}, {-infinity, 0},
                                     {-1e-6, 0},        {1 + 1e-6, 1},      {-1e300, 0},   {1e300, 1}};
    for (const auto& [component, clipped] : cases) {
        INFO(component);
        const DisplayRgb red = DisplayRgb::from_linear({component, 0.5, 0.5});
        const DisplayRgb green = DisplayRgb::from_linear({0.5, component, 0.5});
        const DisplayRgb blue = DisplayRgb::from_linear({0.5, 0.5, component});
        CHECK(red.red() == clipped);
        CHECK(green.green() == clipped);
        CHECK(blue.blue() == clipped);
        for (const DisplayRgb& display : {red, green, blue}) CHECK_FALSE(display.in_gamut());
    }
}
