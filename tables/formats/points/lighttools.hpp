/// BSDF text of LightTools, also read by libbsdf: a grid of azimuths and polar angles about the normal, and a
/// block of values for each angle of incidence, side, wavelength and kind of scattering.
///
/// Reflection at the front is read; blocks of transmission and of the back are named and left out. The
/// light's azimuth is 90 deg in these files: azimuths of views count from there. Private to the formats.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tables/formats/points/scatter_points.hpp"

namespace hts::tables {

/// Whether a text begins like one.
[[nodiscard]] bool is_lighttools_file(std::string_view text);

/// The points of its blocks; tristimulus values as the channels Z, Y, X.
///   wavelengths   what the channels are called instead of what the blocks say
/// hts::Error "path:line: …" where it is no such file, lacks reflection at the front, or has a block twice.
[[nodiscard]] ScatterPoints points_of_lighttools(std::string_view text, const std::string& name,
                                                 const std::optional<spectral::WavelengthGrid>& wavelengths);

/// A block of reflection at the front for each angle of incidence and wavelength.
///   grid   axis normal
/// hts::Error for surfaces with a grain, whose azimuths of light no description of the format explains.
[[nodiscard]] std::string lighttools_text(const spectral::Reflectance& brdf, AngularGrid grid);

}  // namespace hts::tables
