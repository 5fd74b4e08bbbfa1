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
#include "spectral/scene.hpp"
#include "spectral/spectrum_interpolation.hpp"

namespace hts::spectral {

/// What of the model is kept, and at which wavelengths: a step of the planner's ladder.
struct Rung {
    DiffuseLobe lobe;
    Tolerance lobe_tolerance;    ///< of the directional-diffuse term in that form
    bool specular;               ///< whether the mirror term is kept
    WavelengthGrid wavelengths;  ///< at which the model is evaluated; between them runs a cubic in 1/lambda^2
};

/// A reflector prepared as a rung says, ready for evaluation on the scene's wavelengths.
///
///     const auto materials = read_plan("plan.json").evaluators();
///     std::vector<double> spectrum(materials[0].size());
///     materials[0].brdf({light, view}, spectrum);
class PlannedReflectance {
  public:
    /// Most wavelengths of a rung, unless they are all the scene's.
    static constexpr std::size_t most_nodes = 64;

    /// hts::Error if the rung's wavelengths leave the range of the optical constants and the scene does not clamp, or
    /// if they are more than `most_nodes` and not the scene's.
    PlannedReflectance(const Scene& scene, const Reflector& reflector, Rung rung);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const Rung& rung() const noexcept { return rung_; }
    /// The scene's wavelengths, on which spectra come, and their number.
    [[nodiscard]] const WavelengthGrid& wavelengths() const noexcept { return wavelengths_; }
    [[nodiscard]] std::size_t size() const noexcept { return wavelengths_.size(); }
    /// Number of wavelengths at which the model is evaluated.
    [[nodiscard]] std::size_t nodes() const noexcept { return nodes_.size(); }
    /// The model at these.
    [[nodiscard]] const SpectralReflectance& at_nodes() const noexcept { return nodes_; }
    /// Memory of this object alone; the table of Phi is shared by all.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// BRDF of both diffuse terms [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same into `result` of size() values, else hts::Error; allocates nothing.
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// The same for many pairs, as SpectralReflectance::brdf does it.
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
    [[nodiscard]] Xyz weighted(std::span<const double> at_nodes) const;
    void specular_at_nodes(const Direction& in, std::span<double> result) const;

    std::string name_;
    Rung rung_;
    WavelengthGrid wavelengths_;
    bool polarised_;
    SpectralReflectance nodes_;
    SpectrumInterpolation interpolation_;
    std::vector<Xyz> weights_;  // of the nodes, for colours; none without an illuminant
};

}  // namespace hts::spectral
