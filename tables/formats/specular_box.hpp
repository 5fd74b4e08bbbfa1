/// The specular term spread over a solid angle, for files that hold no delta.
#pragma once

#include <memory>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// `brdf` with its specular reflectance rho_s(theta_i) as a box about the mirror direction:
///
///   f_box = rho_s / (pi sin^2 delta cos theta_i)     within delta of the mirror direction, delta = acos(1 - solid_angle/2 pi)
///
/// pi sin^2 delta cos theta_i is the cone's projected solid angle, so that no energy is lost while the whole cone is above
/// the horizon; for small cones it is solid_angle cos theta_i, as in [He91 (70)]. The delta that remains is 0.
///   brdf          not polarised afterwards, since a spectral::Reflectance knows of its delta the unpolarised reflectance alone
///   solid_angle   [sr] 1e-9 ... 1, else hts::Error
[[nodiscard]] spectral::Reflectance with_specular_box(spectral::Reflectance brdf, double solid_angle);

}  // namespace hts::tables
