/// Scans of the plane of incidence as a BRDF of the whole hemisphere, by a named assumption.
///
/// A scan says nothing of views beside its plane. Here they get what the scan shows at the same angle
/// from the mirror direction:
///   f(view) = (1 + cos psi)/2 s(delta) + (1 - cos psi)/2 s(-delta)
/// with delta the angle between view and mirror direction, psi the azimuth about it, 0 towards the normal,
/// and s the scan over the angle from the mirror direction, positive towards the normal. Between angles of
/// incidence s is interpolated at the same delta. A view is known if the scan reaches delta on the view's
/// side (cos psi > 0 or not), or if that side is below the horizon there and the other one reaches it.
/// Private to the readers of points.
#pragma once

#include <optional>

#include "tables/formats/points/scatter_points.hpp"

namespace hts::tables {

/// Whether all points lie in planes of incidence, to 0.05 deg.
[[nodiscard]] bool is_in_plane(const ScatterPoints& points);

///   points   in plane, checked, no directions twice
[[nodiscard]] spectral::Reflectance in_plane_brdf(const std::string& name, const ScatterPoints& points);

}  // namespace hts::tables
