#include "spectral/models/material.hpp"

#include <algorithm>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {

Material::Material(Prepare prepare, Properties properties, std::vector<std::string> warnings,
                   std::string substance)
    : prepare_{std::move(prepare)},
      properties_{std::move(properties)},
      warnings_{std::move(warnings)},
      substance_{std::move(substance)} {}

Material Material::named(std::string name, std::string model_name, std::string model_source) const {
    Material result = *this;
    result.name_ = std::move(name);
    result.model_name_ = std::move(model_name);
    result.model_source_ = std::move(model_source);
    return result;
}

Reflectance Material::at(const WavelengthGrid& wavelengths, const EvaluationOptions& options) const {
    const auto refuse = [&](const std::string& what) {
        return Error{name_ + ": " + what + ", since its model is " + model_name_ + ", not he"};
    };
    if (!properties_.surface) {
        if (options.compensate_energy) throw refuse("energy compensation: must be off");
        if (options.instead.any()) throw refuse("values of a rough surface: must not be given");
        if (options.lobe != DiffuseLobe::full && options.lobe != DiffuseLobe::none)
            throw refuse(std::string{"lobe "} + hts::name(options.lobe) + ": must be full or none");
    }
    return prepare_(name_, wavelengths, options);
}

Reflectance Material::at(const Wavelength& wavelength, const EvaluationOptions& options) const {
    return at(WavelengthGrid::from_micrometres({wavelength.micrometres()}), options);
}

Material read_material(const std::filesystem::path& path, const std::vector<ModelEntry>& models) {
    return material_from_text(read_text_file(path), path, models);
}

Material material_from_text(const std::string& text, const std::filesystem::path& path,
                            const std::vector<ModelEntry>& models) {
    return material_from_json(
        {JsonValue::parse(text, path.string()), path.parent_path(), path.stem().string()}, models);
}

Material material_from_json(const MaterialFile& file, const std::vector<ModelEntry>& models) {
    const JsonValue model = file.json["model"];
    const auto name = file.json.find("name");
    const auto named = [&](const ModelEntry& entry) { return entry.name == model.text(); };
    const auto entry = std::find_if(models.begin(), models.end(), named);
    if (entry == models.end()) {
        std::vector<std::string> known;
        known.reserve(models.size());
        for (const ModelEntry& one : models) known.push_back(one.name);
        throw model.error(in_quotes(model.text()) + " is not known; " + must_be_one_of(model.text(), known));
    }
    // what may stand beside a material and is no part of it: what a fit notes, and standard deviations
    const MaterialFile own{file.json.without({"fitted", "uncertainty"}), file.folder, file.default_name};
    return entry->read(own).named(name ? name->text() : file.default_name, entry->name, entry->source);
}

void require_spectrum(const Material& material) {
    const auto& channels = material.properties().channels;
    if (channels.empty()) return;
    throw Error{
        material.name() + ": holds the channel" + (channels.size() == 1 ? " " : "s ") + joined(channels) +
        ", which are no spectrum: must hold wavelengths (wavelengths_um in the material file if they are)"};
}

}  // namespace hts::spectral
