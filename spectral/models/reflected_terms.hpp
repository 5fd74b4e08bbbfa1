/// The terms of a reflectance at one pair of directions side by side, as tables and reports list them.
///
///     const ReflectedTerms terms = reflected_terms(reflectance, {in, out});
///     terms.directional_diffuse[i] + terms.uniform_diffuse[i]   // the BRDF at wavelength i, 1/sr
#pragma once

#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::spectral {

/// One value per wavelength of each.
struct ReflectedTerms {
    std::vector<double> directional_diffuse, uniform_diffuse;  ///< [1/sr]
    std::vector<double> specular_reflectance;  ///< [1], into the mirror direction of the light
};

/// Where the lobe is 0 the uniform-diffuse term is the BRDF, at most what Reflectance::uniform_diffuse says:
/// on the horizon all of it of a rough surface, nothing of other models.
[[nodiscard]] ReflectedTerms reflected_terms(const Reflectance& reflectance, const DirectionPair& pair);
/// The same into terms whose memory is used again.
void reflected_terms(const Reflectance& reflectance, const DirectionPair& pair, ReflectedTerms& terms);

}  // namespace hts::spectral
