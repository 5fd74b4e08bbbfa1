/// The files of spectral/materials/data/ as they are embedded in the library. Private to the readers.
#pragma once

#include <span>
#include <string_view>

namespace hts::spectral {

struct BuiltInFile {
    std::string_view name;  // of the material, the file's stem
    std::string_view text;
};

/// Defined in a source that embed_data.cmake writes.
[[nodiscard]] std::span<const BuiltInFile> built_in_files() noexcept;

}  // namespace hts::spectral
