#include "spectral/text/png.hpp"

#include <png.h>

#include <array>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
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

/// libpng's own interface, which alone gives numbers as they stand in the file. What fails in it comes back
/// by longjmp, past no destructor.
class GreyReader {
  public:
    explicit GreyReader(std::string_view bytes)
        : rest_{bytes}, png_{png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore)} {
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::bad_alloc{};
    }
    ~GreyReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    GreyReader(const GreyReader&) = delete;
    GreyReader& operator=(const GreyReader&) = delete;

    [[nodiscard]] ValueGrid read(std::size_t most) {
        if (!read_head()) throw error();
        const std::size_t columns = png_get_image_width(png_, info_),
                          rows = png_get_image_height(png_, info_);
        if (png_get_bit_depth(png_, info_) != 16 || png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY)
            throw Error{"PNG: must be grey, with 16 bits and without transparency"};
        if (columns > most / rows) {
            throw Error{"PNG of " + std::to_string(columns) + " by " + std::to_string(rows) +
                        " pixels: must be at most " + std::to_string(most) + " of them"};
        }
        std::vector<std::uint16_t> levels(columns * rows);
        std::vector<png_bytep> lines(rows);
        for (std::size_t j = 0; j < rows; ++j) lines[j] = reinterpret_cast<png_bytep>(&levels[j * columns]);
        if (!read_rows(lines.data())) throw error();
        return {rows, columns, {levels.begin(), levels.end()}};
    }

  private:
    [[nodiscard]] Error error() const { return Error{std::string{"PNG: "} + message_.data()}; }
    static void fail(png_structp png, png_const_charp message) {
        auto& text = static_cast<GreyReader*>(png_get_error_ptr(png))->message_;
        std::strncpy(text.data(), message, text.size() - 1);
        png_longjmp(png, 1);
    }
    static void ignore(png_structp /*png*/, png_const_charp /*message*/) {}
    static void next_bytes(png_structp png, png_bytep to, std::size_t count) {
        auto& rest = static_cast<GreyReader*>(png_get_io_ptr(png))->rest_;
        if (count > rest.size()) png_error(png, "cut off");
        std::memcpy(to, rest.data(), count);
        rest.remove_prefix(count);
    }
    // NOLINTBEGIN(cert-err52-cpp): as libpng would have it
    bool read_head() noexcept {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_read_fn(png_, this, next_bytes);
        png_read_info(png_, info_);
        return true;
    }
    bool read_rows(png_bytepp lines) noexcept {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        png_read_image(png_, lines);
        png_read_end(png_, nullptr);
        return true;
    }
    // NOLINTEND(cert-err52-cpp)

    std::string_view rest_;
    std::array<char, 128> message_{};
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
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

ValueGrid png_grey_levels(std::string_view bytes, std::size_t most) {
    return GreyReader{bytes}.read(most);
}

}  // namespace hts::spectral
