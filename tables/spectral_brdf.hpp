/// A reflectance at a list of wavelengths, wherever it comes from: what tables are built from, and what the files of other
/// programs are written from and read into.
///
/// Conventions of directions in hts/direction.hpp, of Stokes vectors and frames in hts/polarisation.hpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hts/direction.hpp"
#include "hts/evaluation.hpp"
#include "hts/polarisation.hpp"
#include "spectral/any_reflector.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::tables {

using hts::DirectionPair;

/// Immutable. Evaluation is total (0 below the horizon), allocates nothing and may run on any thread.
class SpectralBrdf {
  public:
    virtual ~SpectralBrdf() = default;

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const spectral::WavelengthGrid& wavelengths() const noexcept { return wavelengths_; }

    /// BRDF of all diffuse terms, unpolarised [1/sr], one value per wavelength, without the cosine.
    virtual void brdf(const DirectionPair& pair, std::span<double> values) const noexcept = 0;
    /// Its part that is the same for all directions above the horizon [1/sr], one value per wavelength; 0 where not known.
    virtual void uniform_diffuse(std::span<double> values) const noexcept;
    /// The rest, the lobe [1/sr]: without cancellation also where it is far smaller.
    virtual void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept;
    /// Reflectance into the mirror direction, the specular delta [1], one value per wavelength.
    virtual void specular_reflectance(const Direction& in, std::span<double> values) const noexcept = 0;
    /// Whether `mueller` may be called.
    [[nodiscard]] virtual bool polarised() const noexcept { return false; }
    /// Mueller matrices of the diffuse terms [1/sr], one per wavelength; only where polarised().
    virtual void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept;

  protected:
    SpectralBrdf(std::string name, spectral::WavelengthGrid wavelengths);
    SpectralBrdf(const SpectralBrdf&) = default;
    SpectralBrdf(SpectralBrdf&&) = default;
    SpectralBrdf& operator=(const SpectralBrdf&) = default;
    SpectralBrdf& operator=(SpectralBrdf&&) = default;

  private:
    std::string name_;
    spectral::WavelengthGrid wavelengths_;
};

/// The model of a material file at every wavelength of a grid; polarised for He-Torrance surfaces.
/// Throws hts::Error where the material is not known at one of them and `policy` is error.
///   tolerance   of the diffuse terms of He-Torrance surfaces, as in spectral::SpectralReflectance
[[nodiscard]] std::unique_ptr<SpectralBrdf> model_brdf(
    const spectral::AnyReflector& reflector, const spectral::WavelengthGrid& wavelengths,
    spectral::OutsideRange policy = spectral::OutsideRange::error,
    Tolerance tolerance = Tolerance{hts::accuracy::finest_tolerance});

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when both directions turn together about
/// the normal: 0 to rounding for isotropic surfaces.
[[nodiscard]] double anisotropy(const SpectralBrdf& brdf);

/// Isotropic as far as `anisotropy` can tell (1e-6).
[[nodiscard]] bool is_isotropic(const SpectralBrdf& brdf);

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when the directions change places.
[[nodiscard]] double irreciprocity(const SpectralBrdf& brdf);

}  // namespace hts::tables
