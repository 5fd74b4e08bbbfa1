#include "validation/curves/built_in_curves.hpp"

#include <algorithm>
#include <filesystem>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/curve_json.hpp"

namespace hts::validation {

std::vector<std::string> built_in_curve_names() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embedded_curves()) names.emplace_back(file.name);
    std::sort(names.begin(), names.end());
    return names;
}

CurveSet built_in_curves(std::string_view name) {
    const auto files = embedded_curves();
    const auto found =
        std::find_if(files.begin(), files.end(), [name](const EmbeddedFile& f) { return f.name == name; });
    if (found == files.end()) {
        throw Error{"no curve set " + spectral::in_quotes(name) + ": must be a file or one of " +
                    spectral::joined(built_in_curve_names())};
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
