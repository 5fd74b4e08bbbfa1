/// Finished slices in a file. Private to the module.
///
/// Prelude of 32 bytes (magic (8), version (4), 01020304 hexadecimal (4), bytes of the header (8), CRC-64 of
/// the header (8)), header in JSON, then records: number of the slice (8), CRC-64 of number and values (8),
/// values (double). All little-endian.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/sharing/table_parts.hpp"

namespace hts::tables {

/// What stands at the head of a part.
struct PartHeader {
    TableJob job;
    TablePlan plan;
    TableShard shard;
};

/// A part as it was found.
struct Part {
    PartHeader header;
    std::map<std::size_t, std::vector<double>> slices;
    std::size_t sound_bytes;  ///< up to the end of the last record that is whole
};

/// hts::Error "path: …" where the head is no part's; what follows the last sound record is passed over.
[[nodiscard]] Part read_part(const std::filesystem::path& path);

/// The head of a part, hts::Error "name: …" where it is none.
[[nodiscard]] PartHeader header_from_bytes(std::string_view bytes, const std::string& name);

/// Whether the file is the beginning of a part whose header is not whole.
[[nodiscard]] bool is_header_cut_short(const std::filesystem::path& path);

/// Header and records as bytes.
[[nodiscard]] std::string part_header_bytes(const PartHeader& header);
[[nodiscard]] std::string slice_bytes(std::size_t slice, const std::vector<double>& values);

}  // namespace hts::tables
