/// Means over a band of wavelengths: by the response of an instrument, by the radiation of
/// a black body, or by both.
///
///   mean   integral of v(lambda) w(lambda) dlambda over that of w(lambda) dlambda, over the wavelengths
///          given, v a straight line between them; w = R for a response R, w = B for a
///          temperature, w = R B for both
///   B      Planck's radiance per wavelength, in proportion to x^5/(exp(x) - 1), x = c_2/(lambda T), c_2 =
///          14387.76877 um K (CODATA 2018, exact)
/// The total emissivity at a temperature is the mean by B over all wavelengths; `covered` says how far
/// the given ones are that.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "spectral/materials/piecewise_linear.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

namespace accuracy {
inline constexpr double band_weight = 1e-10;  ///< of each weight, beside the largest
}  // namespace accuracy

/// x^5/(exp(x) - 1), x = c_2/(lambda T): the radiance of a black body per wavelength, but for a
/// factor (T/c_2)^5 2 h c^2.
///   um       wavelength [um] > 0        kelvin   temperature [K] > 0
[[nodiscard]] double planck_shape(double um, double kelvin) noexcept;

class Band {
  public:
    static constexpr double coldest = 1, hottest = 1e6;  ///< [K]

    ///   response      of an instrument, in any unit, >= 0 and somewhere > 0; 0 outside its table
    ///   temperature   [K]  coldest ... hottest
    /// hts::Error where one of both is out of range, or where none is given.
    Band(std::optional<PiecewiseLinear> response, std::optional<double> temperature);

    /// Factors of the values at each wavelength, of which the mean is the sum. hts::Error for a single
    /// wavelength, and where w vanishes at all of them.
    ///   error   accuracy::band_weight
    [[nodiscard]] std::vector<double> weights(const WavelengthGrid& wavelengths) const;
    /// Share of the whole integral of w that lies between the first and the last wavelength, 0 ... 1.
    [[nodiscard]] double covered(const WavelengthGrid& wavelengths) const;

  private:
    [[nodiscard]] double weight(double um) const noexcept;
    [[nodiscard]] std::vector<double> pieces(double first, double last) const;
    [[nodiscard]] double integral(double first, double last) const;

    std::optional<PiecewiseLinear> response_;
    std::optional<double> temperature_;
};

/// Reads a response from a CSV with the columns wavelength_um and response, in any order, and no others.
[[nodiscard]] PiecewiseLinear read_response(const std::filesystem::path& path);

}  // namespace hts::spectral
