/// A BRDF from points at which it was measured or computed, and the two text formats that list them.
///
/// Points in the plane of incidence alone are spread about the mirror direction (in_plane.hpp), points on a
/// full regular grid about the normal are interpolated on it (angular_grid.hpp), others are taken by nearness
/// (nearest_points.hpp). Each says where it knows the surface (spectral::Evaluator::knows).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/formats/points/angular_grid.hpp"

namespace hts::tables {

/// Directions of a measurement [deg].
struct ScatterAngles {
    double theta_i, phi_i, theta_r, phi_r;
};

struct ScatterPoints {
    spectral::WavelengthGrid wavelengths;
    std::vector<ScatterAngles> angles;  ///< polar angles 0 ... 90
    std::vector<double> values;         ///< [1/sr], all wavelengths of a point together
    std::vector<std::size_t> lines{};   ///< of each point in its file; may be empty
    std::vector<std::string> notes{};   ///< what a user should know of the file
    /// What the wavelengths stand for: B, G, R or Z, Y, X; none if they are wavelengths.
    std::vector<std::string> channels{};
};

/// How points are joined.
enum class PointLayout { in_plane, grid, scattered };

/// The BRDF that points describe.
struct PointsBrdf {
    spectral::Reflectance brdf;
    PointLayout layout;
    std::vector<std::string> notes;  ///< those of the points, and what was assumed
};

/// hts::Error if there is no point, a polar angle is out of range, a value not finite or above 1e100, or if
/// two points of the same directions contradict each other.
[[nodiscard]] PointsBrdf brdf_from(const std::string& name, const ScatterPoints& given);

/// The grid that a CSV file gets: polar angles every 2.5 degrees, the last 89.9, azimuths every 5; where the
/// surface is not isotropic polar angles every 5, azimuths every 10 and the light's every 15.
[[nodiscard]] AngularGrid csv_grid(bool isotropic = true);

/// CSV with columns theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg and, for each wavelength,
/// brdf_550nm [1/sr]; six digits.
///   grid   axis normal
[[nodiscard]] std::string scatter_csv(const spectral::Reflectance& brdf, AngularGrid grid);

/// The same as a scatter file in the manner of ASTM E1392 (E2387): angles in radians, columns
/// 550nm; nine digits and six.
///   rgb   three channels, blue, green and red, as columns R, G, B
[[nodiscard]] std::string scatter_astm(const spectral::Reflectance& brdf, AngularGrid grid, bool rgb = false);

/// Points of a CSV file (spectral/text/csv.hpp): columns theta_i_deg, theta_r_deg, phi_i_deg (0 if left out),
/// phi_r_deg, and the BRDF either in columns brdf_550nm or in one column brdf, with wavelength_um or without.
/// Other columns are passed over, so that what `hts eval` writes is such a file.
///   wavelengths   what the BRDF columns are called, in the order of increasing wavelength; needed
///                 if the file does not say
/// hts::Error "path:line: …".
[[nodiscard]] ScatterPoints points_of_csv(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

/// Points of a scatter file in the manner of ASTM E1392 (E2387): lines "KEY value", the last "VARS
/// theta_i,phi_i,theta_s,phi_s,…" with a name per channel, then a line of numbers per point, angles in
/// radians. Channels are 450nm, 550nm, …, or R, G, B, or one of any name.
///   wavelengths   as above
/// hts::Error "path:line: …".
[[nodiscard]] ScatterPoints points_of_astm(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

/// Points of a scatter table of FRED (fred.hpp), which names no wavelength.
///   mirror_azimuth   of the mirror direction as the file counts azimuths from the light's [deg]:
///                    0, FRED's own way, or 180
/// hts::Error "path:line: …", also where the values say that the mirror direction is on the other side.
[[nodiscard]] ScatterPoints points_of_fred(std::string_view text, const std::string& name,
                                           const std::optional<spectral::WavelengthGrid>& wavelengths,
                                           double mirror_azimuth = 0);

}  // namespace hts::tables
