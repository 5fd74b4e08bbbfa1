/// Whole binary files into memory (spectral/text/output.hpp writes them). Private to the file formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hts::tables {

/// All bytes of a file, or of a pipe until its writer closes it. hts::Error "path: …" if it is missing, a
/// directory or may not be read.
///   most   largest size to read [bytes], else hts::Error: of a file before anything is allocated, of a pipe
///          (of which at most 2^30 are read) before more is
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& path,
                                          std::uint64_t most = std::uint64_t{1} << 33);

}  // namespace hts::tables
