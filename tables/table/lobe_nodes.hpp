/// From exact values at nodes to the coefficients of a lobe's spline. Private to the module.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tables/table/build_table.hpp"
#include "tables/table/table_coordinates.hpp"

namespace hts::tables {

/// grazing, ratio, turn.
using LobeNodes = std::array<std::size_t, 3>;

/// Whether the values of a table must be double: rounded to float, ln f of some 20 is off by 1e-6.
[[nodiscard]] constexpr bool needs_double(const TableRequest& request) noexcept {
    return request.tolerance < 1e-5;
}

/// Components of ln(f + floor) in the basis, at the nodes of one grazing angle.
[[nodiscard]] std::vector<double> slice_values(const spectral::Reflectance& exact,
                                               const TableSpacing& spacing, const LobeNodes& nodes,
                                               std::size_t slice, std::span<const double> floor,
                                               std::span<const double> basis);

/// The spline through all slices.
///   width   number of components
[[nodiscard]] std::vector<double> lobe_coefficients(const std::vector<std::vector<double>>& slices,
                                                    const LobeNodes& nodes, std::size_t width);

/// Orthonormal spectra, of which every given one is a sum. The one that is represented worst joins them,
/// until none is off by more than `error`.
///   spectra, weights   wavelengths side by side; the error is weight times difference
///   wavelengths        their number
[[nodiscard]] std::vector<double> spectral_basis(std::vector<double> spectra,
                                                 const std::vector<double>& weights, std::size_t wavelengths,
                                                 double error);

}  // namespace hts::tables
