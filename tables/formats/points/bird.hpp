/// BiRD, the JSON of metrologists for bidirectional reflectance data, schema 1.0: an object of variables,
/// each a list as long as there are points, and metadata.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tables/formats/points/scatter_points.hpp"

namespace hts::tables {

[[nodiscard]] bool is_bird_file(std::string_view text);

/// Whether it has a variable "wavelength", "wavelength_i" or "wavelength_r"; hts::Error as below.
[[nodiscard]] bool bird_names_wavelengths(const std::string& text, const std::string& name);

/// Its points.
///   wavelengths      of a file that names none
///   mirror_azimuth   where azimuths have the mirror direction as the file counts them from phi_i [deg], 0 or
///                    180
/// hts::Error "path: key …": for lists that are not equally long, units that are not known, a variable that
/// is missing, several polarisations.
[[nodiscard]] ScatterPoints points_of_bird(const std::string& text, const std::string& name,
                                           const std::optional<spectral::WavelengthGrid>& wavelengths,
                                           double mirror_azimuth = 180);

/// A reflectance on a grid of directions, with metadata as the schema requires: what only the user knows is
/// "not stated", the time is that of writing.
///   grid   axis normal
[[nodiscard]] std::string bird_text(const spectral::Reflectance& brdf, AngularGrid grid);

}  // namespace hts::tables
