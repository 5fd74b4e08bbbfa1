/// The squares on which RGL files lie, in single precision as their readers compute them. Private to
/// rgl.cpp and rgl_writer.cpp.
#pragma once

#include "hts/direction.hpp"
#include "spectral/models/reflectance.hpp"
#include "tables/formats/mitsuba/bilinear_warp.hpp"

namespace hts::tables {

/// u = sqrt(2 theta/pi) and its inverse.
[[nodiscard]] float u_of_theta(float theta) noexcept;
[[nodiscard]] float theta_of_u(float u) noexcept;

/// Polar angle and azimuth of the light [rad].
struct LightAngles {
    explicit LightAngles(const Direction& in) noexcept;
    /// Its point on the square of sigma.
    [[nodiscard]] Point2 square() const noexcept;

    float theta, phi;
};

/// The half vector m of a pair.
class HalfVector {
  public:
    ///   isotropic   whether azimuths count from the light's
    HalfVector(const DirectionPair& pair, bool isotropic) noexcept;

    [[nodiscard]] const LightAngles& light() const noexcept { return light_; }
    [[nodiscard]] Point2 square() const noexcept { return square_; }
    /// Of the view, per area of the square: 2 pi^2 u sin(theta_m) 4 (w_i.m) [sr].
    [[nodiscard]] float solid_angle() const noexcept { return solid_angle_; }

  private:
    LightAngles light_;
    Point2 square_;
    float solid_angle_;
};

/// The half vector at a point of the square.
///   phi   azimuth that the point's counts from [rad]
[[nodiscard]] Vector3 half_vector(Point2 square, float phi) noexcept;

}  // namespace hts::tables
