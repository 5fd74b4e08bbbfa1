/// The reflectances that tables are built from (spectral/models/spectral_brdf.hpp), and what can be asked of one.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "spectral/models/spectral_brdf.hpp"

namespace hts::tables {

using hts::DirectionPair;
using spectral::model_brdf;
using spectral::SpectralBrdf;

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when both directions turn together about
/// the normal: 0 to rounding for isotropic surfaces.
[[nodiscard]] double anisotropy(const SpectralBrdf& brdf);

/// Isotropic as far as `anisotropy` can tell (1e-6).
[[nodiscard]] bool is_isotropic(const SpectralBrdf& brdf);

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when the directions change places.
[[nodiscard]] double irreciprocity(const SpectralBrdf& brdf);

}  // namespace hts::tables
