#include "cli/io/references.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/models/material.hpp"
#include "spectral/text/run_files.hpp"
#include "tables/formats/measured_model.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// NOLINTNEXTLINE(misc-no-recursion): models nest
bool move_references(Json& value, const std::string& output) {
    bool moved = false;
    for (auto& [key, part] : value.items()) {
        if (key == "file" && part.is_string() && value.is_object()) {
            part = reference_from(output, part.get<std::string>());
            moved = true;
        } else if (part.is_structured()) {
            moved = move_references(part, output) || moved;
        }
    }
    return moved;
}

}  // namespace

std::string reference_from(const std::string& output, const std::string& file) {
    if (std::error_code failed; !fs::is_regular_file(file, failed))
        throw Error{file + ": no file that " + output + " could name: must be one that stays"};
    const fs::path target = fs::canonical(file);
    const fs::path folder = fs::weakly_canonical(fs::absolute(output).parent_path());
    // where the output is a link into another folder, no relative way leads back from both
    if (fs::path{spectral::resolved(output)}.parent_path() != folder) return target.string();
    const fs::path relative = target.lexically_relative(folder);
    return (relative.empty() ? target : relative).string();
}

std::string verified(const std::string& output, std::string text) {
    static_cast<void>(spectral::material_from_text(text, output, tables::models_with_files()));
    return text;
}

std::string material_for(const std::string& output, const std::string& text) {
    Json material = Json::parse(text);
    return verified(output, move_references(material, output) ? material.dump(2) + "\n" : text);
}

}  // namespace hts::cli
