/// Descriptions of rough surfaces by a few numbers: sums of scales, each Gaussian or of K-correlation.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "validation/fit/least_squares.hpp"

namespace hts::validation {

/// A part of the height variance with an autocorrelation of its own.
///   Gaussian        C = exp(-(r/length)^2)
///   K-correlation   C = 2^(1 - nu)/Gamma(nu) x^nu K_nu(x), x = r/length; exponential where nu is 1/2
struct RoughnessScale {
    double weight;  ///< of the variance; those of a surface add up to 1
    double length;  ///< [um]
    double nu;      ///< > 0; infinity stands for the Gaussian
};
using RoughnessScales = std::vector<RoughnessScale>;

/// C(r), r >= 0 [um].
[[nodiscard]] double correlation(const RoughnessScales& scales, double r);
/// S2(f) of unit variance [um^2].
[[nodiscard]] double spectrum(const RoughnessScales& scales, double f);
/// Its integral over frequencies below f, 0 … 1.
[[nodiscard]] double share_below(const RoughnessScales& scales, double f);

/// A number of a description as people give it.
struct RoughnessValue {
    std::string name;  ///< with its unit: "correlation_length_um"
    double value;
};

/// A description with its coordinates, in which a fit moves.
struct RoughnessModel {
    std::string_view name;   ///< "gaussian", "exponential", "k_correlation", "two_scales"
    std::string_view title;  ///< "Gaussian"
    std::size_t lengths;     ///< how many coordinates, the first ones, are logarithms of lengths
    std::vector<std::vector<double>> (*starts)(double length);  ///< length: where C is about 1/e
    std::vector<Bounds> (*bounds)(double shortest, double longest);
    RoughnessScales (*scales)(std::span<const double> coordinates);
    std::vector<RoughnessValue> (*values)(const RoughnessScales& scales);
};

/// In the order of their number of coordinates.
[[nodiscard]] std::span<const RoughnessModel> roughness_models() noexcept;

}  // namespace hts::validation
