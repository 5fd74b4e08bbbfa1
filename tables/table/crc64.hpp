/// Checksum of files. Private to the module.
///
/// Eight bytes at a time, by eight tables. Boost.CRC takes one byte at a time: with it, Table::open of a file
/// of 44 MB took 3.45 times as long (102.5 ms against 29.7 ms of processor time, medians of 15; AMD EPYC, gcc
/// 12.2, -O3), since the checksum is nearly all that opening does.
#pragma once

#include <cstdint>
#include <string_view>

namespace hts::tables {

/// CRC-64/XZ (ECMA-182 reflected) of a text; "123456789" gives 0x995dc9bbdf1939fa.
///   before   checksum of what stands before the text, so that it may come in parts
[[nodiscard]] std::uint64_t crc64(std::string_view text, std::uint64_t before = 0) noexcept;

}  // namespace hts::tables
