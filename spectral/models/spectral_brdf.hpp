/// A reflectance at a list of wavelengths, wherever it comes from: what plans evaluate, what tables are built from, and what the
/// files of other programs are written from and read into.
///
/// Conventions of directions in hts/direction.hpp, of Stokes vectors and frames in hts/polarisation.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hts/direction.hpp"
#include "hts/he_torrance_spectrum.hpp"
#include "hts/polarisation.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/models/any_reflector.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

using hts::DirectionPair;

/// Immutable. Evaluation is total, allocates nothing and may run on any thread. On the horizon lobes are 0; the uniform-diffuse
/// term stays there of model he, and is 0 of others.
class SpectralBrdf {
  public:
    virtual ~SpectralBrdf() = default;

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const WavelengthGrid& wavelengths() const noexcept { return wavelengths_; }
    /// Memory of this object alone, not of tables that several share; 0 where not known.
    [[nodiscard]] virtual std::size_t bytes() const noexcept { return 0; }

    /// BRDF of all diffuse terms, unpolarised [1/sr], one value per wavelength, without the cosine.
    virtual void brdf(const DirectionPair& pair, std::span<double> values) const noexcept = 0;
    /// The same for many pairs, all wavelengths of a pair together, on the calling thread.
    ///   values   pairs.size() * wavelengths().size()
    virtual void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept;
    /// Its part that is the same for all directions above the horizon [1/sr], one value per wavelength; 0 where not known.
    virtual void uniform_diffuse(std::span<double> values) const noexcept;
    /// The rest, the lobe [1/sr]: without cancellation also where it is far smaller.
    virtual void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept;
    /// Reflectance into the mirror direction, the specular delta [1], one value per wavelength.
    virtual void specular_reflectance(const Direction& in, std::span<double> values) const noexcept = 0;
    /// Whether `mueller` and `specular_mueller` may be called.
    [[nodiscard]] virtual bool polarised() const noexcept { return false; }
    /// Mueller matrices of the diffuse terms [1/sr], one per wavelength; only where polarised().
    virtual void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept;
    /// Mueller matrices of the specular delta [1], one per wavelength; zeros where not known.
    virtual void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept;

  protected:
    SpectralBrdf(std::string name, WavelengthGrid wavelengths);
    SpectralBrdf(const SpectralBrdf&) = default;
    SpectralBrdf(SpectralBrdf&&) = default;
    SpectralBrdf& operator=(const SpectralBrdf&) = default;
    SpectralBrdf& operator=(SpectralBrdf&&) = default;

  private:
    std::string name_;
    WavelengthGrid wavelengths_;
};

/// The model of a material file at every wavelength of a grid; polarised for He-Torrance surfaces.
/// Throws hts::Error where the material is not known at one of them and `policy` is error.
///   tolerance   of the terms of He-Torrance surfaces, as in SpectralReflectance; other models are evaluated as they are
///   lobe        a limit where the surface needs no more; of other models full or none, else hts::Error
[[nodiscard]] std::unique_ptr<SpectralBrdf> model_brdf(
    const AnyReflector& reflector, const WavelengthGrid& wavelengths,
    OutsideRange policy = OutsideRange::error,
    Tolerance tolerance = Tolerance{hts::accuracy::finest_tolerance}, DiffuseLobe lobe = DiffuseLobe::full);

/// The same of a He-Torrance surface with its energy compensated, as spectral/energy/compensation.hpp says.
///   cost   some 50 ms a wavelength
[[nodiscard]] std::unique_ptr<SpectralBrdf> compensated_brdf(
    const Reflector& reflector, const WavelengthGrid& wavelengths, OutsideRange policy = OutsideRange::error,
    Tolerance tolerance = Tolerance{hts::accuracy::finest_tolerance});
/// The same with what was solved before.
///   compensation   one per wavelength of `model`, else hts::Error
[[nodiscard]] std::unique_ptr<SpectralBrdf> compensated_brdf(std::unique_ptr<SpectralBrdf> model,
                                                             std::vector<EnergyCompensation> compensation);

}  // namespace hts::spectral
