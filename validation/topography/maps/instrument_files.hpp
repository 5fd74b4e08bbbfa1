/// Files of instruments that Python packages read. Private to the room.
#pragma once

#include <filesystem>
#include <string>

namespace hts::validation {

/// Whether a file may be one of them, by its ending: .sdf, .x3p, .al3d, .sur and others.
[[nodiscard]] bool is_instrument_file(const std::filesystem::path& path);

/// The file as a Gwyddion Simple Field, heights from its first one, by the packages surfalize or
/// SurfaceTopography of the python3 in PATH. hts::Error that says what to install, or why neither reads it.
[[nodiscard]] std::string instrument_file_as_gsf(const std::filesystem::path& path);

}  // namespace hts::validation
