#include "validation/curves/built_in_curves.hpp"

#include <filesystem>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/curve_json.hpp"

namespace hts::validation {

std::vector<std::string> built_in_curve_names() {
    return spectral::embedded_names(embedded_curves());
}

CurveSet built_in_curves(std::string_view name) {
    const spectral::EmbeddedFile* found = spectral::find_embedded(embedded_curves(), name);
    if (found == nullptr) {
        throw Error{"no curve set " + spectral::in_quotes(name) + ": must be a file or one of " +
                    spectral::joined(built_in_curve_names()) +
                    spectral::did_you_mean(name, built_in_curve_names())};
    }
    const std::string stem{name}, path = std::string{"validation/curves/data/"}.append(stem).append(".json");
    return curves_from_json(spectral::JsonValue::parse(std::string{found->text}, path), stem, path);
}

CurveSet curves_named(const std::string& name_or_path) {
    std::error_code ignored;
    return std::filesystem::exists(name_or_path, ignored) ? read_curves(name_or_path)
                                                          : built_in_curves(name_or_path);
}

}  // namespace hts::validation
