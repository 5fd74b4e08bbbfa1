/// The files of spectral/materials/data/ as they are embedded in the library. Private to the readers.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::spectral {

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const EmbeddedFile> built_in_files() noexcept;

}  // namespace hts::spectral
