#include "validation/pictures/letter.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "spectral/colour/display_colour.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t glyph_height = 7;
using Glyph = std::array<std::string_view, glyph_height>;

constexpr Glyph left_bracket{"..#", ".#.", ".#.", ".#.", ".#.", ".#.", "..#"};
constexpr Glyph right_bracket{"#..", ".#.", ".#.", ".#.", ".#.", ".#.", "#.."};
constexpr std::array<Glyph, letters> alphabet{{
    {".....", ".....", ".###.", "....#", ".####", "#...#", ".####"},
    {"#....", "#....", "####.", "#...#", "#...#", "#...#", "####."},
    {".....", ".....", ".###.", "#....", "#....", "#...#", ".###."},
    {"....#", "....#", ".####", "#...#", "#...#", "#...#", ".####"},
    {".....", ".....", ".###.", "#...#", "#####", "#....", ".###."},
    {"..##.", ".#..#", ".#...", "###..", ".#...", ".#...", ".#..."},
}};

/// Of a letter in parentheses: whether a dot of it is black, counted from its upper left corner.
bool is_black(std::size_t place, std::size_t column, std::size_t row) {
    for (const Glyph& glyph : {left_bracket, alphabet[place], right_bracket}) {
        const std::size_t width = glyph[row].size();
        if (column < width) return glyph[row][column] == '#';
        if (column == width) return false;
        column -= width + 1;
    }
    return false;
}

}  // namespace

void put_letter(Picture& panel, std::size_t place) {
    constexpr std::size_t margin = 2, across = 13 + 2 * margin, down = glyph_height + 2 * margin;
    if (place >= letters) return;
    const std::size_t dot = std::max<std::size_t>(1, panel.width / 150);  // a pixel of the letter, in pixels
    const auto white = spectral::white_point(spectral::Illuminant::D65);
    for (std::size_t y = 0; y < std::min(panel.height, down * dot); ++y) {
        for (std::size_t x = 0; x < std::min(panel.width, across * dot); ++x) {
            const std::size_t column = x / dot, row = y / dot;
            const bool inside = column >= margin && row >= margin && row < margin + glyph_height;
            const bool black = inside && is_black(place, column - margin, row - margin);
            panel.pixels[y * panel.width + x] = black ? spectral::Xyz{} : white;
        }
    }
}

}  // namespace hts::validation
