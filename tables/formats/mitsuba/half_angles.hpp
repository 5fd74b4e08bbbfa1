/// Half-vector angles of a pair, and the frames of Stokes vectors that go with them. Private to pbsdf.cpp.
#pragma once

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

struct HalfAngles {
    double theta_h, theta_d, phi_d;  ///< [rad], phi_d -pi ... pi
};

/// As pbsdf.hpp defines them; for a vertical h, b is taken as y.
[[nodiscard]] HalfAngles half_angles(const DirectionPair& pair) noexcept;

/// Light and view, which may lie below the horizon, and x = p x h.
struct HalfAnglesPair {
    explicit HalfAnglesPair(const HalfAngles& angles) noexcept;

    Vector3 in, out, x;
};

/// x = in x out/|in x out|, of the same direction for any pair that shares its half angles; some vector
/// across where both are one.
[[nodiscard]] Vector3 scattering_plane_normal(const DirectionPair& pair) noexcept;

}  // namespace hts::tables
