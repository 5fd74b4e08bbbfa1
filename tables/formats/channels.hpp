/// Few channels in place of a spectrum, for file formats that hold no more: linear sRGB, or luminance alone.
///
/// Such a channel is no wavelength, but spectral::Reflectance needs one to name it by: 0.46, 0.55 and 0.62 um
/// stand for blue, green and red, 0.55 um for luminance, as everywhere in this project.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spectral/colour/colour.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Wavelengths that name blue, green and red: 0.46, 0.55, 0.62 um.
[[nodiscard]] const spectral::WavelengthGrid& rgb_wavelengths();
/// What those wavelengths stand for in files that hold colours: B, G, R, or Z, Y, X; of luminance alone Y.
[[nodiscard]] const std::vector<std::string>& rgb_channels();
[[nodiscard]] const std::vector<std::string>& xyz_channels();
[[nodiscard]] const std::vector<std::string>& luminance_channel();
/// The wavelength that names luminance: 0.55 um.
[[nodiscard]] const spectral::WavelengthGrid& luminance_wavelength();

/// Most wavelengths that a spectrum may have where channels are made of it: 1024.
inline constexpr std::size_t most_channels = 1024;

/// Linear sRGB of a BRDF [1/sr] and of its specular reflectance [1], blue first; a perfect white has
/// 1/pi and 1 in all three.
///   formula   colour.hpp and display_colour.hpp; components below 0 (out of gamut) become 0
///   source    must cover the visible (else hts::Error, see tristimulus_weights)
[[nodiscard]] spectral::Reflectance linear_srgb_brdf(spectral::Reflectance source,
                                                     spectral::Illuminant illuminant);

/// BRDF as the eye weighs it, luminance factor over pi [1/sr], and the Y of the specular reflectance [1].
///   source    as above
[[nodiscard]] spectral::Reflectance luminance_brdf(spectral::Reflectance source,
                                                   spectral::Illuminant illuminant);

/// CIE Z, Y and X over pi [1/sr] of a BRDF, in this order, and of its specular reflectance [1].
///   source    as above
[[nodiscard]] spectral::Reflectance tristimulus_brdf(spectral::Reflectance source,
                                                     spectral::Illuminant illuminant);
/// The same of blue, green and red of linear sRGB under D65, and back; components below 0 become 0.
///   source    three channels, else hts::Error
[[nodiscard]] spectral::Reflectance tristimulus_of_srgb(spectral::Reflectance rgb);
[[nodiscard]] spectral::Reflectance srgb_of_tristimulus(spectral::Reflectance zyx);

/// u' and v' of CIE 1976 of Z, Y and X [1]; those of D65 where it is dark.
[[nodiscard]] spectral::Reflectance chromaticity_of_tristimulus(spectral::Reflectance zyx);
/// Z, Y and X of u', Y and v', in this order.
[[nodiscard]] spectral::Reflectance tristimulus_of_chromaticity(spectral::Reflectance uyv);

/// hts::Error unless there are three channels.
void require_three_channels(const spectral::Reflectance& brdf);

/// One wavelength of a BRDF.
///   index   < source.wavelengths().size(), else hts::Error
[[nodiscard]] spectral::Reflectance brdf_at(spectral::Reflectance source, std::size_t index);

/// The same values under other names.
///   names   as many as the source has wavelengths, else hts::Error
[[nodiscard]] spectral::Reflectance with_channels_named(spectral::Reflectance source,
                                                        const spectral::WavelengthGrid& names);

/// BRDFs of one wavelength each as one of them all.
///   parts   in the order of increasing wavelength, at most most_channels, else hts::Error
[[nodiscard]] spectral::Reflectance joined(const std::string& name, std::vector<spectral::Reflectance> parts);

}  // namespace hts::tables
