/// Height maps from the files that instruments and their programs write.
///
/// | file | states its units |
/// |---|---|
/// | Gwyddion Simple Field (.gsf) | yes, where XReal, YReal, XYUnits and ZUnits stand in its head |
/// | text matrix of Gwyddion (# Width: 10 µm …) | yes |
/// | ESRI ASCII grid (ncols, nrows, cellsize …) | no: --length-unit, --height-unit |
/// | points x y z on a regular grid, in any order | no: --length-unit, --height-unit |
/// | matrix of numbers: commas, semicolons, tabs or spaces | no: --step, --height-unit |
/// | NumPy array (.npy) of two dimensions | no: --step, --height-unit |
/// | PNG, grey of 16 bits | no: --step, --height-unit |
/// | of instruments (.sdf, .x3p, .sur …), by Python where it has surfalize or SurfaceTopography | yes |
///
/// Rows stand from the top. No value is "nan" or an empty field, in an ESRI grid NODATA_value too.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "validation/topography/maps/height_map.hpp"

namespace hts::validation {

/// What a file does not state.
struct MapUnits {
    std::optional<double> step_x{}, step_y{};  ///< between points [um]
    std::optional<double> length{};            ///< of lengths in the plane [um]
    std::optional<double> height{};            ///< of heights [um], of a PNG file per grey level
};

/// "nm", "um", "µm", "mm" or "m" in um, or a number of um > 0; hts::Error otherwise.
[[nodiscard]] double length_unit(std::string_view text);

/// hts::Error "path: …", with the line where there are lines, if the file is missing, claims what it does not
/// hold, is cut off, is no number where one must be, lacks a unit that `units` does not give, or states one
/// that `units` gives too.
[[nodiscard]] HeightMap read_height_map(const std::filesystem::path& path, const MapUnits& units = {});

}  // namespace hts::validation
