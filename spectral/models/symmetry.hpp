/// Which symmetries a reflectance has, as random directions tell.
#pragma once

#include <cstddef>

#include "spectral/models/evaluator.hpp"

namespace hts::spectral {

namespace accuracy {
inline constexpr double isotropy = 1e-6;  ///< an anisotropy below this is rounding and interpolation
}

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when both directions turn
/// together about the normal: 0 to rounding for isotropic surfaces.
[[nodiscard]] double anisotropy(const Evaluator& brdf, std::size_t pairs = 256);

/// Isotropic as far as `anisotropy` can tell.
[[nodiscard]] bool is_isotropic(const Evaluator& brdf);

/// Largest relative change of the BRDF, over random pairs and all wavelengths, when the
/// directions change places.
[[nodiscard]] double irreciprocity(const Evaluator& brdf);

}  // namespace hts::spectral
