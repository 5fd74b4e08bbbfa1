#include "spectral/models/any_reflector.hpp"

#include <algorithm>
#include <utility>

#include "spectral/models/model_readers.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {

AnyReflector::AnyReflector(AtWavelength at, std::vector<std::string> warnings)
    : at_{std::move(at)}, warnings_{std::move(warnings)} {}

AnyReflector::AnyReflector(Reflector reflector)
    : at_{[reflector](const Wavelength& wavelength, OutsideRange policy) {
          return AnyModel::he_torrance(reflector.surface,
                                       {wavelength, reflector.material.index(wavelength, policy),
                                        hts::uniform_diffuse(reflector.albedo(wavelength, policy))});
      }},
      he_{std::move(reflector)},
      name_{he_->name},
      model_name_{"he"},
      model_source_{"He, Torrance, Sillion, Greenberg 1991"} {}

AnySpectrum AnyReflector::spectrum(const WavelengthGrid& wavelengths, OutsideRange policy) const {
    std::vector<AnyModel> models;
    for (std::size_t i = 0; i < wavelengths.size(); ++i) models.push_back(at(wavelengths[i], policy));
    return AnySpectrum{std::move(models)};
}

AnyReflector read_any_reflector(const std::filesystem::path& path, const std::vector<ModelEntry>& models) {
    return any_reflector_from_text(read_text_file(path), path, models);
}

AnyReflector any_reflector_from_text(const std::string& text, const std::filesystem::path& path,
                                     const std::vector<ModelEntry>& models) {
    return any_reflector_from_json(
        {JsonValue::parse(text, path.string()), path.parent_path(), path.stem().string()}, models);
}

AnyReflector any_reflector_from_json(const MaterialFile& file, const std::vector<ModelEntry>& models) {
    const JsonValue model = file.json["model"];
    const auto name = file.json.find("name");
    const auto named = [&](const ModelEntry& entry) { return entry.name == model.text(); };
    const auto entry = std::find_if(models.begin(), models.end(), named);
    if (entry == models.end()) {
        std::vector<std::string> known;
        known.reserve(models.size());
        for (const ModelEntry& one : models) known.push_back(one.name);
        throw model.error(in_quotes(model.text()) + " is not known; must be one of " + joined(known));
    }
    AnyReflector reflector = entry->read(file);
    reflector.name_ = name ? name->text() : file.default_name;
    reflector.model_name_ = entry->name;
    reflector.model_source_ = entry->source;
    return reflector;
}

}  // namespace hts::spectral
