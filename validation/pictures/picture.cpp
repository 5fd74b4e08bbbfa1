#include "validation/pictures/picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hts/error.hpp"
#include "spectral/colour/display_colour.hpp"
#include "spectral/text/png.hpp"

namespace hts::validation {
namespace {

std::array<std::uint8_t, 3> eight_bit(const spectral::Xyz& colour) {
    const auto [red, green, blue] = linear_srgb(colour, spectral::Illuminant::D65);
    const double largest = std::max({red, green, blue});
    const double factor = largest > 0 ? shown(largest) / largest : 0;
    return spectral::DisplayRgb::from_linear({factor * red, factor * green, factor * blue}).eight_bit();
}

}  // namespace

double shown(double brightness) noexcept {
    const double over = (brightness - shoulder) / (1 - shoulder);
    return over <= 0 ? brightness : shoulder - (1 - shoulder) * std::expm1(-over);
}

std::string png(const Picture& picture) {
    std::vector<std::uint8_t> components;
    for (const spectral::Xyz& pixel : picture.pixels) {
        for (const std::uint8_t component : eight_bit(pixel)) components.push_back(component);
    }
    return spectral::png_bytes(picture.width, picture.height, components);
}

Picture panels(const std::vector<Picture>& pictures, std::size_t columns, std::size_t gap) {
    if (pictures.empty() || columns == 0) throw Error{"panels of a picture: must be at least one"};
    const Picture& first = pictures.front();
    const std::size_t rows = (pictures.size() + columns - 1) / columns;
    Picture whole{columns * (first.width + gap) - gap, rows * (first.height + gap) - gap, {}};
    whole.pixels.assign(whole.width * whole.height, spectral::white_point(spectral::Illuminant::D65));
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        const Picture& panel = pictures[k];
        if (panel.width != first.width || panel.height != first.height) {
            throw Error{"panels of a picture: must be of equal size"};
        }
        const std::size_t left = k % columns * (panel.width + gap), top = k / columns * (panel.height + gap);
        for (std::size_t row = 0; row < panel.height; ++row) {
            std::copy_n(panel.pixels.begin() + static_cast<std::ptrdiff_t>(row * panel.width), panel.width,
                        whole.pixels.begin() + static_cast<std::ptrdiff_t>((top + row) * whole.width + left));
        }
    }
    return whole;
}

}  // namespace hts::validation
