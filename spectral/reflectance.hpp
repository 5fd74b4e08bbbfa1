/// Spectral BRDF, specular reflectance and polarised reflection of a reflector over a wavelength grid.
///
/// Conventions of directions in hts/direction.hpp, of Stokes vectors in hts/polarisation.hpp. What does not
/// depend on wavelength is computed once per direction pair; spectra come in the grid's order.
#pragma once

#include <span>
#include <vector>

#include "hts/he_torrance.hpp"
#include "spectral/reflector.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

/// Light from `in` seen from `out`.
struct DirectionPair {
    Direction in, out;
};

/// A reflector with its optical constants looked up on a wavelength grid, ready for evaluation.
class SpectralReflectance {
  public:
    /// Throws hts::Error if the grid leaves the range of the optical constants or albedo and `policy` is
    /// error.
    SpectralReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                        OutsideRange policy = OutsideRange::error);

    [[nodiscard]] std::size_t size() const noexcept { return samples_.size(); }

    /// BRDF of the directional and uniform diffuse terms together [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same for many pairs, into `result` of pairs.size() * size() values, all wavelengths of a pair
    /// together. Runs on all cores; the same bits for any number of threads.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;

    /// Directional-diffuse term with its parts, one per wavelength.
    [[nodiscard]] std::vector<DirectionalDiffuse> directional_diffuse(const DirectionPair& pair) const;
    /// Uniform-diffuse BRDF [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> uniform_diffuse() const;
    /// Reflectance into the mirror direction, one per wavelength.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;

    /// Mueller matrix of both diffuse terms [1/sr], one per wavelength.
    [[nodiscard]] std::vector<Mueller> mueller(const DirectionPair& pair) const;
    /// Mueller matrix of the specular term [1], one per wavelength.
    [[nodiscard]] std::vector<Mueller> specular_mueller(const Direction& in) const;

  private:
    struct Sample {
        Wavelength wavelength;
        RefractiveIndex index;
        double uniform_diffuse;  // BRDF [1/sr]
    };
    void evaluate(const DirectionPair& pair, std::span<double> result) const noexcept;

    Surface surface_;
    std::vector<Sample> samples_;
};

}  // namespace hts::spectral
