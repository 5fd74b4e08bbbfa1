/// The parts that curve files and recipes for importing them have in common. Private to the readers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spectral/text/json_value.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/curve.hpp"

namespace hts::validation {

/// Keys that describe surface, source and instrument.
[[nodiscard]] std::vector<std::string> head_keys();

/// What they say.
///   surface   in place of the key "surface"; empty: the key must be there
///   emissivity   what the quantity is: imports make it one less, hemispherical_reflectance
[[nodiscard]] CurveSet head_from(const spectral::JsonValue& file, const std::string& surface = "",
                                 bool emissivity = false);

/// The key "wavelength_um" or "band_um".
[[nodiscard]] Band band_from(const spectral::JsonValue& object);

/// A whole curve file.
///   place   for messages
[[nodiscard]] CurveSet curves_from_json(const spectral::JsonValue& file, const std::string& stem,
                                        const std::string& place);

/// A number that may be left out.
[[nodiscard]] inline std::optional<double> optional_number(const spectral::JsonValue& object,
                                                           const char* key) {
    const auto found = object.find(key);
    if (!found) return std::nullopt;
    return found->number();
}

/// The one of `values` that a key names.
template <class Values>
[[nodiscard]] auto named(const spectral::JsonValue& key, const Values& values) {
    std::vector<std::string> names;
    for (const auto value : values) {
        if (key.text() == name(value)) return value;
        names.emplace_back(name(value));
    }
    throw key.error(spectral::in_quotes(key.text()) + ": " + spectral::must_be_one_of(key.text(), names));
}

}  // namespace hts::validation
