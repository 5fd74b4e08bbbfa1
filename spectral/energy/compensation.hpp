/// Optional energy compensation: a rough surface whose facets lose nothing then reflects everything.
///
/// NOT part of the published model, and off unless asked for. The model's lobes together reflect between
/// 0.006 and 1.05 of the light where |F|^2 = 1 (`hts furnace`), since what is shadowed or meets a second
/// facet is lost. Here the specular and the directional-diffuse term are multiplied by a
/// factor of each direction,
///
///   f' = s(in) s(out) f,    rho_s' = s(in)^2 rho_s,
///   s(in) [ s(in) exp(-g) S + integral of lobe(in, out) s(out) cos(theta_r) domega ] = 1  for all in,
///
/// (Sinkhorn's scaling of a symmetric kernel), which keeps reciprocity and cannot become negative. The usual
/// additive term (1 - E(in))(1 - E(out))/(pi (1 - E_mean)) of microfacet models can: E passes 1 here.
///
/// What it does besides:
///   * Real facets absorb |F|^2 < 1 once, so the light it returns has the colour of a single reflection;
///     light that truly met n facets would have |F|^(2n): coloured metals come out too bright
///     and too little saturated.
///   * The light stays in the shape of the lobe; multiple scattering would spread it.
///   * Where sigma_0 << lambda, s = 1/S undoes the shadowing of the specular term: grazing
///     incidence gives a mirror.
///   * The uniform-diffuse term stays as it is, so rho_dh <= 1 needs the same care with a(lambda).
///   * Of he_unified, whose mirror is not shadowed and whose lobe already returns what is reflected more than
///     once, little is left to do for real materials; of a perfect conductor it repairs p at the horizon.
///   * s grows towards the horizon. Beyond 89.9 degrees it is kept, and energy is lost again.
///
/// Material::at evaluates f' where its options say so; Mueller matrices are scaled like their element 00.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

namespace accuracy {
/// Of rho_dh of a lossless surface from 1, for incidence up to 85 degrees, sigma_0/tau 0.005 ... 1 and
/// sigma_0/lambda 0.01 ... 5.
inline constexpr double compensated_energy = 4e-4;
}  // namespace accuracy

/// Where a direction stands in every table of s, found once for all wavelengths: a value there is the
/// weighted sum of those at four nodes, by cubic interpolation.
///   cost   about 20 ns
struct CompensationPlace {
    explicit CompensationPlace(const Direction& direction) noexcept;
    std::array<std::size_t, 4> nodes;
    std::array<double, 4> weights;
};

/// The places of a light and a view.
struct CompensationPair {
    explicit CompensationPair(const DirectionPair& pair) noexcept : in{pair.in}, out{pair.out} {}
    CompensationPlace in, out;
};

/// The factor s of one surface at one wavelength, tabulated over theta.
class EnergyCompensation {
  public:
    /// Solves for s.
    ///   surface   isotropic, else hts::Error: s is a function of theta alone
    ///   cost      some 50 ms; 1 kB
    EnergyCompensation(const RoughSurface& surface, const Wavelength& wavelength);
    /// The same for every wavelength of a grid, on all cores.
    [[nodiscard]] static std::vector<EnergyCompensation> of(const RoughSurface& surface,
                                                            const WavelengthGrid& wavelengths);
    /// From one grid to another, as planned spectra are interpolated: the cubic in 1/lambda^2.
    ///   all   one per wavelength of `from`, of one surface
    [[nodiscard]] static std::vector<EnergyCompensation> interpolated(
        const std::vector<EnergyCompensation>& all, const WavelengthGrid& from, const WavelengthGrid& to);

    /// s(theta), continuous and positive.
    [[nodiscard]] double factor(const Direction& direction) const noexcept {
        return factor(CompensationPlace{direction});
    }
    [[nodiscard]] double factor(const CompensationPlace& place) const noexcept {
        double sum = 0;
        for (std::size_t i = 0; i < place.weights.size(); ++i)
            sum += place.weights[i] * factors_[place.nodes[i]];
        return sum;
    }
    /// s(in) s(out).
    [[nodiscard]] double factor(const CompensationPair& pair) const noexcept {
        return factor(pair.in) * factor(pair.out);
    }
    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof *this + factors_.size() * sizeof(double);
    }

  private:
    explicit EnergyCompensation(std::vector<double> factors) : factors_{std::move(factors)} {}

    std::vector<double> factors_;
};

/// rho_dh with compensation, of a surface without uniform diffuse term.
///   error   of the specular and directional-diffuse terms as without; the factors
///           are those of `compensation`
[[nodiscard]] HemisphericalReflectance directional_hemispherical_reflectance(
    const EnergyCompensation& compensation, const RoughSurface& surface, const Facets& facets,
    const Wavelength& wavelength, const Direction& in) noexcept;

}  // namespace hts::spectral
