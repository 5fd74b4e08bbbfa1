#include "spectral/text/png.hpp"

#include <png.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

/// libpng's simplified interface: a struct that is told what one wants and that frees what it holds.
class Image {
  public:
    Image() { image_.version = PNG_IMAGE_VERSION; }
    ~Image() { png_image_free(&image_); }
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    png_image* operator->() noexcept { return &image_; }
    png_image* get() noexcept { return &image_; }
    [[nodiscard]] Error error() const { return Error{std::string{"PNG: "} + image_.message}; }

    void begin_reading(std::string_view bytes) {
        if (png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()) == 0) throw error();
    }
    /// All components, over black.
    template <class Component>
    [[nodiscard]] std::vector<Component> read(png_uint_32 format) {
        image_.format = format;
        std::vector<Component> components(PNG_IMAGE_SIZE(image_) / sizeof(Component));
        const png_color black{0, 0, 0};
        if (png_image_finish_read(&image_, &black, components.data(), 0, nullptr) == 0) throw error();
        return components;
    }

  private:
    png_image image_{};
};

/// Light of a component of sRGB, 0 ... 1 [IEC61966]; libpng itself takes a plain power of 2.2.
double light(std::uint8_t component) {
    const double value = component / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file{path_to_read(path), std::ios::binary};
    // a device may have no end: read on only what begins as a PNG file does
    constexpr std::string_view signature{"\x89PNG\r\n\x1A\n", 8};
    std::string bytes(signature.size(), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (file && bytes == signature) bytes.append(std::istreambuf_iterator<char>{file}, {});
    if (!file || bytes.size() <= signature.size()) throw Error{"cannot be read: must be a PNG file"};
    return bytes;
}

}  // namespace

std::string png_bytes(std::size_t width, std::size_t height, std::span<const std::uint8_t> rgb) {
    if (rgb.empty() || rgb.size() != width * height * 3) {
        throw Error{"PNG of " + std::to_string(width) + " by " + std::to_string(height) + " pixels with " +
                    std::to_string(rgb.size()) + " components: must be three for each, at least one pixel"};
    }
    Image image;
    image->width = static_cast<png_uint_32>(width);
    image->height = static_cast<png_uint_32>(height);
    image->format = PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(*image.get()), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(image.get(), bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
        throw image.error();
    }
    bytes.resize(size);
    return bytes;
}

PngPixels png_pixels(std::string_view bytes) {
    Image image;
    image.begin_reading(bytes);
    auto components = image.read<std::uint8_t>(PNG_FORMAT_RGB);
    return {image->width, image->height, std::move(components)};
}

ValueGrid read_png_luminance(const std::filesystem::path& path) {
    return located(path.string(), [&] {
        constexpr std::size_t most = 4096;
        const std::string bytes = read_bytes(path);
        Image image;
        image.begin_reading(bytes);
        if (image->width > most || image->height > most) {
            throw Error{"picture of " + std::to_string(image->width) + " by " +
                        std::to_string(image->height) + " pixels: must be at most 4096 by 4096"};
        }
        ValueGrid grid{image->height, image->width, {}};
        const auto rgb = image.read<std::uint8_t>(PNG_FORMAT_RGB);
        grid.values.reserve(rgb.size() / 3);
        for (std::size_t i = 0; i < rgb.size(); i += 3) {  // the luminances of sRGB's primaries
            grid.values.push_back(0.2126 * light(rgb[i]) + 0.7152 * light(rgb[i + 1]) +
                                  0.0722 * light(rgb[i + 2]));
        }
        return grid;
    });
}

}  // namespace hts::spectral
