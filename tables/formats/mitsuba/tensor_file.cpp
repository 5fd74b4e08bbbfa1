#include "tables/formats/mitsuba/tensor_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spectral/text/text.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/formats/whole_file.hpp"

namespace hts::tables {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view magic = "tensor_file\0"sv;
constexpr std::uint8_t major_version = 1, minor_version = 0;
constexpr std::size_t most_dimensions = 16;
constexpr std::size_t least_field_bytes = 14;  // a name of one character, no dimensions

struct TypeEntry {
    const char* name;
    std::size_t size;
};
constexpr std::array<TypeEntry, 11> types{{{"u8", 1},
                                           {"i8", 1},
                                           {"u16", 2},
                                           {"i16", 2},
                                           {"u32", 4},
                                           {"i32", 4},
                                           {"u64", 8},
                                           {"i64", 8},
                                           {"f16", 2},
                                           {"f32", 4},
                                           {"f64", 8}}};

const TypeEntry& entry(TensorType type) noexcept {
    return types[static_cast<std::size_t>(type) - 1];
}

template <class Number>
constexpr bool is_finite(Number number) {
    if constexpr (std::is_floating_point_v<Number>) return std::isfinite(number);
    return true;
}

}  // namespace

const char* name(TensorType type) noexcept {
    return entry(type).name;
}

std::size_t size(TensorType type) noexcept {
    return entry(type).size;
}

// ---- writing

template <class Number>
void TensorFileWriter::add_numbers(std::string name, TensorType type, const TensorShape& shape,
                                   std::span<const Number> numbers) {
    std::string bytes;
    bytes.reserve(numbers.size_bytes());
    for (const Number number : numbers) append_little_endian(bytes, number);
    fields_.push_back({std::move(name), type, shape, std::move(bytes)});
}

void TensorFileWriter::add(std::string name, const TensorShape& shape, std::span<const float> numbers) {
    add_numbers(std::move(name), TensorType::f32, shape, numbers);
}

void TensorFileWriter::add(std::string name, const TensorShape& shape,
                           std::span<const std::uint16_t> numbers) {
    add_numbers(std::move(name), TensorType::u16, shape, numbers);
}

void TensorFileWriter::add(std::string name, const TensorShape& shape,
                           std::span<const std::uint8_t> numbers) {
    add_numbers(std::move(name), TensorType::u8, shape, numbers);
}

void TensorFileWriter::add(std::string name, std::string_view text) {
    fields_.push_back({std::move(name), TensorType::u8, {text.size()}, std::string{text}});
}

std::string TensorFileWriter::bytes() const {
    const auto padded = [](std::size_t offset) { return (offset + 7) / 8 * 8; };
    std::size_t offset = magic.size() + 2 + 4;
    for (const Field& field : fields_) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
    std::string file{magic};
    append_little_endian(file, major_version);
    append_little_endian(file, minor_version);
    append_little_endian(file, static_cast<std::uint32_t>(fields_.size()));
    for (const Field& field : fields_) {
        offset = padded(offset);
        append_little_endian(file, static_cast<std::uint16_t>(field.name.size()));
        file += field.name;
        append_little_endian(file, static_cast<std::uint16_t>(field.shape.size()));
        append_little_endian(file, static_cast<std::uint8_t>(field.type));
        append_little_endian(file, static_cast<std::uint64_t>(offset));
        for (const std::size_t extent : field.shape)
            append_little_endian(file, static_cast<std::uint64_t>(extent));
        offset += field.bytes.size();
    }
    for (const Field& field : fields_) {
        file.resize(padded(file.size()), '\0');
        file += field.bytes;
    }
    return file;
}

// ---- reading

/// Takes the header apart, byte by byte checked.
class TensorFile::HeaderReader {
  public:
    explicit HeaderReader(const TensorFile& file) : file_{file}, bytes_{file.bytes_} {}

    std::vector<Field> fields() {
        require_magic();
        const auto count = number<std::uint32_t>("number of fields");
        const std::size_t most = (bytes_.size() - at_) / least_field_bytes;
        if (count > most) throw file_error("number of fields", count, most);
        std::vector<Field> fields;
        for (std::uint32_t i = 0; i < count; ++i) fields.push_back(field());
        require_distinct_names(fields);
        for (const Field& each : fields)
            if (each.offset < at_) throw file_.error(each.name, "starts inside the header");
        return fields;
    }

  private:
    [[nodiscard]] Error file_error(const char* what, double value, std::size_t most) const {
        return out_of_range(
            file_.path_ + ": " + what, value, "",
            "at most " + std::to_string(most) + " in a file of " + std::to_string(bytes_.size()) + " bytes");
    }

    std::string_view take(std::size_t length, const char* what) {
        if (length > bytes_.size() - at_)
            throw Error{file_.path_ + ": truncated in the header, at the " + what};
        at_ += length;
        return bytes_.substr(at_ - length, length);
    }

    template <class Number>
    Number number(const char* what) {
        return from_little_endian<Number>(take(sizeof(Number), what));
    }

