/// What a material file says, whatever the model: ready to be asked at any wavelengths.
///
///     const Material aluminium = read_material("cli/data/rough-aluminium.json");
///     const Reflectance reflectance = aluminium.at(WavelengthGrid::linear(0.4, 0.7, 4));
///     const std::vector<double> brdf = reflectance.brdf({in, out});                              // 1/sr
///
/// `built_in_models` is the registry that gives meaning to the key "model", a line per model in
/// model_readers.cpp. A program adds a line of its own, or needs no file at all: material_of
/// (model_evaluator.hpp) takes any hts::ReflectanceModel.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hts/tolerance.hpp"
#include "hts/wavelength.hpp"
#include "spectral/materials/piecewise_linear.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

/// Values of a rough surface that a caller knows better than its material does: they
/// go before the material's.
struct RoughSurfaceValues {
    std::optional<double> n{}, k{};  ///< at every wavelength, where the material then need not be known
    std::optional<double> rms_roughness{}, correlation_length{};  ///< [um]
    /// Along both axes [um], and a direction with the azimuth of the first; a single
    /// correlation_length goes before them.
    std::optional<double> correlation_length_x{}, correlation_length_y{};
    std::optional<Direction> axis{};
    std::optional<double> diffuse_albedo{};

    [[nodiscard]] bool any() const noexcept {
        return n || k || rms_roughness || correlation_length || correlation_length_x ||
               correlation_length_y || axis || diffuse_albedo;
    }
    /// A surface with what is given here.
    [[nodiscard]] Surface of(const Surface& own) const;
};

/// How a material is to be evaluated.
struct EvaluationOptions {
    /// Relative, of rough surfaces; other models are evaluated as they are, but for the integral of `albedo`.
    Tolerance tolerance{};
    OutsideRange outside = OutsideRange::error;  ///< where the material is not known at a wavelength
    DiffuseLobe lobe =
        DiffuseLobe::full;           ///< a limit where a rough surface needs no more; of others full or none
    bool compensate_energy = false;  ///< as spectral/energy/compensation.hpp says; of rough surfaces alone
    RoughSurfaceValues instead{};    ///< of rough surfaces alone
};

/// A surface and its model. Immutable; copies share what they hold.
class Material {
  public:
    /// A material at wavelengths; hts::Error where it is not known there and the options say error.
    using Prepare = std::function<Reflectance(const std::string& name, const WavelengthGrid& wavelengths,
                                              const EvaluationOptions& options)>;

    ///   properties   of the material at any wavelength
    ///   warnings     what the description says that the model cannot be; a line each
    ///   substance    name of the optical constants, where the model has them: "Al"
    explicit Material(Prepare prepare, Properties properties = {}, std::vector<std::string> warnings = {},
                      std::string substance = {});

    /// The same under another name, as a description has it.
    ///   model_name     as material files name it: "he", "walter", …
    ///   model_source   "Walter, Marschner, Li, Torrance 2007"
    [[nodiscard]] Material named(std::string name, std::string model_name, std::string model_source) const;

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::string& model_name() const noexcept { return model_name_; }
    [[nodiscard]] const std::string& model_source() const noexcept { return model_source_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    [[nodiscard]] const std::string& substance() const noexcept { return substance_; }
    /// What can be asked of it. `transmitting` and `isotropic` may depend on wavelength: a Reflectance knows.
    [[nodiscard]] const Properties& properties() const noexcept { return properties_; }

    /// The material at wavelengths. hts::Error where it is not known at one of them and the options say
    /// error, or where the model has no such lobe, no energy compensation or no such values.
    ///   cost   with energy compensation some 50 ms a wavelength
    [[nodiscard]] Reflectance at(const WavelengthGrid& wavelengths,
                                 const EvaluationOptions& options = {}) const;
    [[nodiscard]] Reflectance at(const Wavelength& wavelength, const EvaluationOptions& options = {}) const;

  private:
    Prepare prepare_;
    Properties properties_;
    std::vector<std::string> warnings_;
    std::string substance_, name_, model_name_, model_source_;
};

/// hts::Error of materials that hold the channels of a colour in place of a spectrum.
void require_spectrum(const Material& material);

/// A material file on its way to a Material.
struct MaterialFile {
    JsonValue json;
    std::filesystem::path folder;  ///< where relative paths begin
    std::string default_name;      ///< where there is no "name"
};

/// A model that material files may name.
struct ModelEntry {
    std::string name;    ///< value of the key "model"
    std::string source;  ///< the paper
    /// Reads the model's own keys; hts::Error for those unknown, missing, of a wrong type or out of range.
    std::function<Material(const MaterialFile& file)> read;
};

/// All models of the library.
[[nodiscard]] const std::vector<ModelEntry>& built_in_models();

/// Reads a material file (JSON) of any model; the documentation lists the keys. Throws hts::Error
/// "path: key "lobes[1].mx": …" that names the key and the legal range.
[[nodiscard]] Material read_material(const std::filesystem::path& path,
                                     const std::vector<ModelEntry>& models = built_in_models());
/// The same from the text of a file that stood at `path`, where its relative paths begin.
[[nodiscard]] Material material_from_text(const std::string& text, const std::filesystem::path& path,
                                          const std::vector<ModelEntry>& models = built_in_models());
/// The same from a part of a file.
[[nodiscard]] Material material_from_json(const MaterialFile& file,
                                          const std::vector<ModelEntry>& models = built_in_models());

}  // namespace hts::spectral
