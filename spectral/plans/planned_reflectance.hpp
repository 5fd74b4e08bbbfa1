/// A material of any model, evaluated by as much of it as a plan says it needs.
///
/// Conventions as in spectral/models/reflectance.hpp; colours as in spectral/colour/colour.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "spectral/colour/colour.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/models/spectral_brdf.hpp"
#include "spectral/plans/scene.hpp"
#include "spectral/plans/spectrum_interpolation.hpp"

namespace hts::spectral {

/// A table that is looked up in the model's place.
struct RungTable {
    std::string file;      ///< beside the plan
    std::string checksum;  ///< 16 hexadecimal digits, as the table knows it

    [[nodiscard]] bool empty() const noexcept { return file.empty(); }
};

/// What of the model is kept, and at which wavelengths: a step of the planner's ladder.
struct Rung {
    DiffuseLobe lobe;            ///< of models other than he full, or none: the uniform-diffuse part alone
    Tolerance lobe_tolerance;    ///< of the directional-diffuse term in that form; of model he alone
    bool specular;               ///< whether the mirror term is kept, which model he alone has
    WavelengthGrid wavelengths;  ///< at which the model is evaluated; between them runs a cubic in 1/lambda^2
    RungTable table{};           ///< empty for the model
};

/// A reflector prepared as a rung says, ready for evaluation on the scene's wavelengths.
///
///     const Plan plan = read_plan("plan.json", tables::models_with_files(), tables::open_for_plan);
///     const auto materials = plan.evaluators();
///     std::vector<double> spectrum(materials[0].size());
///     materials[0].brdf({light, view}, spectrum);
///
/// The last two arguments of read_plan, from tables/formats/measured_model.hpp and tables/table/table.hpp (link hts::tables), are for plans
/// with lookup tables or materials of model measured; without these read_plan("plan.json") is enough.
class PlannedReflectance {
  public:
    /// Most wavelengths of a rung, unless they are all the scene's.
    static constexpr std::size_t most_nodes = 64;

    /// hts::Error if the rung's wavelengths leave the range of the optical constants and the scene does not clamp,
    /// if they are more than `most_nodes` and not the scene's, or if the model has no such form.
    ///   cost   where the scene compensates energy, some 50 ms for each of its wavelengths: see MaterialForms
    PlannedReflectance(const Scene& scene, const AnyReflector& material, const Rung& rung);
    /// The same with anything that stands for the model at the rung's wavelengths, else hts::Error.
    PlannedReflectance(const Scene& scene, Rung rung, std::shared_ptr<const SpectralBrdf> at_nodes);

    [[nodiscard]] const std::string& name() const noexcept { return nodes_->name(); }
    [[nodiscard]] const Rung& rung() const noexcept { return rung_; }
    /// The scene's wavelengths, on which spectra come, and their number.
    [[nodiscard]] const WavelengthGrid& wavelengths() const noexcept { return wavelengths_; }
    [[nodiscard]] std::size_t size() const noexcept { return wavelengths_.size(); }
    /// Number of wavelengths at which the model is evaluated.
    [[nodiscard]] std::size_t nodes() const noexcept { return rung_.wavelengths.size(); }
    /// What is evaluated at these.
    [[nodiscard]] const SpectralBrdf& at_nodes() const noexcept { return *nodes_; }
    /// Memory of this object alone; tables that several share, as that of Phi, are not counted.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// BRDF of both diffuse terms [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same into `result` of size() values, else hts::Error; allocates nothing.
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// The same for many pairs, into pairs.size() * size() values, on all cores; the same bits for any number of threads.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;
    /// Reflectance into the mirror direction, one per wavelength; zeros if the rung drops it.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;
    /// The same [1] into `result` of size() values, else hts::Error; allocates nothing.
    void specular_reflectance(const Direction& in, std::span<double> result) const;

    /// Mueller matrices of both diffuse terms [1/sr] and of the mirror term [1], one per wavelength; hts::Error unless the
    /// scene is polarised.
    [[nodiscard]] std::vector<Mueller> mueller(const DirectionPair& pair) const;
    [[nodiscard]] std::vector<Mueller> specular_mueller(const Direction& in) const;

    /// Colour of the diffuse terms: of the radiance factor, pi times the BRDF.
    ///   scratch   of nodes() values, else hts::Error; nothing is allocated
    /// hts::Error unless the scene's output is rgb.
    [[nodiscard]] Xyz colour(const DirectionPair& pair, std::span<double> scratch) const;
    /// Colour of the mirror term's reflectance: of white surroundings as the surface mirrors them.
    [[nodiscard]] Xyz specular_colour(const Direction& in) const;

  private:
    void require_mueller() const;
    void brdf_block(std::span<const DirectionPair> pairs, std::span<double> result) const noexcept;
    [[nodiscard]] Xyz weighted(std::span<const double> at_nodes) const;
    void specular_at_nodes(const Direction& in, std::span<double> result) const;

    Rung rung_;
    WavelengthGrid wavelengths_;
    bool polarised_;
    std::shared_ptr<const SpectralBrdf> nodes_;
    SpectrumInterpolation interpolation_;
    std::vector<Xyz> weights_;  // of the nodes, for colours; none without an illuminant
};

/// A material of a scene, of which evaluators are made. What they share is prepared once.
class MaterialForms {
  public:
    /// Both outlive this.
    ///   cost   where the scene compensates energy, some 50 ms for each of its wavelengths
    MaterialForms(const Scene& scene, const AnyReflector& material);

    [[nodiscard]] const AnyReflector& material() const noexcept { return material_; }
    [[nodiscard]] PlannedReflectance at(const Rung& rung) const;
    /// What the evaluator of a rung evaluates at the rung's wavelengths.
    [[nodiscard]] std::unique_ptr<SpectralBrdf> at_nodes(const Rung& rung) const;
    /// All of the model at the scene's wavelengths.
    ///   tolerance   of the terms of model he
    [[nodiscard]] PlannedReflectance full_model(Tolerance tolerance = Tolerance{
                                                    hts::accuracy::finest_tolerance}) const;

  private:
    const Scene& scene_;
    const AnyReflector& material_;
    std::vector<EnergyCompensation> compensation_;  // at the scene's wavelengths; none without
};

}  // namespace hts::spectral