    void require_magic() {
        if (!bytes_.starts_with(magic))
            throw Error{file_.path_ + ": is no tensor file: must start with \"tensor_file\""};
        at_ = magic.size();
        const int major = number<std::uint8_t>("version"), minor = number<std::uint8_t>("version");
        if (major != major_version || minor != minor_version) {
            throw Error{file_.path_ + ": version " + std::to_string(major) + "." + std::to_string(minor) +
                        " of a tensor file: must be 1.0"};
        }
    }

    Field field() {
        Field field;
        field.name = take(number<std::uint16_t>("length of a name"), "name of a field");
        if (field.name.empty()) throw file_.error(field.name, "name is empty");
        const std::size_t dimensions = number<std::uint16_t>("number of dimensions");
        if (dimensions > most_dimensions)
            throw file_.error(field.name, std::to_string(dimensions) + " dimensions: must be at most 16");
        const int type = number<std::uint8_t>("type of a field");
        if (type < 1 || type > static_cast<int>(types.size()))
            throw file_.error(field.name, "type " + std::to_string(type) + ": must be 1 to 11");
        field.type = static_cast<TensorType>(type);
        const auto offset = number<std::uint64_t>("offset of a field");
        field.count = shape(field, dimensions);
        if (offset > bytes_.size() || field.count * size(field.type) > bytes_.size() - offset)
            throw file_.error(field.name, "reaches beyond the end of the file, which may be truncated");
        field.offset = offset;
        return field;
    }

    /// Reads the shape into the field; its product, which the file could hold.
    std::size_t shape(Field& field, std::size_t dimensions) {
        const std::size_t most = bytes_.size() / size(field.type);
        std::size_t count = 1;
        for (std::size_t i = 0; i < dimensions; ++i) {
            const auto extent = number<std::uint64_t>("shape of a field");
            if (extent == 0) throw file_.error(field.name, "a size of 0: must be at least 1");
            if (extent > most / count)
                throw file_.error(field.name, "has more numbers than the file has room for");
            count *= extent;
            field.shape.push_back(extent);
        }
        return count;
    }

    void require_distinct_names(const std::vector<Field>& fields) const {
        std::vector<std::string_view> names;
        names.reserve(fields.size());
        for (const Field& each : fields) names.push_back(each.name);
        std::sort(names.begin(), names.end());
        const auto twin = std::adjacent_find(names.begin(), names.end());
        if (twin != names.end()) throw file_.error(*twin, "is there twice");
    }

    const TensorFile& file_;
    std::string_view bytes_;
    std::size_t at_ = 0;
};

TensorFile TensorFile::parse(std::string bytes, std::string path) {
    TensorFile file{std::move(bytes), std::move(path)};
    file.fields_ = HeaderReader{file}.fields();
    return file;
}

TensorFile TensorFile::read(const std::filesystem::path& path) {
    return parse(read_whole_file(path), path.string());
}

Error TensorFile::error(std::string_view name, std::string_view message) const {
    return Error{path_ + ": field " + spectral::in_quotes(name) + ": " + std::string{message}};
}

bool TensorFile::contains(std::string_view name) const noexcept {
    return std::any_of(fields_.begin(), fields_.end(), [&](const Field& each) { return each.name == name; });
}

const TensorFile::Field& TensorFile::field(std::string_view name) const {
    for (const Field& each : fields_)
        if (each.name == name) return each;
    throw error(name, "is missing");
}

const TensorShape& TensorFile::shape(std::string_view name) const {
    return field(name).shape;
}

template <class Number>
std::vector<Number> TensorFile::numbers(std::string_view name, TensorType type, NotFinite not_finite) const {
    const Field& found = field(name);
    if (found.type != type)
        throw error(name,
                    "type " + std::string{tables::name(found.type)} + ": must be " + tables::name(type));
    const std::string_view bytes{bytes_};
    std::vector<Number> numbers;
    numbers.reserve(found.count);
    for (std::size_t i = 0; i < found.count; ++i) {
        numbers.push_back(from_little_endian<Number>(bytes.substr(found.offset + i * sizeof(Number))));
        if (not_finite == NotFinite::refused && !is_finite(numbers.back()))
            throw error(name, "number " + std::to_string(i) + " is not finite");
    }
    return numbers;
}

FloatTensor TensorFile::floats(std::string_view name, std::size_t dimensions, NotFinite not_finite) const {
    const TensorShape& shape = field(name).shape;
    if (shape.size() != dimensions) {
        throw error(name,
                    std::to_string(shape.size()) + " dimensions: must be " + std::to_string(dimensions));
    }
    return {shape, numbers<float>(name, TensorType::f32, not_finite)};
}

std::vector<std::uint16_t> TensorFile::words(std::string_view name) const {
    return numbers<std::uint16_t>(name, TensorType::u16);
}

std::vector<std::uint8_t> TensorFile::octets(std::string_view name) const {
    return numbers<std::uint8_t>(name, TensorType::u8);
}

}  // namespace hts::tables
