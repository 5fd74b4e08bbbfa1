/// Text files that are embedded in a library at build time; `hts_embed` in the top CMakeLists.txt makes them.
/// Not installed.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

struct EmbeddedFile {
    std::string_view name;  ///< the file's stem
    std::string_view text;
};

/// Sorted.
[[nodiscard]] inline std::vector<std::string> embedded_names(std::span<const EmbeddedFile> files) {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : files) names.emplace_back(file.name);
    std::sort(names.begin(), names.end());
    return names;
}

/// The file of a name, null if there is none.
[[nodiscard]] inline const EmbeddedFile* find_embedded(std::span<const EmbeddedFile> files,
                                                       std::string_view name) noexcept {
    for (const EmbeddedFile& file : files) {
        if (file.name == name) return &file;
    }
    return nullptr;
}

/// The text of a file that must be there; hts::Error that names it otherwise.
[[nodiscard]] inline std::string_view embedded_text(std::span<const EmbeddedFile> files,
                                                    std::string_view name) {
    const EmbeddedFile* file = find_embedded(files, name);
    if (file == nullptr) throw Error{"no embedded file " + std::string{name}};
    return file->text;
}

}  // namespace hts::spectral
