/// Values of a table between its wavelengths: ln f is linear in ln wavelength between neighbours, f
/// itself where one of them is 0.
///
/// The table's promise is for its own wavelengths. What is lost between them depends on the spectrum: `hts
/// table check` measures it half-way between neighbours, with table_error of `at_wavelengths`
/// against the exact model there.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Where a wavelength lies among others.
struct WavelengthPlace {
    std::size_t low, high;  ///< neighbours; the same at a wavelength of the grid
    double share;           ///< of the second

    [[nodiscard]] bool between() const noexcept { return low != high; }
    /// Of a spectrum over the grid.
    [[nodiscard]] double operator()(std::span<const double> values) const noexcept;
};

/// hts::Error that names the range for a wavelength outside it. Ends and nodes count with 1e-9 of slack.
[[nodiscard]] WavelengthPlace place_among(const spectral::WavelengthGrid& grid, double um);

/// Half-way between neighbours, in ln wavelength; none of one wavelength.
[[nodiscard]] std::optional<spectral::WavelengthGrid> half_way(const spectral::WavelengthGrid& grid);

/// The diffuse and specular terms of `table` at other wavelengths. hts::Error for one outside its range.
[[nodiscard]] spectral::Reflectance at_wavelengths(const spectral::Reflectance& table,
                                                   const spectral::WavelengthGrid& wavelengths);

}  // namespace hts::tables
