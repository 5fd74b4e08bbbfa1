/// The shader of the model as text, embedded at build time. Not installed.
#pragma once

#include <span>

#include "spectral/text/embedded_file.hpp"

namespace hts::tables {

[[nodiscard]] std::span<const spectral::EmbeddedFile> shader_files() noexcept;

}  // namespace hts::tables
