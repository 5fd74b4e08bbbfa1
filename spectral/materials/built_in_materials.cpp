#include <algorithm>
#include <map>
#include <mutex>

#include "hts/error.hpp"
#include "spectral/materials/built_in_data.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/materials/optical_constants_yaml.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

const EmbeddedFile& built_in_file(std::string_view name) {
    const EmbeddedFile* found = find_embedded(built_in_files(), name);
    if (found == nullptr) {
        throw Error{"no built-in material " + in_quotes(name) + ": " +
                    must_be_one_of(name, optical_constants_names())};
    }
    return *found;
}

}  // namespace

std::vector<std::string> optical_constants_names() {
    return embedded_names(built_in_files());
}

OpticalConstants built_in_optical_constants(std::string_view name) {
    static std::mutex mutex;
    static std::map<std::string_view, OpticalConstants> parsed;
    const EmbeddedFile& file = built_in_file(name);
    const std::lock_guard lock{mutex};
    auto found = parsed.find(file.name);
    if (found == parsed.end()) {
        const std::string stem{file.name};
        found =
            parsed.emplace(file.name, material_from_yaml(std::string{file.text}, stem, stem + ".yml")).first;
    }
    return found->second;
}

}  // namespace hts::spectral
