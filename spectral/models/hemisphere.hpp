/// What a reflectance of any model reflects of light from the whole hemisphere.
#pragma once

#include "spectral/models/reflectance.hpp"

namespace hts::spectral {

/// Share of uniform incident light that is reflected at one of the wavelengths, by term: 2 times the integral
/// of the directional-hemispherical reflectance times cos theta d(cos theta). By Kirchhoff's law 1 less the
/// total is the hemispherical emissivity of a surface that lets no light through.
/// Anisotropic reflectances by the mean over azimuths.
///   error    accuracy::bihemispherical_reflectance of each term, absolute, or that of Reflectance::albedo
///   cost     some 30 of Reflectance::albedo, of anisotropic reflectances some 1000
[[nodiscard]] HemisphericalReflectance bihemispherical_reflectance(const Reflectance& reflectance,
                                                                   std::size_t wavelength);

}  // namespace hts::spectral
