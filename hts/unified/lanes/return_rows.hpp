// The return factor m of all azimuths, as the lanes take it. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "hts/unified/lanes/unified_simd.hpp"

namespace hts::unified_detail {

/// A sum of Chebyshev polynomials of x in powers of x.
template <std::size_t size>
std::array<double, size> in_powers(const std::array<double, size>& chebyshev) {
    std::array<double, size> sum{}, before{}, now{1};
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t i = 0; i < size; ++i) sum[i] += chebyshev[j] * now[i];
        std::array<double, size> next{};
        for (std::size_t i = 0; i + 1 < size; ++i) next[i + 1] = (j == 0 ? 1 : 2) * now[i];
        for (std::size_t i = 0; i < size; ++i) next[i] -= before[i];
        before = now;
        now = next;
    }
    return sum;
}

using ReturnRow = std::array<double, ReturnFactor::terms>;

/// The factor m of all azimuths for the lanes: see SurfaceTerms.
struct ReturnRows {
    std::vector<ReturnRow> rows;
    double centre = 0, scale = 0;
};

/// By Chebyshev's interpolation between the least and the greatest width, the terms left
/// out that count for nothing.
///   widths   slope widths along the axes
inline ReturnRows return_rows(std::span<const double> widths) {
    constexpr std::size_t nodes = 32;
    constexpr double nothing = 1e-10;
    const double least = std::min(*std::ranges::min_element(widths), 2.0);
    const double most = std::min(*std::ranges::max_element(widths), 2.0);
    ReturnRows result{std::vector<ReturnRow>(nodes), (least + most) / 2,
                      most > least ? 2 / (most - least) : 0};
    for (std::size_t k = 0; k < nodes; ++k) {
        const double turn = std::numbers::pi * (static_cast<double>(k) + 0.5) / nodes;
        const ReturnFactor m{(result.centre + (most - least) / 2 * std::cos(turn)) / 2};
        for (std::size_t i = 0; i < nodes; ++i) {
            const double weight = (i == 0 ? 1.0 : 2.0) / nodes * std::cos(static_cast<double>(i) * turn);
            for (std::size_t j = 0; j < ReturnFactor::terms; ++j)
                result.rows[i][j] += weight * m.coefficients()[j];
        }
    }
    const auto size = [](const ReturnRow& row) {
        double sum = 0;
        for (const double c : row) sum += std::abs(c);
        return sum;
    };
    while (result.rows.size() > 1 && size(result.rows.back()) < nothing) result.rows.pop_back();
    for (ReturnRow& row : result.rows) row = in_powers(row);
    return result;
}

/// The factor m of all azimuths, of surfaces of two correlation lengths.
///   widths   slope widths along the axes, at all wavelengths
inline void set_return_rows(SurfaceTerms& surface, std::span<const double> widths) {
    if (surface.axes.isotropic) return;
    ReturnRows made = return_rows(widths);
    surface.return_rows = std::move(made.rows);
    surface.return_centre = made.centre;
    surface.return_scale = made.scale;
}

}  // namespace hts::unified_detail
