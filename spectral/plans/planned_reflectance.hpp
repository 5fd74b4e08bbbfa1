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
#include "spectral/energy/compensation.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/plans/scene.hpp"

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
    Tolerance lobe_tolerance;    ///< of the directional-diffuse term in that form; of rough surfaces alone
    bool specular;               ///< whether the specular term is kept, which rough surfaces alone have
    WavelengthGrid wavelengths;  ///< at which the model is evaluated; between them runs a cubic in 1/lambda^2
    RungTable table{};           ///< empty for the model
};

/// A material prepared as a rung says.
///
///     const Plan plan = read_plan("plan.json", tables::models_with_files(), tables::open_for_plan);
///     const Reflectance aluminium = plan.reflectances()[0];
///     std::vector<double> spectrum(aluminium.size());
///     aluminium.brdf({light, view}, spectrum);
///
/// The last two arguments of read_plan, from tables/formats/measured_model.hpp and tables/table/table.hpp
/// (link hts::tables), are for plans with lookup tables or materials of model measured; without these
/// read_plan("plan.json") is enough.
class PlannedForm {
  public:
    /// Most wavelengths of a rung, unless they are all the scene's.
    static constexpr std::size_t most_nodes = 64;

    /// Anything that stands for the model at the rung's wavelengths, else hts::Error; hts::Error too if these
    /// are more than `most_nodes` and not the scene's.
    PlannedForm(const Scene& scene, Rung rung, Reflectance at_nodes);

    [[nodiscard]] const std::string& name() const noexcept { return nodes_.name(); }
    [[nodiscard]] const Rung& rung() const noexcept { return rung_; }
    /// On the scene's wavelengths.
    [[nodiscard]] const Reflectance& reflectance() const noexcept { return reflectance_; }
    /// What is evaluated, at the rung's wavelengths.
    [[nodiscard]] const Reflectance& at_nodes() const noexcept { return nodes_; }
    /// Memory of this object alone; tables that several share, as that of Phi, are not counted.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// Colour of the diffuse terms: of the radiance factor, pi times the BRDF.
    ///   scratch   of at_nodes().size() values, else hts::Error; nothing is allocated
    /// hts::Error unless the scene's output is rgb.
    [[nodiscard]] Xyz colour(const DirectionPair& pair, std::span<double> scratch) const;
    /// Colour of the specular term's reflectance: of white surroundings as the surface mirrors them.
    [[nodiscard]] Xyz specular_colour(const Direction& in) const;

  private:
    [[nodiscard]] Xyz weighted(std::span<const double> at_nodes) const;

    Rung rung_;
    Reflectance nodes_, reflectance_;
    std::vector<Xyz> weights_;  // of the nodes, for colours; none without an illuminant
};

/// A material of a scene, of which forms are made. What they share is prepared once.
class MaterialForms {
  public:
    /// Both outlive this.
    ///   cost   where the scene compensates energy, some 50 ms for each of its wavelengths
    MaterialForms(const Scene& scene, const Material& material);

    [[nodiscard]] const Material& material() const noexcept { return material_; }
    /// hts::Error if the rung's wavelengths leave the range of the material and the scene does not clamp, or
    /// if the model has no such form.
    [[nodiscard]] PlannedForm at(const Rung& rung) const;
    /// What the form of a rung evaluates at the rung's wavelengths.
    [[nodiscard]] Reflectance at_nodes(const Rung& rung) const;
    /// All of the model at the scene's wavelengths.
    ///   tolerance   of the terms of rough surfaces
    [[nodiscard]] PlannedForm full_model(Tolerance tolerance = Tolerance{
                                             hts::accuracy::finest_tolerance}) const;

  private:
    const Scene& scene_;
    const Material& material_;
    std::vector<EnergyCompensation> compensation_;  // at the scene's wavelengths; none without
};

}  // namespace hts::spectral
