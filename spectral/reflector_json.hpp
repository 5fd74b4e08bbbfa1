/// Reflectors in JSON, in a file of their own or inside another. Private to the readers.
#pragma once

#include <filesystem>
#include <string>

#include "spectral/json_value.hpp"
#include "spectral/reflector.hpp"

namespace hts::spectral {

/// What `read_reflector` reads; hts::Error "path: key "…": …".
///   folder         relative paths of index files start here
///   default_name   where there is no "name"
[[nodiscard]] Reflector reflector_from_json(const JsonValue& description, const std::filesystem::path& folder,
                                            const std::string& default_name);

}  // namespace hts::spectral
