/// The files of spectral/energy/data/ as they are embedded in the library. Private to expected_distance.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::spectral {

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const EmbeddedFile> distance_files() noexcept;

}  // namespace hts::spectral
