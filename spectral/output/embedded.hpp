/// The files of scripts/ and pages/ as they are embedded. Private to the room.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::output {

// Defined in sources that spectral/text/embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> script_files() noexcept;
[[nodiscard]] std::span<const spectral::EmbeddedFile> page_files() noexcept;

}  // namespace hts::output
