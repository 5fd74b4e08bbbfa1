/// What the sections of a report say in front of their numbers: the files of validation/report/prose/,
/// embedded.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "spectral/text/embedded_file.hpp"

namespace hts::validation {

/// The text of STEM.txt, its paragraphs apart by empty lines, each on one line. hts::Error if there is none.
[[nodiscard]] std::string prose(std::string_view stem);

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> prose_files() noexcept;

}  // namespace hts::validation
