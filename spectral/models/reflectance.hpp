/// Spectral BRDF, specular reflectance and polarised reflection of a reflector over a wavelength grid.
///
/// Conventions of directions in hts/direction.hpp, of Stokes vectors in hts/polarisation.hpp. What does not
/// depend on wavelength is computed once per direction pair; spectra come in the grid's order.
#pragma once

#include <span>
#include <vector>

#include "hts/he_torrance.hpp"
#include "hts/he_torrance_spectrum.hpp"
#include "hts/tolerance.hpp"
#include "spectral/models/reflector.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

using hts::DirectionPair;

/// What a reflector is at each wavelength of a grid. Throws hts::Error if the grid leaves the range of the optical
/// constants or albedo and `policy` is error.
[[nodiscard]] std::vector<SpectralSample> spectral_samples(const Reflector& reflector,
                                                           const WavelengthGrid& wavelengths,
                                                           OutsideRange policy = OutsideRange::error);

/// A reflector with its optical constants looked up on a wavelength grid, ready for evaluation at a tolerance.
///
///     const SpectralReflectance reflectance{reflector, grid, OutsideRange::error, Tolerance{1e-6}};
///     std::vector<double> spectrum(reflectance.size());
///     reflectance.brdf({in, out}, spectrum);  // allocates nothing
///
/// The tolerance concerns brdf, mueller and specular_reflectance; the other terms keep the accuracy of he_torrance.hpp.
class SpectralReflectance {
  public:
    /// Throws hts::Error if the grid leaves the range of the optical constants or albedo and `policy` is
    /// error.
    ///   tolerance   relative error of brdf, mueller and specular_reflectance; from 1e-6 on vector lanes take over
    ///   lobe        of brdf, mueller and directional_diffuse: a limit where the surface needs no more
    SpectralReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                        OutsideRange policy = OutsideRange::error,
                        Tolerance tolerance = Tolerance{hts::accuracy::finest_tolerance},
                        DiffuseLobe lobe = DiffuseLobe::full);

    /// Number of wavelengths.
    [[nodiscard]] std::size_t size() const noexcept { return prepared_.samples().size(); }
    [[nodiscard]] Tolerance tolerance() const noexcept { return prepared_.tolerance(); }
    /// Memory of this object alone; the table of Phi, hts::phi_table_bytes(tolerance()), is shared by all.
    [[nodiscard]] std::size_t bytes() const noexcept { return prepared_.bytes(); }

    /// What evaluates brdf and mueller, for calls on the caller's own threads.
    [[nodiscard]] const PreparedReflectance& prepared() const noexcept { return prepared_; }

    /// BRDF of the directional and uniform diffuse terms together [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same into `result` of size() values, else hts::Error; allocates nothing.
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// The same for many pairs, into `result` of pairs.size() * size() values, all wavelengths of a pair
    /// together. Runs on all cores; the same bits for any number of threads.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;

    /// Directional-diffuse term with its parts, one per wavelength.
    [[nodiscard]] std::vector<DirectionalDiffuse> directional_diffuse(const DirectionPair& pair) const;
    /// Uniform-diffuse BRDF [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> uniform_diffuse() const;
    /// Reflectance into the mirror direction, one per wavelength.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;
    /// The same [1] into `result` of size() values, else hts::Error; allocates nothing.
    void specular_reflectance(const Direction& in, std::span<double> result) const;

    /// Mueller matrix of both diffuse terms [1/sr], one per wavelength.
    [[nodiscard]] std::vector<Mueller> mueller(const DirectionPair& pair) const;
    /// The same into `result` of size() matrices, else hts::Error; allocates nothing.
    void mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    /// Mueller matrix of the specular term [1], one per wavelength.
    [[nodiscard]] std::vector<Mueller> specular_mueller(const Direction& in) const;

  private:
    PreparedReflectance prepared_;
};

}  // namespace hts::spectral
