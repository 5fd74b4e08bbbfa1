/// A described surface whatever its model: what a material file says, ready to be asked at any wavelength.
///
///     const AnyModel model = read_any_reflector("m.json").at(Wavelength::from_micrometres(0.5));
///     const double f = model.brdf(in, out);                                                    // 1/sr
///
/// `built_in_models` is the registry that gives meaning to the key "model", a line per model in model_readers.cpp. A program
/// with a model of its own needs no entry: AnyModel{MyModel{…}}.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spectral/models/any_model.hpp"
#include "spectral/models/reflector.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

/// A surface and its model.
class AnyReflector {
  public:
    /// The model at a wavelength; hts::Error where the surface is not known there and the policy says so.
    using AtWavelength = std::function<AnyModel(const Wavelength& wavelength, OutsideRange policy)>;

    explicit AnyReflector(AtWavelength at, std::vector<std::string> warnings = {});
    /// The He-Torrance model.
    explicit AnyReflector(Reflector reflector);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// As material files name it: "he", "walter", …
    [[nodiscard]] const std::string& model_name() const noexcept { return model_name_; }
    /// "Walter, Marschner, Li, Torrance 2007".
    [[nodiscard]] const std::string& model_source() const noexcept { return model_source_; }
    /// What the description says that the model cannot be; a line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// For what only He-Torrance surfaces have: polarisation, validity, compensation. Null for others.
    [[nodiscard]] const Reflector* he_torrance() const noexcept { return he_ ? &*he_ : nullptr; }

    /// hts::Error where the description ends short of the wavelength and `policy` is error.
    [[nodiscard]] AnyModel at(const Wavelength& wavelength, OutsideRange policy = OutsideRange::error) const {
        return at_(wavelength, policy);
    }
    /// The same at every wavelength of a grid, evaluated together.
    [[nodiscard]] AnySpectrum spectrum(const WavelengthGrid& wavelengths,
                                       OutsideRange policy = OutsideRange::error) const;

  private:
    friend AnyReflector any_reflector_from_json(const struct MaterialFile& file,
                                                const std::vector<struct ModelEntry>& models);

    AtWavelength at_;
    std::vector<std::string> warnings_;
    std::optional<Reflector> he_;
    std::string name_, model_name_, model_source_;
};

struct MaterialFile;

/// A model that material files may name.
struct ModelEntry {
    std::string name;    ///< value of the key "model"
    std::string source;  ///< the paper
    /// Reads the model's own keys; hts::Error for those unknown, missing, of a wrong type or out of range.
    std::function<AnyReflector(const MaterialFile& file)> read;
};

/// All models of the library.
[[nodiscard]] const std::vector<ModelEntry>& built_in_models();

/// Reads a material file (JSON) of any model; the keys are in the README. Throws hts::Error
/// "path: key "lobes[1].mx": …" that names the key and the legal range.
[[nodiscard]] AnyReflector read_any_reflector(const std::filesystem::path& path,
                                              const std::vector<ModelEntry>& models = built_in_models());
/// The same from the text of a file that stood at `path`, where its relative paths begin.
[[nodiscard]] AnyReflector any_reflector_from_text(const std::string& text, const std::filesystem::path& path,
                                                   const std::vector<ModelEntry>& models = built_in_models());

}  // namespace hts::spectral
