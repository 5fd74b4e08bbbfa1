/// Spectra from values at a few wavelengths, for planned evaluators.
///
/// Between the nodes runs the cubic through the two on either side (of lower degree where there are fewer
/// than four nodes), in 1/lambda^2, of which both arguments of Phi are multiples.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "spectral/colour/colour.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

class SpectrumInterpolation {
  public:
    /// From `nodes` to `grid`; where both are the same, values are passed on as they are.
    SpectrumInterpolation(const WavelengthGrid& nodes, const WavelengthGrid& grid);

    [[nodiscard]] bool is_identity() const noexcept { return stencils_.empty(); }
    [[nodiscard]] std::size_t bytes() const noexcept { return stencils_.size() * sizeof(Stencil); }

    /// A spectrum on the grid; 0 where the cubic is negative. Not for the identity.
    void operator()(std::span<const double> at_nodes, std::span<double> spectrum) const noexcept;
    /// Weights of the nodes that do to their values what `weights` do to the spectrum (before
    /// negative values become 0).
    [[nodiscard]] std::vector<Xyz> folded(std::span<const Xyz> weights) const;

  private:
    /// Where one wavelength of the grid gets its value from.
    struct Stencil {
        std::size_t first;
        std::array<double, 4> weights;
    };

    std::size_t nodes_, width_;
    std::vector<Stencil> stencils_;  // none for the identity
};

}  // namespace hts::spectral
