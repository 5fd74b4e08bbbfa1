/// One part (n or k) of a refractive index against wavelength: constant, tabulated, or a dispersion formula.
#pragma once

#include <variant>
#include <vector>

#include "spectral/piecewise_linear.hpp"

namespace hts::spectral {

/// The dispersion formulas of the refractiveindex.info database (Polyanskiy, Sci. Data 11, 94, 2024),
/// wavelengths in um.
class DispersionFormula {
  public:
    ///   number         1 Sellmeier, 2 Sellmeier-2, 3 polynomial, 4 RefractiveIndex.INFO, 5 Cauchy, 6 gases,
    ///                  7 Herzberger, 8 retro, 9 exotic; else hts::Error
    ///   coefficients   C1, C2, … as in the database; missing ones are 0
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
    [[nodiscard]] WavelengthRange range() const noexcept { return {shortest_length, longest_length}; }
    [[nodiscard]] double operator()(double) const noexcept { return value; }
};

using Dispersion = std::variant<ConstantValue, PiecewiseLinear, DispersionFormula>;

}  // namespace hts::spectral
