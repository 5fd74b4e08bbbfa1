#include "tables/table/table_contents.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "hts/error.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/table/crc64.hpp"
#include "tables/table/spline.hpp"

namespace hts::tables {
namespace {

constexpr std::string_view magic{"\x89HTST\r\n\x1a", 8};
constexpr std::uint32_t format_version = 1;
constexpr std::size_t prelude_bytes = 64, alignment = 64, checksum_at = 32;
constexpr std::size_t longest_header = std::size_t{4} << 20;
constexpr bool is_little_endian = std::endian::native == std::endian::little;

/// CRC of everything but the eight bytes of the CRC.
std::uint64_t checksum(std::string_view bytes) {
    const std::size_t after = checksum_at + sizeof(std::uint64_t);
    return crc64(bytes.substr(after), crc64(bytes.substr(0, checksum_at)));
}

struct Prelude {
    std::uint64_t header, numbers;
};

Prelude prelude_of(std::string_view bytes, const std::string& name) {
    if (bytes.size() < prelude_bytes || bytes.substr(0, magic.size()) != magic) {
        throw Error{name + ": is no table: must be a file that hts table build wrote"};
    }
    const auto order = from_little_endian<std::uint32_t>(bytes.substr(12));
    if (order == other_byte_order) throw Error{name + ": is big-endian: must be little-endian"};
    const auto version = from_little_endian<std::uint32_t>(bytes.substr(8));
    if (version != format_version || order != byte_order) {
        throw Error{name + ": table format " + std::to_string(version) + ": must be format " +
                    std::to_string(format_version)};
    }
    const Prelude prelude{from_little_endian<std::uint64_t>(bytes.substr(16)),
                          from_little_endian<std::uint64_t>(bytes.substr(24))};
    if (prelude.header > longest_header || prelude.header % alignment != 0) {
        throw Error{name + ": header of " + std::to_string(prelude.header) +
                    " bytes: must be at most 4 MiB, a multiple of 64"};
    }
    const std::uint64_t rest = bytes.size() - prelude_bytes;
    if (prelude.header > rest || prelude.numbers != rest - prelude.header) {
        throw Error{name + ": " + std::to_string(bytes.size()) + " bytes: must be the " +
                    std::to_string(prelude_bytes) + " + " + std::to_string(prelude.header) + " + " +
                    std::to_string(prelude.numbers) + " of its prelude; is it cut short?"};
    }
    if (from_little_endian<std::uint64_t>(bytes.substr(checksum_at)) != checksum(bytes)) {
        throw Error{name + ": checksum does not match: must be the file as it was written"};
    }
    return prelude;
}

/// As the host has them: the bytes themselves, or a turned copy.
template <class Real>
std::span<const Real> host_numbers(std::string_view bytes, std::shared_ptr<const void>& storage) {
    const std::size_t count = bytes.size() / sizeof(Real);
    if constexpr (is_little_endian) {
        return {reinterpret_cast<const Real*>(bytes.data()),
                count};  // NOLINT: the prelude keeps the alignment
    } else {
        auto turned = std::make_shared<std::vector<Real>>(count);
        for (std::size_t i = 0; i < count; ++i) {
            (*turned)[i] = from_little_endian<Real>(bytes.substr(i * sizeof(Real)));
        }
        const std::span<const Real> numbers{*turned};
        storage = std::make_shared<std::pair<std::shared_ptr<const void>, std::shared_ptr<const void>>>(
            storage, turned);
        return numbers;
    }
}

template <class Real>
void require_finite(std::span<const Real> values, const std::string& name) {
    if (std::ranges::all_of(values, [](Real value) { return std::isfinite(value); })) return;
    throw Error{name + ": has numbers that are not finite"};
}

void require_not_negative(std::span<const double> values, const char* what, const std::string& name) {
    for (const double value : values)
        if (value < 0) throw Error{name + ": " + what + " " + shortest(value) + " 1/sr: must be >= 0"};
}

/// What its numbers take [bytes]; in floating point, where a hostile header cannot overflow.
double bytes_needed(const TableInfo& info) {
    const auto with_ghosts = [](std::size_t nodes) { return static_cast<double>(nodes + spline_ghosts); };
    const auto& n = info.nodes;
    const double polarisation = n.polarisation == 0 ? 0 : 2 * with_ghosts(n.polarisation);
    const auto wavelengths = static_cast<double>(info.wavelengths.size());
    const double lobe = static_cast<double>(info.components) *
                        (wavelengths + with_ghosts(n.grazing) * with_ghosts(n.ratio) * with_ghosts(n.turn));
    return 8 * wavelengths * (2 + with_ghosts(n.specular) + with_ghosts(n.albedo) + polarisation) +
           (info.double_precision ? 8 : 4) * lobe;
}

}  // namespace

TableCounts counts(const TableInfo& info) noexcept {
    const std::size_t w = info.wavelengths.size();
    const auto& n = info.nodes;
    const std::size_t polarisation = n.polarisation == 0 ? 0 : 2 * (n.polarisation + spline_ghosts);
    return {w, (n.specular + spline_ghosts) * w, (n.albedo + spline_ghosts) * w, polarisation * w,
            info.components *
                (w + (n.grazing + spline_ghosts) * (n.ratio + spline_ghosts) * (n.turn + spline_ghosts))};
}

std::string table_bytes(const TableInfo& info, const OwnedNumbers& numbers) {
    std::string header = header_text(info);
    header.append((alignment - header.size() % alignment) % alignment, ' ');
    std::string payload;
    for (const auto* part : {&numbers.floor, &numbers.uniform_diffuse, &numbers.specular, &numbers.albedo,
                             &numbers.polarisation}) {
        append_numbers<double>(payload, *part);
    }
    for (const auto* part : {&numbers.basis, &numbers.lobe}) {
        if (info.double_precision) {
            append_numbers<double>(payload, *part);
        } else {
            append_numbers<float>(payload, *part);
        }
    }
    std::string bytes{magic};
    append_little_endian(bytes, format_version);
    append_little_endian(bytes, byte_order);
    append_little_endian(bytes, static_cast<std::uint64_t>(header.size()));
    append_little_endian(bytes, static_cast<std::uint64_t>(payload.size()));
    append_little_endian(bytes, std::uint64_t{0});
    bytes.append(prelude_bytes - bytes.size(), '\0');
    bytes += header;
    bytes += payload;
    std::string sum;
    append_little_endian(sum, checksum(bytes));
    bytes.replace(checksum_at, sum.size(), sum);
    return bytes;
}

TableContents contents_of(std::string_view bytes, std::shared_ptr<const void> storage,
                          const std::string& name) {
    const Prelude prelude = prelude_of(bytes, name);
    TableInfo info = info_from_header(bytes.substr(prelude_bytes, prelude.header), name);
    if (bytes_needed(info) != static_cast<double>(prelude.numbers)) {
        throw Error{name + ": " + std::to_string(prelude.numbers) + " bytes of numbers: must be " +
                    shortest(bytes_needed(info)) + " for the nodes and wavelengths in its header"};
    }
    const TableCounts count = counts(info);
    const std::string_view numbers = bytes.substr(prelude_bytes + prelude.header);
    const std::size_t double_bytes = count.doubles() * sizeof(double);
    std::span<const double> doubles = host_numbers<double>(numbers.substr(0, double_bytes), storage);
    require_finite(doubles, name);
    const auto take = [&doubles](std::size_t size) {
        const auto taken = doubles.first(size);
        doubles = doubles.subspan(size);
        return taken;
    };
    TableNumbers<const double, const float> parts{};
    parts.floor = take(count.wavelengths);
    parts.uniform_diffuse = take(count.wavelengths);
    require_not_negative(parts.floor, "floor", name);
    require_not_negative(parts.uniform_diffuse, "uniform diffuse BRDF", name);
    parts.specular = take(count.specular);
    parts.albedo = take(count.albedo);
    parts.polarisation = take(count.polarisation);
    if (info.double_precision) {
        parts.fine_lobe = host_numbers<double>(numbers.substr(double_bytes), storage);
        require_finite(parts.fine_lobe, name);
    } else {
        parts.lobe = host_numbers<float>(numbers.substr(double_bytes), storage);
        require_finite(parts.lobe, name);
    }
    const CoordinateMap map{info.spacing};
    return {std::move(info),
            map,
            parts,
            bytes.size(),
            from_little_endian<std::uint64_t>(bytes.substr(checksum_at)),
            std::move(storage)};
}

}  // namespace hts::tables
