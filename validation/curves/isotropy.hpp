/// What a curve in the plane of incidence would mean for all directions if the surface were isotropic.
#pragma once

#include <optional>

#include "validation/curves/curve.hpp"

namespace hts::validation {

namespace accuracy {
/// Of `isotropic_reflectance`, relative, for lobes of facet tilts at least 1 deg wide.
inline constexpr double isotropic_reflectance = 5e-3;
}  // namespace accuracy

/// Directional-hemispherical reflectance of a surface that shows this curve in the plane of incidence and
/// whose BRDF times cos theta_r depends on the tilt of the facet that would mirror light into view alone,
/// whatever its azimuth: an isotropic lobe. Between points it is linear in the tilt; each side of the mirror
/// direction has its own, of which a direction out of the plane takes the mean. 0 beyond the points, so that
/// it is a lower bound where they end early.
///   domain   a curve in the plane, of absolute values; its fixed angle at most 60 deg, else none
[[nodiscard]] std::optional<double> isotropic_reflectance(const Curve& curve, Quantity quantity);

struct IsotropicReflectance {
    double fixed_angle;  ///< [deg]
    double reflectance;
};

/// The curve of a set that would reflect most; none for sets without absolute curves in the plane.
[[nodiscard]] std::optional<IsotropicReflectance> brightest_if_isotropic(const CurveSet& set);

}  // namespace hts::validation
