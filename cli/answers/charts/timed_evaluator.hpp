/// What the charts of models time: an evaluation of a pair of directions at four wavelengths.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "spectral/models/reflectance.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::cli {

/// Writes the BRDF of a pair at the charts' wavelengths.
using Evaluator = std::function<void(const DirectionPair& pair, std::span<double> values)>;

inline constexpr std::size_t chart_channels = 4;
/// 0.46, 0.54, 0.62 and 0.70 um.
[[nodiscard]] const spectral::WavelengthGrid& chart_wavelengths();

[[nodiscard]] Evaluator evaluator_of(spectral::Reflectance reflectance);

/// Median over passes of the processor time of a pair [ns].
[[nodiscard]] double nanoseconds(const Evaluator& evaluator, std::span<const DirectionPair> pairs);

}  // namespace hts::cli
