/// Mueller matrices in other programs' frames.
///
/// The frames of polarisation.hpp, (s, p, k), are left-handed, as the paper has them. Mitsuba 3 and most
/// texts use right-handed frames (x, y, k) with k along the propagation, y = k x x, and for S3 = +1 light
/// whose field turns clockwise for the receiver. With x = s that differs from ours in the sign of S2 alone;
/// any other x is a rotation.
#pragma once

#include "hts/direction.hpp"
#include "hts/polarisation.hpp"

namespace hts {

/// The same reflection between right-handed frames.
///   mueller    in the frames of polarisation.hpp
///   x_in       x axis of the incident ray's frame, a unit vector across k_i = -in
///   x_out      x axis of the reflected ray's frame, a unit vector across k_r = out
[[nodiscard]] Mueller in_right_handed_frames(const Mueller& mueller, const Direction& in,
                                             const Direction& out, Vector3 x_in, Vector3 x_out) noexcept;

/// The x axis that Mitsuba 3 gives a ray of propagation direction k, a unit vector (Duff et al., J. Comput.
/// Graph. Tech. 6(1), 2017).
[[nodiscard]] Vector3 mitsuba_x_axis(Vector3 k) noexcept;

/// The same reflection as Mitsuba 3 expects it of a BSDF in radiance mode: from the implicit frame of -in to
/// that of out, without the cosine.
[[nodiscard]] Mueller mitsuba_mueller(const Mueller& mueller, const Direction& in,
                                      const Direction& out) noexcept;

}  // namespace hts
