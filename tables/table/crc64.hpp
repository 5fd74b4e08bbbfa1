/// Checksum of files. Private to the module.
#pragma once

#include <cstdint>
#include <string_view>

namespace hts::tables {

/// CRC-64/XZ (ECMA-182 reflected) of a text; "123456789" gives 0x995dc9bbdf1939fa.
///   before   checksum of what stands before the text, so that it may come in parts
[[nodiscard]] std::uint64_t crc64(std::string_view text, std::uint64_t before = 0) noexcept;

}  // namespace hts::tables
