/// A randomly rough surface: Gaussian heights with autocorrelation C(r) = exp(-r^2/tau^2) [He91 (48)], or with one of another
/// length along each of two axes, C = exp(-x'^2/tau_x^2 - y'^2/tau_y^2), as brushing and grinding leave it.
///
/// The theory of the anisotropic surface is that of the isotropic one in stretched coordinates: every power of C is again a
/// Gaussian, so Phi(g, t) stays, with t = k^2 (v_x'^2 tau_x^2 + v_y'^2 tau_y^2)/4 and tau_x tau_y for tau^2. A ray is shadowed by
/// the slopes in its own vertical plane alone, whose variance along the azimuth alpha is 2 sigma_0^2/tau(alpha)^2,
/// 1/tau(alpha)^2 = cos^2 alpha/tau_x^2 + sin^2 alpha/tau_y^2. Derivation in docs/models/he.md.
#pragma once

#include "hts/direction.hpp"

namespace hts {

/// Correlation lengths [um] along two perpendicular axes of a surface, of which the first is given by an azimuth.
struct CorrelationLengths {
    double along, across;
};

class Surface {
  public:
    ///   rms_roughness        sigma_0 [um], standard deviation of height   0 (a mirror), or 1e-24 ... 1e24
    ///   correlation_length   tau [um], distance at which C falls to 1/e   1e-24 ... 1e24
    /// Throws hts::Error outside these ranges.
    Surface(double rms_roughness, double correlation_length);
    ///   lengths   tau_x and tau_y [um], each 1e-24 ... 1e24; equal ones make the isotropic surface
    ///   axis      whose azimuth is that of the first axis, x', from x
    /// Throws hts::Error outside these ranges.
    [[nodiscard]] static Surface anisotropic(double rms_roughness, const CorrelationLengths& lengths,
                                             const Direction& axis);

    [[nodiscard]] double rms_roughness() const noexcept { return rms_roughness_; }
    /// tau [um]; sqrt(tau_x tau_y) of an anisotropic surface.
    [[nodiscard]] double correlation_length() const noexcept { return correlation_length_; }
    /// 2 sigma_0 / tau: sqrt(2) times the rms slope, the Beckmann width alpha of Walter et al. 2007; of an anisotropic surface
    /// the root of the widths along both axes.
    [[nodiscard]] double slope_width() const noexcept { return 2 * rms_roughness_ / correlation_length_; }

    [[nodiscard]] bool isotropic() const noexcept { return lengths_.along == lengths_.across; }
    /// tau_x and tau_y, both tau of an isotropic surface [um].
    [[nodiscard]] const CorrelationLengths& correlation_lengths() const noexcept { return lengths_; }
    /// The shorter of the two: along it slopes are steepest [um].
    [[nodiscard]] double shortest_correlation_length() const noexcept;
    /// Azimuth of the first axis, -pi ... pi; 0 of an isotropic surface [rad].
    [[nodiscard]] double azimuth() const noexcept;
    /// The same as a direction on the horizon.
    [[nodiscard]] const Direction& axis() const noexcept { return axis_; }
    /// tau(alpha) along the azimuth of a direction [um].
    [[nodiscard]] double correlation_length(const Direction& along) const noexcept;
    /// 2 sigma_0 / tau(alpha) along the azimuth of a direction.
    [[nodiscard]] double slope_width(const Direction& along) const noexcept;
    /// What v_xy counts for in t, |(v_x' tau_x, v_y' tau_y)|/tau: its length where the surface is isotropic.
    [[nodiscard]] double stretched(const HorizontalChange& change) const noexcept;

  private:
    double rms_roughness_;
    double correlation_length_;
    CorrelationLengths lengths_;
    Direction axis_ = Direction::from_unit_vector({1, 0, 0});
};

/// |v_xy| of a pair as t has it, `stretched`.
///   error   as of wave_vector_change, times the longer length over tau
[[nodiscard]] double stretched_horizontal(const Surface& surface, const Direction& in,
                                          const Direction& out) noexcept;

}  // namespace hts
