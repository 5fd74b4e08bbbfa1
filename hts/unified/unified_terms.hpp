/// The successor of He-Torrance at one wavelength, nearer to exact scattering: `"model": "he_unified"`.
///
/// NOT part of the published model. One lobe between Kirchhoff's theory, which the published model is, and
/// perturbation theory, which is exact for smooth surfaces; derivations in docs/models/he_unified.md. With k
/// = 2 pi/lambda, c and s the cosine and sine of each polar angle, up = c_i + c_r, phi the azimuth of the
/// reflected ray from the forward direction, g = (k sigma_0 up)^2 (sigma_0, not the effective
/// roughness) and t = v_xy^2 tau^2/4:
///
///   f = (k tau)^2 Phi(g, t) G/(4 pi up^2 c_i c_r) |M|^2 + a/pi
///   |M|^2       half the sum over the elements of the Jones matrix M = K + beta' (B - K)
///   K           2 cos^2 theta_d facet_jones: Kirchhoff's
///   B           2 c_i c_r b: Bragg's, `bragg_jones`
///   beta        -d ln Phi/dt, the mean of 1/m over the terms of Phi: how much of Bragg's
///   beta'       1 - w (1 - L(c_i)) (1 - L(c_r)),   w = 1 - beta: all of it near the horizon
///   L(c)        (1 + 1.25 k sigma_0 c)^-4
///   G           (1 + R' w (m(theta_i) m(theta_r) - 1))/(1 + w (Lambda_i + Lambda_r)): shadowing of
///               correlated heights, and the return of light reflected more than once (return_factor.hpp)
///   specular    |F_q|^2 exp(-x_q) for q = s and p, not shadowed: unified_mirror.hpp
///
/// Fitted are 1.25 and the power 4, and 0.25 in Z, to exact scattering from perfectly conducting profiles;
/// the rest is computed. Frames as in polarisation.hpp. BRDFs are in 1/sr. Every function is total, never
/// NaN; the lobe is 0 at the horizon.
#pragma once

#include <complex>
#include <optional>

#include "hts/terms.hpp"
#include "hts/tolerance.hpp"
#include "hts/unified/return_factor.hpp"

namespace hts {

// Of `unified_lobe`, beside element 00 of the Mueller matrix, above 1e-280, for sigma_0/tau >= 0.003, against
// the formula with the table of return_factor.hpp.
namespace accuracy {
inline constexpr double unified_brdf = 4e-13;
inline constexpr double kicks = 2e-13;       ///< of beta and of w, relative
inline constexpr double quick_kicks = 1e-6;  ///< the finest tolerance that the quicker form of `kicks` meets
}  // namespace accuracy

/// Of which a perfect conductor is the limit, to rounding.
[[nodiscard]] inline RefractiveIndex perfect_conductor() {
    return {1e20, 1e20};
}

/// What a direction contributes, whatever the wavelength.
struct UnifiedView {
    UnifiedView(const Surface& surface, const ReturnFactor& m, const Direction& along) noexcept
        : direction{along},
          masked{visibility(surface, along).masked},
          return_factor{surface.isotropic() ? m(along)
                                            : ReturnFactor{surface.slope_width(along) / 2}(along)} {}

    Direction direction;
    double masked;         ///< cos theta Lambda
    double return_factor;  ///< m, of an anisotropic surface m(theta; sigma_0/tau(alpha)) of its azimuth
};

/// What a surface is at one wavelength, whatever the directions.
struct UnifiedWave {
    ///   m   of what the wavelength sees of the surface
    UnifiedWave(Surface rough, const ReturnFactor& m, const Wavelength& wavelength, CoatedIndex of);

