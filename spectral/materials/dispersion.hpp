/// One part (n or k) of a refractive index against wavelength: constant, tabulated, or a dispersion formula.
#pragma once

#include <variant>
#include <vector>

#include "spectral/materials/piecewise_linear.hpp"

namespace hts::spectral {

namespace accuracy {
/// Of a formula's n, relative, where the material is transparent; more near a resonance.
inline constexpr double dispersion = 1e-15;
}  // namespace accuracy

/// The dispersion formulas of the refractiveindex.info database (Polyanskiy, Sci. Data 11, 94, 2024),
/// wavelengths in um.
class DispersionFormula {
  public:
    ///   number         1 Sellmeier, 2 Sellmeier-2, 3 polynomial, 4 RefractiveIndex.INFO, 5 Cauchy, 6 gases,
    ///                  7 Herzberger, 8 retro, 9 exotic; else hts::Error
    ///   coefficients   C1, C2, … as in the database, finite; whole terms at the end may be left out, but no
    ///                  part of a term. Formulas 1, 2, 3, 5, 6 are sums over any number of pairs; 4, 7, 8, 9
    ///                  take at most 17, 6, 4, 6, else hts::Error
    ///   range          where the formula was fitted; wavelengths, the shorter first, else hts::Error
    /// A term whose leading coefficient is 0 is absent, whatever its other coefficients.
    DispersionFormula(int number, std::vector<double> coefficients, WavelengthRange range);

    [[nodiscard]] WavelengthRange range() const noexcept { return range_; }
    /// n at a wavelength [um] inside the range; NaN where the formula has no real value.
    [[nodiscard]] double operator()(double um) const noexcept;

  private:
    int number_;
    std::vector<double> coefficients_;
    WavelengthRange range_;
};

/// The same value at every wavelength.
struct ConstantValue {
    double value;
    [[nodiscard]] static WavelengthRange range() noexcept { return {shortest_length, longest_length}; }
    [[nodiscard]] double operator()(double) const noexcept { return value; }
};

using Dispersion = std::variant<ConstantValue, PiecewiseLinear, DispersionFormula>;

/// Where a curve is known.
[[nodiscard]] WavelengthRange range_of(const Dispersion& dispersion) noexcept;
/// Its value at a wavelength [um] inside that range.
[[nodiscard]] double value_at(const Dispersion& dispersion, double um) noexcept;

}  // namespace hts::spectral
