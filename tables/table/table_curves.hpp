/// The parts of a table that depend on one angle alone. Private to the module.
#pragma once

#include <vector>

#include "tables/table/build_table.hpp"
#include "tables/table/table_coordinates.hpp"

namespace hts::tables {

/// A spline over [0, 1] and its number of nodes.
struct Curve {
    std::size_t nodes;
    std::vector<double> coefficients;  ///< values side by side
};

/// Specular reflectance and lobe albedo over grazing, to half of the tolerance with 1 as peak.
[[nodiscard]] Curve specular_curve(const spectral::Reflectance& exact, const CoordinateMap& map,
                                   double tolerance);
[[nodiscard]] Curve albedo_curve(const spectral::Reflectance& exact, const CoordinateMap& map,
                                 double tolerance);
/// F_p/F_s over cos theta_d, real parts, then imaginary parts.
[[nodiscard]] Curve polarisation_curve(const spectral::Reflectance& exact, double tolerance);

/// Directional-hemispherical reflectance of the lobe [1], one value per wavelength: a product rule of 8-point
/// Gauss-Legendre panels in theta_r, graded about theta_i, and in the azimuth, graded about the mirror plane.
///   error   accuracy::lobe_albedo absolute for lobes wider than a degree      cost   some 2500 lobe values
void lobe_albedo(const spectral::Reflectance& exact, const Direction& in, std::span<double> values);

namespace accuracy {
inline constexpr double lobe_albedo = 1e-4;
}  // namespace accuracy

}  // namespace hts::tables
