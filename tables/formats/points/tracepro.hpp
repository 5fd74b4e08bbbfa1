/// TracePro's surface properties as text: a head of lines "TracePro Surface Property Data", "Scatter 5" and
/// the like, columns of surface data, and below "Table_BSDF_Data" a row for each
/// temperature, wavelength [um], direction of the light [deg], ScatterBeta and ScatterAzimuth [deg].
///
/// ScatterBeta is |beta - beta_0|, the distance of the view from the mirror direction in the plane of
/// direction cosines, ScatterAzimuth the direction there. Its makers publish no description; this one follows
/// bazjo/brdf_utils on GitHub (documentation and templates), whose authors checked it in TracePro. Where
/// azimuth 0 points is not said there: away from the normal is taken. Private to the formats.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Whether a text begins like one.
[[nodiscard]] bool is_tracepro_file(std::string_view text);

struct TraceProFile {
    spectral::Reflectance brdf;
    std::vector<std::string> notes;
};

/// Its BRDF: the table, which must be whole; without one the coefficients of ABg, A/(B + ScatterBeta^g). At
/// several temperatures those nearest to 293 K. Interpolated linearly in angles and ScatterBeta, as TracePro
/// does.
///   outwards   the azimuth that points away from the normal [deg], 0 or 180
/// hts::Error "path:line: …" for anything else.
[[nodiscard]] TraceProFile tracepro_file(std::string_view text, const std::string& name, double outwards = 0);

}  // namespace hts::tables
