#include "tables/table/lobe_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spectral/parallel.hpp"
#include "tables/table/spline.hpp"
#include "tables/table/table_lobe.hpp"

namespace hts::tables {
namespace {

double place(std::size_t node, std::size_t nodes) {
    return static_cast<double>(node) / static_cast<double>(nodes - 1);
}

}  // namespace

std::vector<double> slice_values(const spectral::Reflectance& exact, const TableSpacing& spacing,
                                 const LobeNodes& nodes, std::size_t slice, std::span<const double> floor,
                                 std::span<const double> basis) {
    const CoordinateMap map{spacing};
    std::vector<double> lobe(floor.size()), values;
    values.reserve(nodes[1] * nodes[2] * (basis.size() / floor.size()));
    for (std::size_t j = 0; j < nodes[1]; ++j) {
        for (std::size_t k = 0; k < nodes[2]; ++k) {
            exact.directional_diffuse(
                map.pair({place(slice, nodes[0]), place(j, nodes[1]), place(k, nodes[2])}), lobe);
            for (std::size_t w = 0; w < floor.size(); ++w)
                lobe[w] = std::log(std::max(0.0, lobe[w]) + floor[w]);
            for (std::size_t from = 0; from < basis.size(); from += floor.size()) {
                values.push_back(std::inner_product(lobe.begin(), lobe.end(),
                                                    basis.begin() + static_cast<std::ptrdiff_t>(from), 0.0));
            }
        }
    }
    return values;
}

std::vector<double> lobe_coefficients(const std::vector<std::vector<double>>& slices, const LobeNodes& nodes,
                                      std::size_t width) {
    const std::size_t row = (nodes[2] + spline_ghosts) * width, plane = (nodes[1] + spline_ghosts) * row;
    std::vector<double> block((nodes[0] + spline_ghosts) * plane);
    spectral::parallel_for(nodes[0], [&](std::size_t i) {
        const std::span<double> own = std::span{block}.subspan((i + 1) * plane, plane);
        for (std::size_t j = 0; j < nodes[1]; ++j) {
            std::copy_n(slices[i].begin() + static_cast<std::ptrdiff_t>(j * nodes[2] * width),
                        nodes[2] * width, own.begin() + static_cast<std::ptrdiff_t>((j + 1) * row + width));
        }
        to_spline_coefficients(own.subspan(row, nodes[1] * row), nodes[2], width, SplineStart::even);
        to_spline_coefficients(own, nodes[1], row, SplineStart::free);
    });
    to_spline_coefficients(block, nodes[0], plane, SplineStart::even);
    return block;
}

std::vector<double> spectral_basis(std::vector<double> spectra, const std::vector<double>& weights,
                                   std::size_t wavelengths, double error) {
    constexpr double rounding = 1e-11;  // what is left of spectra that are sums of those taken
    double longest = 0;
    std::vector<double> basis;
    // What is left of each spectrum once its components are taken out.
    const auto rest = [&](std::size_t i) { return std::span{spectra}.subspan(i * wavelengths, wavelengths); };
    const std::size_t count = spectra.size() / wavelengths;
    while (basis.size() < wavelengths * wavelengths) {
        std::size_t worst = 0;
        double worst_error = -1;
        for (std::size_t i = 0; i < spectra.size(); ++i) {
            const double own = std::abs(spectra[i]) * weights[i];
            if (own <= worst_error) continue;
            worst_error = own;
            worst = i / wavelengths;
        }
        const bool whole_lanes = basis.size() % (component_lanes * wavelengths) == 0;
        if (!basis.empty() && whole_lanes && worst_error <= error) break;
        std::vector<double> next{rest(worst).begin(), rest(worst).end()};
        const double length = std::sqrt(std::inner_product(next.begin(), next.end(), next.begin(), 0.0));
        longest = std::max(longest, length);
        if (!(length > rounding * longest)) break;
        for (double& value : next) value /= length;
        for (std::size_t i = 0; i < count; ++i) {
            const double component = std::inner_product(next.begin(), next.end(), rest(i).begin(), 0.0);
            for (std::size_t w = 0; w < wavelengths; ++w) rest(i)[w] -= component * next[w];
        }
        basis.insert(basis.end(), next.begin(), next.end());
    }
    return basis;
}

}  // namespace hts::tables
