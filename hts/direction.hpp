/// Directions above a surface, and what a pair of them says about the facet that would mirror one into the
/// other.
///
/// Conventions: the outward normal is +z. Both directions point away from the surface: the incident one
/// towards the light, the outgoing one towards the viewer; the mirror direction of (theta, phi) is (theta,
/// phi + 180 deg). Propagation vectors of the paper are k_i = -in and k_r = out. Angles are radians except in
/// `from_degrees`.
#pragma once

#include <span>

namespace hts {

/// A vector in the frame of the surface; no invariant.
struct Vector3 {
    double x, y, z;
};

[[nodiscard]] constexpr Vector3 operator+(Vector3 a, Vector3 b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vector3 operator-(Vector3 a, Vector3 b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vector3 operator-(Vector3 a) noexcept {
    return {-a.x, -a.y, -a.z};
}
[[nodiscard]] constexpr Vector3 operator*(double s, Vector3 a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] constexpr double dot(Vector3 a, Vector3 b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vector3 cross(Vector3 a, Vector3 b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A unit vector that points away from the surface, on or above the horizon.
/// Keeps sine and cosine of both angles, so that grazing directions keep the full precision of cos theta and
/// a vertical direction keeps its azimuth, along which limits (the s and p vectors) are taken.
class Direction {
  public:
    /// From polar angle and azimuth.
    ///   theta   [rad]  0 ... pi/2, else hts::Error      phi   [rad]  any finite value
    [[nodiscard]] static Direction from_angles(double theta, double phi);

    /// From polar angle and azimuth in degrees; multiples of 90 degrees come out exact (cos 90 deg is 0).
    ///   theta   [deg]  0 ... 90, else hts::Error        phi   [deg]  any finite value
    [[nodiscard]] static Direction from_degrees(double theta, double phi);

    /// The same of many directions: the same bits in less time. The error of the first that is wrong is
    /// thrown; the directions before it are written.
    ///   theta, phi   [deg]      result   as many; other sizes are an hts::Error
    static void from_degrees(std::span<const double> theta, std::span<const double> phi,
                             std::span<Direction> result);

    /// From a vector of any non-zero finite length with z >= 0, else hts::Error; a vertical one gets azimuth
    /// 0.
    [[nodiscard]] static Direction from_vector(Vector3 vector);

    /// From a vector known to have length 1, to rounding, and z >= 0, unchecked; a vertical one gets azimuth
    /// 0.
    [[nodiscard]] static Direction from_unit_vector(Vector3 vector) noexcept;

    [[nodiscard]] double cos_theta() const noexcept { return cos_theta_; }
    [[nodiscard]] double sin_theta() const noexcept { return sin_theta_; }
    [[nodiscard]] double cos_phi() const noexcept { return cos_phi_; }
    [[nodiscard]] double sin_phi() const noexcept { return sin_phi_; }
    [[nodiscard]] Vector3 vector() const noexcept {
        return {sin_theta_ * cos_phi_, sin_theta_ * sin_phi_, cos_theta_};
    }
    /// (theta, phi + 180 deg).
    [[nodiscard]] Direction mirror() const noexcept { return {cos_theta_, sin_theta_, -cos_phi_, -sin_phi_}; }

  private:
    Direction(double cos_theta, double sin_theta, double cos_phi, double sin_phi) noexcept
        : cos_theta_{cos_theta}, sin_theta_{sin_theta}, cos_phi_{cos_phi}, sin_phi_{sin_phi} {}

    double cos_theta_, sin_theta_, cos_phi_, sin_phi_;
};

/// The wave-vector change of a pair of directions in units of 2 pi / wavelength, v = k_r - k_i [He91 (20)].
/// Its direction is the normal of the facet that mirrors `in` into `out`, and half its length is the cosine
/// of the local angle of incidence on that facet.
struct WaveVectorChange {
    double horizontal;  ///< |v_xy|, 0 ... 2
    double vertical;    ///< v_z = cos theta_i + cos theta_r, 0 ... 2

    /// |v|^2 = 4 cos^2 theta_d.
    [[nodiscard]] double squared() const noexcept { return horizontal * horizontal + vertical * vertical; }
    /// cos theta_d = |v| / 2, the local angle of incidence on the bisecting facet.
    [[nodiscard]] double cos_theta_d() const noexcept;
    /// sqrt(G) = v.v / v_z [He91 (76)]: the paper's two brackets both equal |k_r x k_i|^2 and cancel. 0 where
    /// both directions graze.
    [[nodiscard]] double root_geometrical_factor() const noexcept;
};

/// Wave-vector change of a pair.
///   error   |v_xy| keeps about 2e-16 absolute, also where both directions graze and nearly mirror each other
[[nodiscard]] WaveVectorChange wave_vector_change(const Direction& in, const Direction& out) noexcept;

/// v_xy by its components, in units of 2 pi / wavelength.
struct HorizontalChange {
    double x, y;
};

/// The horizontal part of the wave-vector change of a pair.
///   formula   with u the unit vectors of both azimuths, half of
///             (sin theta_r - sin theta_i) (u_r - u_i) + (sin theta_r + sin theta_i) (u_r + u_i)
///   error     3e-16 absolute, also where both directions graze and nearly mirror each other
[[nodiscard]] HorizontalChange horizontal_change(const Direction& in, const Direction& out) noexcept;

/// Derivatives by the angles of a pair [1/rad]. Along the normal theta grows towards the azimuth that the
/// direction keeps; phi is the azimuth of the outgoing direction less that of the incident one.
template <class Value>
struct ByAngles {
    Value theta_i, theta_r, phi;
};

/// Derivatives of a wave-vector change. That of |v_xy|^2 is smooth in the mirror direction, that of |v_xy| is
/// not.
struct WaveVectorChangeGradient {
    ByAngles<double> horizontal_squared;  ///< of |v_xy|^2
    ByAngles<double> vertical;            ///< of v_z
    ByAngles<double> squared;             ///< of |v|^2
};

/// Derivatives of `wave_vector_change`.
///   formula   d|v_xy|^2/d theta_i = 2 cos theta_i (sin theta_i + sin theta_r cos phi), its twin, and
///             d|v_xy|^2/d phi = -2 sin theta_i sin theta_r sin phi
///   error     2e-15, absolute
[[nodiscard]] WaveVectorChangeGradient wave_vector_change_gradient(const Direction& in,
                                                                   const Direction& out) noexcept;

/// Sine of the azimuth between a pair, phi_r - phi_i; 0 in the plane of incidence.
[[nodiscard]] double sin_azimuth_between(const Direction& in, const Direction& out) noexcept;

}  // namespace hts
