/// The specular term spread over a solid angle, for files that hold no delta: as a box about the mirror
/// direction or as a smooth lobe of facets, whichever a file's grid can hold.
#pragma once

#include <memory>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// `brdf` with its specular reflectance rho_s(theta_i) as a box about the mirror direction:
///
///   f_box = rho_s / (pi sin^2 delta cos theta_i)     within delta of the mirror direction, delta =
///   acos(1 - solid_angle/2 pi)
///
/// pi sin^2 delta cos theta_i is the cone's projected solid angle, so that no energy is lost while the whole
/// cone is above the horizon; for small cones it is solid_angle cos theta_i, as in [He91 (70)]. The
/// delta that remains is 0.
///   brdf          not polarised afterwards, since a spectral::Reflectance knows of its delta the
///                 unpolarised reflectance alone
///   solid_angle   [sr] 1e-9 ... 1, else hts::Error
[[nodiscard]] spectral::Reflectance with_specular_box(spectral::Reflectance brdf, double solid_angle);

/// Half the opening angle of that box, delta [rad].
[[nodiscard]] double specular_box_half_angle(double solid_angle);

/// `brdf` with its specular reflectance as light of facets about the normal:
///
///   f = rho_s(theta_i) p(theta_h)/(4 cos theta_d cos theta_r),  p = 3 (1 - q)^2/(4 pi h) where q =
///   sin^2(theta_h/2)/h < 1, h = 3 solid_angle/(16 pi)
///
/// p is a density of the half vectors' directions, so that no energy is lost while their views are above the
/// horizon, and f at the mirror direction of light along the normal is that of the box. Its edges are at the
/// same half vectors for every light, where files on half vectors can hold them.
[[nodiscard]] spectral::Reflectance with_specular_lobe(spectral::Reflectance brdf, double solid_angle);

/// Largest theta_h of that lobe [rad].
[[nodiscard]] double specular_lobe_tilt(double solid_angle);

}  // namespace hts::tables
