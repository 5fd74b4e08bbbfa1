#include "validation/pictures/letter.hpp"

#include <set>
#include <string>

#include <catch2/catch.hpp>

using namespace hts::validation;

namespace {

Picture grey(std::size_t width, std::size_t height) {
    return {width, height, std::vector<hts::spectral::Xyz>(width * height, {0.2, 0.2, 0.2})};
}

/// '#' where a pixel is black, 'o' where it is white, '.' where it is as before.
std::string shown_corner(const Picture& picture, std::size_t width, std::size_t height) {
    std::string text;
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const double luminance = picture.pixels[y * picture.width + x].Y;
            text += luminance == 0 ? '#' : luminance == 0.2 ? '.' : 'o';
        }
        text += '\n';
    }
    return text;
}

}  // namespace

TEST_CASE("a letter stands in the upper left corner") {
    Picture picture = grey(100, 50);
    put_letter(picture, 0);
    CHECK(shown_corner(picture, 18, 12) ==
          "ooooooooooooooooo.\n"
          "ooooooooooooooooo.\n"
          "oooo#ooooooo#oooo.\n"
          "ooo#ooooooooo#ooo.\n"
          "ooo#ooo###ooo#ooo.\n"
          "ooo#oooooo#oo#ooo.\n"
          "ooo#ooo####oo#ooo.\n"
          "ooo#oo#ooo#oo#ooo.\n"
          "oooo#oo####o#oooo.\n"
          "ooooooooooooooooo.\n"
          "ooooooooooooooooo.\n"
          "..................\n");
}

TEST_CASE("letters differ, grow with the panel, and end at the last") {
    std::set<std::string> all;
    for (std::size_t place = 0; place < letters; ++place) {
        Picture picture = grey(320, 100);
        put_letter(picture, place);
        all.insert(shown_corner(picture, 36, 24));
        CHECK(picture.pixels[34].Y == 0.2);  // two pixels a dot
        CHECK(picture.pixels[33].Y != 0.2);
    }
    CHECK(all.size() == letters);
    Picture picture = grey(320, 100), small = grey(3, 2);
    put_letter(picture, letters);
    CHECK(picture.pixels[0].Y == 0.2);
    put_letter(small, 1);
    CHECK(small.pixels.size() == 6);
}
