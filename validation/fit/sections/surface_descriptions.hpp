/// What `hts surface` made of the height maps of two coatings: the files of validation/topography/data/, as
/// they are embedded in the library. Private to the sections.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::validation {

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> surface_descriptions() noexcept;

}  // namespace hts::validation
