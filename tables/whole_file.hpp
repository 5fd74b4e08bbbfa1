/// Binary files that are there whole or not at all. Private to the file formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hts::tables {

/// All bytes of a regular file. hts::Error "path: …" if it is missing, no regular file or unreadable.
///   most   largest size to read [bytes], else hts::Error before anything is allocated
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& path,
                                          std::uint64_t most = std::uint64_t{1} << 33);

/// Writes to a temporary file beside the target, which is renamed when all is written. hts::Error "path: cannot be written …".
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace hts::tables
