/// The container of the RGL group's measurements, "tensor_file" 1.0, which Mitsuba 3 and pbrt-v4 read: named
/// arrays of numbers, little-endian. Private to the formats that live in it (rgl.hpp, pbsdf.hpp).
///
///   "tensor_file\0", u8 1, u8 0, u32 fields; per field u16 length and name, u16 dimensions, u8 type, u64
///   offset, u64 shape[]; then the numbers, last index fastest
///
/// A file is checked whole before any number is used; whatever it claims, no more memory is
/// taken than the file is long.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"

namespace hts::tables {

/// As the format numbers them.
enum class TensorType : std::uint8_t { u8 = 1, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64 };

[[nodiscard]] const char* name(TensorType type) noexcept;
/// Of one number [bytes].
[[nodiscard]] std::size_t size(TensorType type) noexcept;

using TensorShape = std::vector<std::size_t>;

/// Numbers with their shape; numbers.size() is the product of the shape.
struct FloatTensor {
    TensorShape shape;
    std::vector<float> numbers;
};

/// Whether NaN and infinities among the numbers are errors.
enum class NotFinite { refused, kept };

/// A file under construction.
class TensorFileWriter {
  public:
    ///   numbers   as many as the shape says
    void add(std::string name, const TensorShape& shape, std::span<const float> numbers);
    void add(std::string name, const TensorShape& shape, std::span<const std::uint16_t> numbers);
    void add(std::string name, const TensorShape& shape, std::span<const std::uint8_t> numbers);
    /// Text as a row of u8.
    void add(std::string name, std::string_view text);

    /// The whole file; every array starts at a multiple of 8 bytes.
    [[nodiscard]] std::string bytes() const;

  private:
    struct Field {
        std::string name;
        TensorType type;
        TensorShape shape;
        std::string bytes;
    };
    template <class Number>
    void add_numbers(std::string name, TensorType type, const TensorShape& shape,
                     std::span<const Number> numbers);

    std::vector<Field> fields_;
};

/// A file that was read. All errors are hts::Error "path: …".
class TensorFile {
  public:
    /// hts::Error for what is no such file, another version, truncated, or inconsistent in itself: field
    /// names empty or twice, unknown types, sizes of zero, more numbers than the file has bytes, arrays
    /// that reach out of the file.
    [[nodiscard]] static TensorFile read(const std::filesystem::path& path);
    /// The same from memory.    path   for messages
    [[nodiscard]] static TensorFile parse(std::string bytes, std::string path);

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] bool contains(std::string_view name) const noexcept;
    /// hts::Error if there is no such field.
    [[nodiscard]] const TensorShape& shape(std::string_view name) const;

    /// The numbers of a field; hts::Error if it is missing, of another type or number of dimensions,
    /// or a number is not finite.
    [[nodiscard]] FloatTensor floats(std::string_view name, std::size_t dimensions,
                                     NotFinite not_finite = NotFinite::refused) const;
    [[nodiscard]] std::vector<std::uint16_t> words(std::string_view name) const;
    [[nodiscard]] std::vector<std::uint8_t> octets(std::string_view name) const;

    /// hts::Error "path: field "name": message".
    [[nodiscard]] Error error(std::string_view name, std::string_view message) const;

  private:
    struct Field {
        std::string name;
        TensorType type;
        TensorShape shape;
        std::size_t count;  // product of the shape
        std::size_t offset;
    };
    class HeaderReader;

    TensorFile(std::string bytes, std::string path) : bytes_{std::move(bytes)}, path_{std::move(path)} {}
    [[nodiscard]] const Field& field(std::string_view name) const;
    template <class Number>
    [[nodiscard]] std::vector<Number> numbers(std::string_view name, TensorType type,
                                              NotFinite not_finite = NotFinite::refused) const;

    std::string bytes_, path_;
    std::vector<Field> fields_;
};

}  // namespace hts::tables
