/// Optical constants in JSON. Private to the readers.
#pragma once

#include <string>

#include "spectral/materials/optical_constants.hpp"
#include "spectral/text/json_value.hpp"

namespace hts::spectral {

///   object   {"table": [[um, n, k], …]}, with optional "name" and "source"
///   name     of the material where the object has none
[[nodiscard]] Material material_from_json(const JsonValue& object, const std::string& name);

}  // namespace hts::spectral
