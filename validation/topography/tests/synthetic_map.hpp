/// Height maps of known roughness: pieces of periodic Gaussian surfaces four times their area.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "hts/sampling/random.hpp"
#include "validation/topography/map_spectrum.hpp"
#include "validation/topography/maps/height_map.hpp"
#include "validation/topography/plane_transform.hpp"
#include "validation/topography/roughness_model.hpp"

namespace hts::validation {

/// A surface of Gaussian heights whose covariances at the samples are those of its description, by circulant
/// embedding; what of the correlation does not fit the period is left out.
class SyntheticSurface {
  public:
    ///   side   points along each side of a map
    SyntheticSurface(double rms, const RoughnessScales& scales, const Ellipse& ellipse, double step,
                     std::size_t side)
        : side_{side}, period_{2 * side}, step_{step}, amplitudes_(period_ * period_) {
        for (std::size_t j = 0; j < period_; ++j) {
            for (std::size_t i = 0; i < period_; ++i) {
                const double x = step * signed_frequency(i, period_),
                             y = -step * signed_frequency(j, period_);
                amplitudes_[j * period_ + i] = rms * rms * correlation(scales, ellipse.distance(x, y));
            }
        }
        transform_forward(amplitudes_, period_, period_);
        for (auto& a : amplitudes_)
            a = std::sqrt(std::max(a.real(), 0.0) * static_cast<double>(amplitudes_.size()));
    }

    /// Two independent maps.
    [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> draw(std::uint64_t seed) const {
        Random random{seed};
        ComplexField field = amplitudes_;
        for (auto& a : field) a *= normal_pair(random);
        transform_inverse(field, period_, period_);
        std::pair<std::vector<double>, std::vector<double>> result;
        for (std::size_t j = 0; j < side_; ++j) {
            for (std::size_t i = 0; i < side_; ++i) {
                result.first.push_back(field[j * period_ + i].real());
                result.second.push_back(field[j * period_ + i].imag());
            }
        }
        return result;
    }
    [[nodiscard]] HeightMap map(std::vector<double> heights) const {
        return {"synthetic", side_, side_, step_, step_, std::move(heights)};
    }
    [[nodiscard]] std::size_t side() const noexcept { return side_; }
    [[nodiscard]] double step() const noexcept { return step_; }

    /// Two independent numbers of variance 1.
    [[nodiscard]] static std::complex<double> normal_pair(Random& random) {
        const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
        return std::polar(radius, 2 * std::numbers::pi * random.uniform());
    }

  private:
    std::size_t side_, period_;
    double step_;
    ComplexField amplitudes_;
};

}  // namespace hts::validation
