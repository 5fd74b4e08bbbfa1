/// Optical constants in the YAML schema of refractiveindex.info. Private to the readers.
#pragma once

#include <string>
#include <string_view>

#include "spectral/materials/optical_constants.hpp"

namespace hts::spectral {

///   text    the file        name    of the material        file    path for messages, "path:line: …"
[[nodiscard]] OpticalConstants material_from_yaml(const std::string& text, std::string name,
                                                  const std::string& file);

/// A text with HTML tags, HTML entities and line breaks, as one plain line.
[[nodiscard]] std::string plain_line(std::string_view html);

}  // namespace hts::spectral
