/// A randomly rough surface: Gaussian heights with autocorrelation C(r) = exp(-r^2/tau^2) [He91 (48)], or
/// with one of another length along each of two axes, C = exp(-x'^2/tau_x^2 - y'^2/tau_y^2), as
/// brushing and grinding leave it.
///
/// The theory of the anisotropic surface is that of the isotropic one in stretched coordinates: every power
/// of C is again a Gaussian, so Phi(g, t) stays, with t = k^2 (v_x'^2 tau_x^2 + v_y'^2 tau_y^2)/4 and tau_x
/// tau_y for tau^2. A ray is shadowed by the slopes in its own vertical plane alone, whose variance along the
/// azimuth alpha is 2 sigma_0^2/tau(alpha)^2, 1/tau(alpha)^2 = cos^2 alpha/tau_x^2 + sin^2 alpha/tau_y^2.
/// Derivation in docs/models/he.md.
///
/// `correlated` gives the heights another shape of correlation, C(|(x'/tau_x, y'/tau_y)|), whose lengths then
/// take the place of tau. Such a surface has no slope of its own: light sees the slopes of frequencies up to
/// 1/lambda, finer structure diffracts. `seen_by` is the Gaussian surface with those, for shadowing and what
/// else follows slopes. Derivation in docs/models/correlations.md.
#pragma once

#include <optional>

#include "hts/correlation/correlation.hpp"
#include "hts/direction.hpp"

namespace hts {

/// Correlation lengths [um] along two perpendicular axes of a surface, of which the
/// first is given by an azimuth.
struct CorrelationLengths {
    double along, across;
};

class Wavelength;

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

    /// The same roughness and lengths with another shape of correlation.
    [[nodiscard]] Surface correlated(const Correlation& shape) const;

    [[nodiscard]] double rms_roughness() const noexcept { return rms_roughness_; }
    /// tau [um]; sqrt(tau_x tau_y) of an anisotropic surface.
    [[nodiscard]] double correlation_length() const noexcept { return correlation_length_; }
    /// 2 sigma_0 / tau: sqrt(2) times the rms slope, the Beckmann width alpha of Walter et al. 2007; of an
    /// anisotropic surface the root of the widths along both axes.
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
    /// The shape of correlation; none of the Gaussian that the published model has. What follows tau as a
    /// measure of slopes (slope_width, tau(alpha)) is that of the Gaussian surface of the same lengths: ask
    /// `seen_by` for the slopes of others.
    [[nodiscard]] const std::optional<Correlation>& correlation() const noexcept { return correlation_; }
    /// The Gaussian surface of the same sigma_0 whose rms slopes s along both axes are those of the
    /// frequencies up to 1/lambda, tau = sqrt(2) sigma_0/s; the surface itself where its
    /// correlation is Gaussian.
    [[nodiscard]] Surface seen_by(const Wavelength& wavelength) const noexcept;
    /// Share of the variance of heights in frequencies from one to another [1/um], 0 ... infinity.
    [[nodiscard]] double variance_share(double from, double to) const noexcept;
    /// What v_xy counts for in t, |(v_x' tau_x, v_y' tau_y)|/tau: its length where the surface is isotropic.
    [[nodiscard]] double stretched(const HorizontalChange& change) const noexcept;

  private:
    double rms_roughness_;
    double correlation_length_;
    CorrelationLengths lengths_;
    Direction axis_ = Direction::from_unit_vector({1, 0, 0});
    std::optional<Correlation> correlation_;
};

/// Derivatives by the axes of a surface: by ln tau_x, ln tau_y and the azimuth of the first axis.
struct ByAxes {
    double x, y, azimuth;
};
[[nodiscard]] constexpr ByAxes operator*(double scale, const ByAxes& by) noexcept {
    return {scale * by.x, scale * by.y, scale * by.azimuth};
}
[[nodiscard]] constexpr ByAxes operator+(const ByAxes& a, const ByAxes& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.azimuth + b.azimuth};
}
/// Of the logarithm of slope_width along a direction; that by the azimuth of the direction is the negative of
/// the last.
[[nodiscard]] ByAxes log_slope_by_axes(const Surface& surface, const Direction& along) noexcept;
/// How the lengths of what is `seen_by` go with those of the surface, d ln tau/d ln length along both axes: 1
/// where the correlation is Gaussian.
[[nodiscard]] CorrelationLengths seen_by_lengths(const Surface& surface,
                                                 const Wavelength& wavelength) noexcept;

/// |v_xy| of a pair as t has it, `stretched`.
///   error   as of wave_vector_change, times the longer length over tau
[[nodiscard]] double stretched_horizontal(const Surface& surface, const Direction& in,
                                          const Direction& out) noexcept;

}  // namespace hts
