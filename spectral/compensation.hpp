/// Optional energy compensation: a He-Torrance surface whose facets lose nothing then reflects everything.
///
/// NOT part of the published model, and off unless asked for. The model's lobes together reflect between 0.006 and
/// 1.05 of the light where |F|^2 = 1 (`hts furnace`), since what is shadowed or meets a second facet is lost. Here the
/// specular and the directional-diffuse term are multiplied by a factor of each direction,
///
///   f' = s(in) s(out) f,    rho_s' = s(in)^2 rho_s,
///   s(in) [ s(in) exp(-g) S + integral of lobe(in, out) s(out) cos(theta_r) domega ] = 1  for all in,
///
/// (Sinkhorn's scaling of a symmetric kernel), which keeps reciprocity and cannot become negative. The usual additive
/// term (1 - E(in))(1 - E(out))/(pi (1 - E_mean)) of microfacet models can: E passes 1 here.
///
/// What it does besides:
///   * Real facets absorb |F|^2 < 1 once, so the light it returns has the colour of a single reflection; light that
///     truly met n facets would have |F|^(2n): coloured metals come out too bright and too little saturated.
///   * The light stays in the shape of the lobe; multiple scattering would spread it.
///   * Where sigma_0 << lambda, s = 1/S undoes the shadowing of the mirror term: grazing incidence gives a mirror.
///   * The uniform-diffuse term stays as it is, so rho_dh <= 1 needs the same care with a(lambda).
///   * s grows towards the horizon. Beyond 89.9 degrees it is kept, and energy is lost again.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spectral/energy.hpp"
#include "spectral/reflectance.hpp"

namespace hts::spectral {

namespace accuracy {
/// Of rho_dh of a lossless surface from 1, for incidence up to 85 degrees, sigma_0/tau 0.005 ... 1 and sigma_0/lambda
/// 0.01 ... 5.
inline constexpr double compensated_energy = 4e-4;
}  // namespace accuracy

/// The factor s of one surface at one wavelength, tabulated over theta.
class EnergyCompensation {
  public:
    /// Solves for s.
    ///   cost   some 50 ms; 1 kB
    EnergyCompensation(const Surface& surface, const Wavelength& wavelength);

    /// s(theta), continuous and positive.
    ///   cost   about 20 ns
    [[nodiscard]] double factor(const Direction& direction) const noexcept;

  private:
    std::vector<double> factors_;
};

/// A SpectralReflectance with its energy compensated; same conventions, sizes and errors.
///
///     const CompensatedReflectance lossless{reflector, grid};
///     lossless.brdf({in, out}, spectrum);
class CompensatedReflectance {
  public:
    CompensatedReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                           OutsideRange policy = OutsideRange::error,
                           Tolerance tolerance = Tolerance{hts::accuracy::finest_tolerance});

    /// The reflectance without compensation.
    [[nodiscard]] const SpectralReflectance& model() const noexcept { return model_; }
    /// Number of wavelengths.
    [[nodiscard]] std::size_t size() const noexcept { return model_.size(); }

    /// BRDF of both diffuse terms [1/sr], one value per wavelength.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same into `result` of size() values, else hts::Error; allocates nothing.
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// Mueller matrix of both diffuse terms [1/sr] into `result` of size() matrices, else hts::Error.
    void mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    /// Reflectance into the mirror direction, one per wavelength.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;

  private:
    /// s(in) s(out).
    [[nodiscard]] double factor(std::size_t wavelength, const DirectionPair& pair) const noexcept;

    SpectralReflectance model_;
    std::vector<EnergyCompensation> compensation_;
    std::vector<double> uniform_diffuse_;
};

/// rho_dh with compensation, of a surface without uniform diffuse term.
///   error   of the specular and directional-diffuse terms as without; the factors are those of `compensation`
[[nodiscard]] HemisphericalReflectance directional_hemispherical_reflectance(
    const EnergyCompensation& compensation, const Surface& surface, const Facets& facets,
    const Wavelength& wavelength, const Direction& in) noexcept;

}  // namespace hts::spectral
