/// A material evaluated by as much of the model as a plan says it needs.
///
/// Conventions as in spectral/reflectance.hpp; colours as in spectral/colour.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "spectral/colour.hpp"
#include "spectral/reflectance.hpp"

namespace hts::spectral {

/// What of the model is kept, and at which wavelengths: a step of the planner's ladder.
struct Rung {
    DiffuseLobe lobe;
    Tolerance lobe_tolerance;  ///< of the directional-diffuse term in that form
    bool specular;             ///< whether the mirror term is kept
    WavelengthGrid wavelengths;
};

/// A reflector prepared as a rung says, ready for evaluation.
///
///     const auto materials = read_plan("plan.json").evaluators();
///     std::vector<double> spectrum(materials[0].size());
///     materials[0].diffuse().brdf({light, view}, spectrum);
class PlannedReflectance {
  public:
    ///   illuminant   where colours are wanted; then the wavelengths must cover what tristimulus_weights asks for
    /// hts::Error if the rung's wavelengths leave the range of the optical constants and `policy` is error.
    PlannedReflectance(const Reflector& reflector, Rung rung, OutsideRange policy,
                       std::optional<Illuminant> illuminant);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const Rung& rung() const noexcept { return rung_; }
    [[nodiscard]] bool has_colour() const noexcept { return weights_.has_value(); }
    /// Number of wavelengths.
    [[nodiscard]] std::size_t size() const noexcept { return diffuse_.size(); }
    /// Memory of this object alone; the table of Phi is shared by all.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// Evaluates BRDF and Mueller matrices of both diffuse terms, by `brdf` and `mueller`, as the rung says.
    [[nodiscard]] const SpectralReflectance& diffuse() const noexcept { return diffuse_; }
    /// Reflectance into the mirror direction, one per wavelength; zeros if the rung drops it.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;
    /// Its Mueller matrices.
    [[nodiscard]] std::vector<Mueller> specular_mueller(const Direction& in) const;

    /// Colour of the diffuse terms: of the radiance factor, pi times the BRDF.
    ///   scratch   of size() values, else hts::Error; the BRDF afterwards [1/sr]. Nothing is allocated
    /// hts::Error without an illuminant.
    [[nodiscard]] Xyz colour(const DirectionPair& pair, std::span<double> scratch) const;
    /// Colour of the mirror term's reflectance: of white surroundings as the surface mirrors them.
    [[nodiscard]] Xyz specular_colour(const Direction& in) const;

  private:
    [[nodiscard]] const TristimulusWeights& weights() const;

    std::string name_;
    Rung rung_;
    SpectralReflectance diffuse_;
    std::optional<TristimulusWeights> weights_;
};

}  // namespace hts::spectral
