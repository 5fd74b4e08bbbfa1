/// Whole binary files into memory (spectral/text/output.hpp writes them). Private to the file formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hts::tables {

/// All bytes of a regular file. hts::Error "path: …" if it is missing, no regular file or unreadable.
///   most   largest size to read [bytes], else hts::Error before anything is allocated
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& path,
                                          std::uint64_t most = std::uint64_t{1} << 33);

}  // namespace hts::tables
