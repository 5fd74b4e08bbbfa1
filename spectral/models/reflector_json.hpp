/// Materials in JSON, in a file of their own or inside another. Private to the readers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "spectral/models/reflector.hpp"
#include "spectral/text/json_value.hpp"

namespace hts::spectral {

/// What `read_reflector` reads; hts::Error "path: key "…": …".
///   folder         relative paths of index files start here
///   default_name   where there is no "name"
[[nodiscard]] Reflector reflector_from_json(const JsonValue& description, const std::filesystem::path& folder,
                                            const std::string& default_name);

/// The key "index".
[[nodiscard]] Material material_from(const JsonValue& index, const std::filesystem::path& folder);

/// Returns the value it is given, perhaps in another unit, or throws hts::Error that names the legal range.
using NumberCheck = std::function<double(double)>;

/// [[um, value], …]
[[nodiscard]] PiecewiseLinear number_table(const JsonValue& table, const char* column,
                                           const NumberCheck& check);

}  // namespace hts::spectral
