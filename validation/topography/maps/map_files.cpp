#include "validation/topography/maps/map_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>

#include "spectral/text/png.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "validation/topography/maps/instrument_files.hpp"
#include "validation/topography/maps/text_maps.hpp"

namespace hts::validation {
namespace {

using spectral::in_quotes;
static_assert(std::endian::native == std::endian::little);

constexpr std::string_view gsf_signature = "Gwyddion Simple Field 1.0\n", npy_signature = "\x93NUMPY",
                           png_signature = "\x89PNG";

std::string file_bytes(const std::filesystem::path& path) {
    const auto source = spectral::path_to_read(path);
    std::error_code failed;
    const auto size = std::filesystem::file_size(source, failed);
    constexpr std::uintmax_t most = 1UL << 30U;
    if (failed) throw Error{"must be a regular file"};
    if (size == 0) throw Error{"empty"};
    if (size > most) throw Error{std::to_string(size) + " bytes: must be at most " + std::to_string(most)};
    std::string bytes(size, '\0');
    std::ifstream file{source, std::ios::binary};
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) throw Error{"cannot be read"};
    return bytes;
}

/// `count` numbers of a type behind one another.
template <class Number>
std::vector<double> numbers_in(std::string_view bytes, bool swapped) {
    std::vector<double> result(bytes.size() / sizeof(Number));
    for (std::size_t i = 0; i < result.size(); ++i) {
        std::array<char, sizeof(Number)> raw{};
        std::memcpy(raw.data(), bytes.data() + i * sizeof(Number), sizeof(Number));
        if (swapped) std::ranges::reverse(raw);
        result[i] = static_cast<double>(std::bit_cast<Number>(raw));
    }
    return result;
}

HeightMap scaled_map(const std::string& name, double columns, double rows, std::vector<double> values,
                     const StatedUnits& units) {
    const double unit = units.height();
    for (double& z : values) z *= unit;
    return {name,
            static_cast<std::size_t>(columns),
            static_cast<std::size_t>(rows),
            units.step_x(),
            units.step_y(),
            std::move(values)};
}

// ---- Gwyddion Simple Field

std::map<std::string, std::string> gsf_head(std::string_view text) {
    std::map<std::string, std::string> head;
    for (const std::string_view line : spectral::split(text, '\n')) {
        if (spectral::trimmed(line).empty()) continue;
        const auto equals = line.find('=');
        if (equals == std::string_view::npos)
            throw Error{in_quotes(line.substr(0, 40)) + ": must be key = value"};
        const std::string key{spectral::trimmed(line.substr(0, equals))};
        if (!head.emplace(key, spectral::trimmed(line.substr(equals + 1))).second)
            throw Error{key + ": stands twice"};
    }
    return head;
}

HeightMap map_from_gsf(std::string_view bytes, const std::string& name, const MapUnits& given) {
    const auto end = bytes.find('\0');
    if (end == std::string_view::npos) throw Error{"cut off in its head"};
    const auto head = gsf_head(bytes.substr(gsf_signature.size(), end - gsf_signature.size()));
    const auto number = [&](const std::string& key) {
        const auto found = head.find(key);
        if (found == head.end()) throw Error{key + ": missing"};
        return spectral::number_in(found->second, key);
    };
    const double columns = number("XRes"), rows = number("YRes");
    HeightMap::require_size(columns, rows);
    const std::size_t first = (end / 4 + 1) * 4;
    const auto size = static_cast<std::size_t>(columns * rows) * sizeof(float);
    if (bytes.size() != first + size) {
        throw Error{std::to_string(bytes.size() - std::min(first, bytes.size())) +
                    " bytes of heights: must be " + std::to_string(size) + " for " + shortest(columns) +
                    " by " + shortest(rows) + " points"};
    }
    StatedUnits units{given};
    const auto unit = [&](const std::string& key) {
        return spectral::located(key, [&] { return length_unit(head.at(key)); });
    };
    if (head.contains("XYUnits")) units.state_length(unit("XYUnits"));
    if (head.contains("ZUnits")) units.state_height(unit("ZUnits"));
    if (head.contains("XReal") || head.contains("YReal")) {
        const double length = units.length();
        units.state_step(length * number("XReal") / columns, length * number("YReal") / rows);
    } else {
        units.refuse_length();
    }
    return scaled_map(name, columns, rows, numbers_in<float>(bytes.substr(first), false), units);
}

// ---- NumPy

/// The value behind 'key': in the dictionary of a .npy file.
std::string_view npy_value(std::string_view head, std::string_view key) {
    const auto at = head.find(std::string{"'"}.append(key).append("':"));
    if (at == std::string_view::npos) throw Error{"NumPy array without " + in_quotes(key)};
    const auto value = head.substr(at + key.size() + 3);
    const auto end = key == "shape" ? value.find(')') + 1 : value.find_first_of(",}");
    return spectral::trimmed(value.substr(0, std::min(end, value.size())));
}

Error no_type(std::string_view type) {
    return Error{"numbers of type " + in_quotes(type) + ": must be f4, f8, i2, u2 or i4"};
}

/// Bytes of a number of the type "<f4".
double npy_width(std::string_view type) {
    const std::string_view kind = type.substr(1);
    if (kind == "f8") return 8;
    if (kind == "f4" || kind == "i4") return 4;
    if (kind == "i2" || kind == "u2") return 2;
    throw no_type(type);
}

std::vector<double> npy_numbers(std::string_view bytes, std::string_view type) {
    const bool swapped = type.starts_with('>');
    const std::string_view kind = type.substr(1);
    if (kind == "f4") return numbers_in<float>(bytes, swapped);
    if (kind == "f8") return numbers_in<double>(bytes, swapped);
    if (kind == "i2") return numbers_in<std::int16_t>(bytes, swapped);
    if (kind == "u2") return numbers_in<std::uint16_t>(bytes, swapped);
    return numbers_in<std::int32_t>(bytes, swapped);
}

HeightMap map_from_npy(std::string_view bytes, const std::string& name, const MapUnits& given) {
    if (bytes.size() < 12) throw Error{"cut off in its head"};
    const auto byte = [&](std::size_t i) {
        return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    const std::size_t length_bytes = byte(6) == 1 ? 2 : 4, first = 8 + length_bytes;
    std::size_t length = 0;
    for (std::size_t i = length_bytes; i-- > 0;) length = 256 * length + byte(8 + i);
    if (length > bytes.size() - first) throw Error{"cut off in its head"};
    const std::string_view head = bytes.substr(first, length);
    std::string_view shape = npy_value(head, "shape");
    if (shape.size() < 2 || shape.front() != '(') throw Error{"shape: must be (rows, columns)"};
    shape = shape.substr(1, shape.size() - 2);
    const auto sizes = spectral::split(shape, ',');
    if (sizes.size() != 2 || spectral::trimmed(sizes[1]).empty())
        throw Error{"shape (" + std::string{shape} + "): must be (rows, columns)"};
    const double rows = spectral::number_in(spectral::trimmed(sizes[0]), "shape"),
                 columns = spectral::number_in(spectral::trimmed(sizes[1]), "shape");
    HeightMap::require_size(columns, rows);
    std::string_view type = npy_value(head, "descr");
    if (type.size() != 5) throw no_type(type);
    type = type.substr(1, 3);
    const double width = npy_width(type);
    const std::string_view data = bytes.substr(first + length);
    if (static_cast<double>(data.size()) != columns * rows * width) {
        throw Error{std::to_string(data.size()) + " bytes of heights: must be " +
                    shortest(columns * rows * width) + " for its shape"};
    }
    auto values = npy_numbers(data, type);
    if (npy_value(head, "fortran_order") == "True") {
        const auto down = static_cast<std::size_t>(rows), across = static_cast<std::size_t>(columns);
        std::vector<double> turned(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) turned[(i % down) * across + i / down] = values[i];
        values.swap(turned);
    }
    const StatedUnits units{given};
    units.refuse_length();
    return scaled_map(name, columns, rows, std::move(values), units);
}

HeightMap map_from_png(std::string_view bytes, const std::string& name, const MapUnits& given) {
    const auto grey = spectral::png_grey_levels(bytes, HeightMap::most_points);
    const StatedUnits units{given};
    units.refuse_length();
    return scaled_map(name, static_cast<double>(grey.columns), static_cast<double>(grey.rows), grey.values,
                      units);
}

HeightMap map_from(std::string_view bytes, const std::string& name, const MapUnits& units) {
    if (bytes.starts_with(gsf_signature)) return map_from_gsf(bytes, name, units);
    if (bytes.starts_with(npy_signature)) return map_from_npy(bytes, name, units);
    if (bytes.starts_with(png_signature)) return map_from_png(bytes, name, units);
    if (bytes.starts_with(spectral::byte_order_mark)) bytes.remove_prefix(spectral::byte_order_mark.size());
    if (spectral::is_text(bytes)) return map_from_text(bytes, name, units);
    throw Error{
        "must be a .gsf, .npy or 16-bit PNG file, text, or a file of an instrument (.sdf, .x3p, .al3d …)"};
}

}  // namespace

double length_unit(std::string_view text) {
    for (const auto& [name, um] :
         {std::pair{"m", 1e6}, {"mm", 1e3}, {"um", 1.0}, {"\u00b5m", 1.0}, {"\u03bcm", 1.0}, {"nm", 1e-3}}) {
        if (text == name) return um;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size() && value > 0 && std::isfinite(value))
        return value;
    throw Error{"unit " + in_quotes(text) + ": must be nm, um, mm, m or a number of um > 0"};
}

HeightMap read_height_map(const std::filesystem::path& path, const MapUnits& units) {
    // require_file names the path itself
    spectral::require_file(path);
    return spectral::located(path.string(), [&] {
        const bool foreign = is_instrument_file(path);
        return map_from(foreign ? instrument_file_as_gsf(std::filesystem::absolute(path)) : file_bytes(path),
                        path.stem().string(), units);
    });
}

}  // namespace hts::validation
