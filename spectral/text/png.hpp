/// Pictures as PNG files, by libpng: written as sRGB, read as light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hts/microfacet/normals/normal_density.hpp"

namespace hts::spectral {

/// The bytes of a PNG file with 8 bits per component.
///   rgb   red, green, blue of each pixel as sent to a screen (DisplayRgb::eight_bit), by rows from the top;
///         width * height * 3, at least one pixel, else hts::Error
[[nodiscard]] std::string png_bytes(std::size_t width, std::size_t height, std::span<const std::uint8_t> rgb);

/// Components of a PNG file as sent to a screen.
struct PngPixels {
    std::size_t width, height;
    std::vector<std::uint8_t> rgb;  ///< by rows from the top; transparent pixels over black
};

/// From the bytes of a PNG file of any kind; hts::Error that says what is wrong with them.
[[nodiscard]] PngPixels png_pixels(std::string_view bytes);

/// The luminance of a PNG file of any kind, 0 ... 1, linear in light (sRGB's middle grey of 128 is 0.216);
/// transparent pixels over black. hts::Error "path: …" if it is missing, no PNG, or larger than 4096 by 4096.
[[nodiscard]] ValueGrid read_png_luminance(const std::filesystem::path& path);

/// The grey levels of a PNG file of 16 bits, 0 … 65535 as they stand there: of data, not of light. hts::Error
/// where the file has colours, transparency or fewer bits, more than `most` pixels, or is damaged.
[[nodiscard]] ValueGrid png_grey_levels(std::string_view bytes, std::size_t most);

}  // namespace hts::spectral
