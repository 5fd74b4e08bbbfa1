/// Optical constants, and numbers that depend on wavelength, in JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "spectral/materials/optical_constants.hpp"
#include "spectral/text/json_value.hpp"

namespace hts::spectral {

/// The key "index" of a material file.
///   folder   relative paths of files start here
[[nodiscard]] OpticalConstants optical_constants_from(const JsonValue& index,
                                                      const std::filesystem::path& folder);

/// Returns the value it is given, perhaps in another unit, or throws hts::Error that names the legal range.
using NumberCheck = std::function<double(double)>;

/// [[um, value], …]
[[nodiscard]] PiecewiseLinear number_table(const JsonValue& table, const char* column,
                                           const NumberCheck& check);

///   object   {"table": [[um, n, k], …]}, with optional "name" and "source"
///   name     of the material where the object has none
[[nodiscard]] OpticalConstants optical_constants_from_json(const JsonValue& object, const std::string& name);

}  // namespace hts::spectral
