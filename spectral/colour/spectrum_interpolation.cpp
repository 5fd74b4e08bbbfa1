#include "spectral/colour/spectrum_interpolation.hpp"

#include <algorithm>

namespace hts::spectral {
namespace {

double abscissa(double um) {
    return 1 / (um * um);
}

}  // namespace

SpectrumInterpolation::SpectrumInterpolation(const WavelengthGrid& nodes, const WavelengthGrid& grid)
    : nodes_{nodes.size()}, width_{std::min<std::size_t>(4, nodes.size())} {
    const auto from = nodes.micrometres();
    if (std::ranges::equal(from, grid.micrometres())) return;
    for (const double um : grid.micrometres()) {
        const auto above = static_cast<std::size_t>(std::ranges::upper_bound(from, um) - from.begin());
        const std::size_t half = width_ / 2;
        Stencil stencil{std::min(above < half ? 0 : above - half, nodes_ - width_), {}};
        for (std::size_t j = 0; j < width_; ++j) {  // Lagrange
            stencil.weights[j] = 1;
            const double own = abscissa(from[stencil.first + j]);
            for (std::size_t k = 0; k < width_; ++k) {
                const double other = abscissa(from[stencil.first + k]);
                if (k != j) stencil.weights[j] *= (abscissa(um) - other) / (own - other);
            }
        }
        stencils_.push_back(stencil);
    }
}

void SpectrumInterpolation::operator()(std::span<const double> at_nodes,
                                       std::span<double> spectrum) const noexcept {
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        const auto& [first, weights] = stencils_[i];
        double sum = weights[0] * at_nodes[first];
        if (width_ == 4) {  // as a rule; spelled out, it takes half the time
            sum += weights[1] * at_nodes[first + 1] + weights[2] * at_nodes[first + 2] +
                   weights[3] * at_nodes[first + 3];
        } else {
            for (std::size_t j = 1; j < width_; ++j) sum += weights[j] * at_nodes[first + j];
        }
        spectrum[i] = std::max(0., sum);
    }
}

std::vector<Xyz> SpectrumInterpolation::folded(std::span<const Xyz> weights) const {
    if (is_identity()) return {weights.begin(), weights.end()};
    std::vector<Xyz> result(nodes_, Xyz{0, 0, 0});
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        for (std::size_t j = 0; j < width_; ++j) {
            Xyz& node = result[stencils_[i].first + j];
            node = node + stencils_[i].weights[j] * weights[i];
        }
    }
    return result;
}

}  // namespace hts::spectral
