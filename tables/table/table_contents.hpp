/// A table in memory and as bytes. Private to the module.
///
/// The file: 64 bytes of prelude, a header in JSON padded with spaces to a multiple of 64, the
/// numbers. All little-endian.
///   prelude   magic (8), version (4), 01020304 hexadecimal (4), bytes of the header (8), of the numbers (8),
///             CRC-64 of everything but itself (8), zeros (24)
///   numbers   doubles: floor, uniform diffuse; spline coefficients, a wavelength beside the other, of
///             specular reflectance, lobe albedo and polarisation (real parts, imaginary parts); then the
///             lobe's, in float or double: the basis, and coefficients, a component beside the other
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tables/table/table.hpp"
#include "tables/table/table_coordinates.hpp"

namespace hts::tables {

/// Numbers of each part.
struct TableCounts {
    std::size_t wavelengths, specular, albedo, polarisation, lobe;

    [[nodiscard]] std::size_t doubles() const noexcept {
        return 2 * wavelengths + specular + albedo + polarisation;
    }
};
[[nodiscard]] TableCounts counts(const TableInfo& info) noexcept;

/// Numbers of a table, or places for them.
template <class Double, class Single>
struct TableNumbers {
    std::span<Double> floor, uniform_diffuse, specular, albedo, polarisation;
    std::span<Single> lobe;       ///< basis and coefficients
    std::span<Double> fine_lobe;  ///< one of the two, by TableInfo::double_precision
};

struct TableContents {
    TableInfo info;
    CoordinateMap map;
    TableNumbers<const double, const float> numbers;
    std::size_t bytes;
    std::uint64_t checksum;               ///< of the prelude
    std::shared_ptr<const void> storage;  ///< what the numbers stand in
};

/// Numbers that are being made.
struct OwnedNumbers {
    std::vector<double> floor, uniform_diffuse, specular, albedo, polarisation, basis, lobe;
};

/// The bytes of the file; `lobe` is rounded to float unless info says double.
[[nodiscard]] std::string table_bytes(const TableInfo& info, const OwnedNumbers& numbers);
/// Checks everything, then points into `bytes`, which `storage` keeps; hts::Error "name: …".
[[nodiscard]] TableContents contents_of(std::string_view bytes, std::shared_ptr<const void> storage,
                                        const std::string& name);

/// The header as JSON, and back; the latter throws hts::Error that names file and key.
[[nodiscard]] std::string header_text(const TableInfo& info);
[[nodiscard]] TableInfo info_from_header(std::string_view text, const std::string& name);

/// Version of the library, "0.1.0".
[[nodiscard]] std::string library_version();

}  // namespace hts::tables
