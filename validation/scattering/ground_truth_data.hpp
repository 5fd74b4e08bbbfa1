/// The files of validation/scattering/data/ as they are embedded in the library. Private to `ground_truth`.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::validation {

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> kept_files() noexcept;

}  // namespace hts::validation
