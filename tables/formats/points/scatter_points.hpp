/// A BRDF from points at which it was measured or computed, and the two text formats that list them.
///
/// Points on a full regular grid about the normal are interpolated on it (angular_grid.hpp). Others are taken by nearness: at a
/// pair of directions the eight nearest points count by the inverse square of their distance in
///
///   4 theta_h,  theta_d,  2 sin theta_h sin theta_d cos 2 phi_d
///
/// of Rusinkiewicz' half and difference angles [Rusinkiewicz98]. These are the same for swapped directions and on both sides of the
/// plane of incidence: the surface is taken to be isotropic and reciprocal. Half directions count most, since lobes depend on them.
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
};

/// The BRDF that the points describe. hts::Error if there is none, a polar angle is out of range or a value not finite or above 1e100.
///   regular   set to whether the points are a full grid
[[nodiscard]] spectral::Reflectance brdf_from(const std::string& name, const ScatterPoints& points,
                                              bool* regular = nullptr);

/// The grid that a CSV file gets: polar angles every 2.5 degrees, the last 89.9, azimuths every 5; where the surface is not
/// isotropic polar angles every 5, azimuths every 10 and the light's every 15.
[[nodiscard]] AngularGrid csv_grid(bool isotropic = true);

/// CSV with columns theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg and, for each wavelength, brdf_550nm [1/sr]; six digits.
///   grid   axis normal
[[nodiscard]] std::string scatter_csv(const spectral::Reflectance& brdf, AngularGrid grid);

/// Points of a CSV file (spectral/text/csv.hpp): columns theta_i_deg, theta_r_deg, phi_i_deg (0 if left out), phi_r_deg, and the BRDF
/// either in columns brdf_550nm or in one column brdf, with wavelength_um or without. Other columns are passed over, so that what
/// `hts eval` writes is such a file.
///   wavelengths   what the BRDF columns are called, in the order of increasing wavelength; needed if the file does not say
/// hts::Error "path:line: …".
[[nodiscard]] ScatterPoints points_of_csv(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

/// Points of a scatter file in the manner of ASTM E1392 (E2387): lines "KEY value", the last "VARS theta_i,phi_i,theta_s,phi_s,…"
/// with a name per channel, then a line of numbers per point, angles in radians. Channels are 450nm, 550nm, …, or R, G, B, or one
/// of any name.
///   wavelengths   as above
/// hts::Error "path:line: …".
[[nodiscard]] ScatterPoints points_of_astm(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

}  // namespace hts::tables
