/// The files of validation/report/data/ as they are embedded in the library. Private to `recorded`.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::validation {

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> recorded_files() noexcept;

}  // namespace hts::validation