    Surface surface, seen;  ///< and what the wavelength sees of it: `Surface::seen_by`
    CoatedIndex index;
    double k_sigma, k_tau;  ///< of an anisotropic surface with sqrt(tau_x tau_y); tau of what is seen
    double k_length;        ///< with the surface's own correlation length: of the lobe
    double lift;            ///< Z
    double returned;        ///< R'
};

/// Reflectance of uniform unpolarised light by the flat surface, 2 times the integral of |F|^2 c dc [1].
///   error   1e-12, absolute
[[nodiscard]] double flat_reflectance(const CoatedIndex& index);

/// Z, which lifts cos theta in the denominators of Bragg's p: 0.25 (k sigma_0)^2 (k tau)^(-3/2).
/// Fitted for k sigma_0 <= 6 and k tau >= 2; beyond, it fades with 6/(k sigma_0) and with (k tau/2)^(5/2), so
/// that it vanishes in the limit of geometric optics and for correlation lengths far below a wavelength.
[[nodiscard]] double bragg_lift(double k_sigma, double k_tau) noexcept;

/// Bragg's matrix b, that of the first order of perturbation theory (Rayleigh-Rice).
///   formula   with e = N^2, r = sqrt(e - s^2), N_x = e (c_x + Z) + r_x:
///             ss: -(e - 1) cos phi/((c_i + r_i)(c_r + r_r)),    pp: (e - 1)(r_i r_r cos phi - e s_i
///             s_r)/(N_i N_r), sp: -(e - 1) r_i sin phi/(N_i (c_r + r_r)),       ps: -(e - 1) r_r
///             sin phi/((c_i + r_i) N_r)
///   limits    2 c_i c_r b is 2 cos^2 theta_d facet_jones in the mirror direction with Z = 0, and
///             differs from it by O(v_xy^2)
[[nodiscard]] JonesMatrix bragg_jones(const Direction& in, const Direction& out, const CoatedIndex& index,
                                      double lift) noexcept;

/// Phi, beta and w = 1 - beta.
struct Kicks {
    double phi, beta, rest;
    PhiMethod method;
};

/// The mean of 1/m over the terms of Phi, m the number of kicks by the roughness that a wave has had: 1 in
/// the first order, 1/g in the limit of geometric optics.
///   lobe        with a limit of Phi, that of beta
///   tolerance   of Phi, of beta and of w, relative: from accuracy::quick_kicks on by the
///               derivative of Phi's table
///   error       accuracy::phi, accuracy::kicks, or the tolerance
///   cost        some 0.2 to 1 microsecond, a fifth of it by the table
[[nodiscard]] Kicks kicks(double g, double t, DiffuseLobe lobe = DiffuseLobe::full,
                          Tolerance tolerance = Tolerance{accuracy::finest_tolerance}) noexcept;
/// The same of a surface, from 2 D where its correlation is not Gaussian.
[[nodiscard]] Kicks kicks(const Surface& surface, double g, double t, DiffuseLobe lobe,
                          Tolerance tolerance) noexcept;

/// The lobe at a pair of directions, and what it was made of.
struct UnifiedLobe {
    JonesMatrix jones;      ///< its squared elements are BRDFs [1/sr]
    double phase_variance;  ///< g
    double lobe_argument;   ///< t
    Kicks kicks;
    double shadowing;  ///< G

    /// For unpolarised light [1/sr].
    [[nodiscard]] double brdf() const noexcept {
        return (std::norm(jones.ss) + std::norm(jones.sp) + std::norm(jones.ps) + std::norm(jones.pp)) / 2;
    }
};

/// The directional-diffuse term.
///   tolerance       relative, as of `kicks`
///   lobe_argument   t, where the caller knows it better than the difference of two directions can
///   error           accuracy::unified_brdf, or the tolerance
[[nodiscard]] UnifiedLobe unified_lobe(const UnifiedView& in, const UnifiedView& out, const UnifiedWave& wave,
                                       DiffuseLobe lobe = DiffuseLobe::full,
                                       Tolerance tolerance = Tolerance{accuracy::finest_tolerance},
                                       std::optional<double> lobe_argument = {}) noexcept;

/// The share of the lobe that polarisation_mixing mixes, of an isotropic surface.
[[nodiscard]] double mixed_share(const Surface& surface) noexcept;

/// Its Mueller matrix [1/sr] in the frames of polarisation.hpp: (1 - l) Mueller(M) + l Mueller(P M
/// P), P exchanging s and p.
///   mixed   l, `mixed_share` or 0
[[nodiscard]] Mueller unified_mueller(const JonesMatrix& jones, double mixed) noexcept;

}  // namespace hts
