#include "spectral/text/png.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "hts/error.hpp"
#include "temporary_folder.hpp"

using namespace hts::spectral;

TEST_CASE("what is written as PNG is read back to the byte") {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 7 * 5 * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(37 * i));
    const PngPixels pixels = png_pixels(png_bytes(7, 5, rgb));
    CHECK(pixels.width == 7);
    CHECK(pixels.height == 5);
    CHECK(pixels.rgb == rgb);
}

TEST_CASE("the luminance of a PNG file is linear in light") {
    const hts::testing::TemporaryFolder folder;
    const std::vector<std::uint8_t> rgb{0, 0, 0, 128, 128, 128, 255, 255, 255, 255, 0, 0};
    const auto path = folder.write("picture.png", png_bytes(2, 2, rgb));
    const hts::ValueGrid grid = read_png_luminance(path);
    CHECK(grid.rows == 2);
    CHECK(grid.columns == 2);
    CHECK(grid.values[0] == 0);
    CHECK(grid.values[1] == Approx(0.2158605).epsilon(1e-3));
    CHECK(grid.values[2] == Approx(1).epsilon(1e-12));
    CHECK(grid.values[3] == Approx(0.2126).epsilon(2e-3));  // red of sRGB
}

TEST_CASE("what is no PNG is refused by name") {
    const hts::testing::TemporaryFolder folder;
    CHECK_THROWS_WITH(read_png_luminance("/nowhere/a.png"),
                      Catch::Contains("/nowhere/a.png: cannot be read"));
    const auto text = folder.write("text.png", "no picture at all");
    CHECK_THROWS_WITH(read_png_luminance(text),
                      Catch::Contains("text.png: cannot be read: must be a PNG file"));
    const std::vector<std::uint8_t> rgb(48, 100);
    const std::string bytes = png_bytes(4, 4, rgb);
    CHECK_THROWS_AS(png_pixels(bytes.substr(0, bytes.size() / 2)), hts::Error);
    CHECK_THROWS_WITH(png_bytes(3, 4, rgb), Catch::Contains("three for each"));
}
