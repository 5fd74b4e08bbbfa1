/// The spline of a lobe at a place, for tables and for those who make them. Private to the module.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "tables/table/spline.hpp"
#include "tables/table/table_coordinates.hpp"

namespace hts::tables {

/// The 64 nodes about a place: where their first wavelengths stand, and their weights.
template <class Real>
struct LobePlace {
    std::array<std::size_t, 16> rows;  ///< of four neighbours in turn, in nodes
    std::array<Real, 64> weights;
};

template <class Real>
[[nodiscard]] LobePlace<Real> lobe_place(const Coordinates& at,
                                         const std::array<std::size_t, 3>& nodes) noexcept {
    const SplinePlace x = spline_place(at[0], nodes[0]), y = spline_place(at[1], nodes[1]),
                      z = spline_place(at[2], nodes[2]);
    LobePlace<Real> place;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const std::size_t row = 4 * i + j;
            place.rows[row] =
                ((x.first + i) * (nodes[1] + spline_ghosts) + y.first + j) * (nodes[2] + spline_ghosts) +
                z.first;
            for (std::size_t k = 0; k < 4; ++k) {
                place.weights[4 * row + k] = static_cast<Real>(x.weights[i] * y.weights[j] * z.weights[k]);
            }
        }
    }
    return place;
}

/// Components come in groups of so many.
inline constexpr std::size_t component_lanes = 4;
/// More than this no table has.
inline constexpr std::size_t most_components = 256;

/// Weighted sums of `width` neighbouring components from the given one on.
template <std::size_t width, class Real>
void component_sums(const Real* coefficients, std::size_t components, const LobePlace<Real>& place,
                    std::size_t from, Real* sums) noexcept {
    std::array<std::array<Real, width>, 4> sum{};  // of every fourth node, so that additions need not wait
    for (std::size_t row = 0; row < place.rows.size(); ++row) {
        const Real* const nodes = coefficients + place.rows[row] * components + from;
        for (std::size_t k = 0; k < 4; ++k) {
            const Real weight = place.weights[4 * row + k];
            for (std::size_t i = 0; i < width; ++i) sum[k][i] += weight * nodes[k * components + i];
        }
    }
    for (std::size_t i = 0; i < width; ++i)
        sums[from + i] = (sum[0][i] + sum[1][i]) + (sum[2][i] + sum[3][i]);
}

/// Spectra as sums of components of a basis.
template <class Real>
struct LobeSpline {
    const Real* basis;         ///< components after components
    const Real* coefficients;  ///< components side by side
    std::size_t components, wavelengths;

    /// Calls use(first, logarithms, width) for blocks that cover all wavelengths; blocks may overlap, with
    /// equal values where they do.
    template <class Use>
    void visit(const LobePlace<Real>& place, Use&& use) const noexcept {
        std::array<Real, most_components> sums;
        std::size_t from = 0;
        for (; from + 2 * component_lanes <= components; from += 2 * component_lanes) {
            component_sums<2 * component_lanes>(coefficients, components, place, from, sums.data());
        }
        for (; from + component_lanes <= components; from += component_lanes) {
            component_sums<component_lanes>(coefficients, components, place, from, sums.data());
        }
        for (; from < components; ++from)
            component_sums<1>(coefficients, components, place, from, sums.data());
        constexpr std::size_t width = 16;
        if (wavelengths < width) {
            for (std::size_t w = 0; w < wavelengths; ++w) spectrum<1>(sums, w, use);
        } else {
            for (std::size_t w = 0; w < wavelengths; w += width)
                spectrum<width>(sums, std::min(w, wavelengths - width), use);
        }
    }

  private:
    template <std::size_t width, class Use>
    void spectrum(const std::array<Real, most_components>& sums, std::size_t first,
                  Use&& use) const noexcept {
        std::array<Real, width> logarithms{};
        for (std::size_t k = 0; k < components; ++k) {
            const Real* const row = basis + k * wavelengths + first;
            for (std::size_t i = 0; i < width; ++i) logarithms[i] += sums[k] * row[i];
        }
        use(first, logarithms.data(), std::integral_constant<std::size_t, width>{});
    }
};

}  // namespace hts::tables
