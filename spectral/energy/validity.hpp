/// Where the model itself can be believed: what its own assumptions say about a surface, a pair of directions
/// and a wavelength. Not a bound of error and not about arithmetic; outside, every value is still finite and
/// computed as the equations say.
///
/// The model takes each point for its tangent plane, slopes for gentle, light for scattered once and
/// shadowing for geometric [He91, sections 2.2, 2.4 and A.4]. Each assumption is a criterion with two limits:
/// `caution`, from where results are known to be worse than the model's best, and `outside`, from where the
/// assumption contradicts the input or the error is beyond what has been measured. rms_slope,
/// curvature_radius and the rest say how a criterion is measured; `limits` where its two numbers come from.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::spectral {

// ---- measures of a surface

// Of an anisotropic surface tau is the shorter of its correlation lengths, along which the
// surface is at its worst.

/// rms slope along any one direction, sqrt(2) sigma_0/tau: the root of -C''(0) [1].
[[nodiscard]] double rms_slope(const Surface& surface) noexcept;
/// rms slopes along both axes, sqrt(2) sigma_0/tau_x and sqrt(2) sigma_0/tau_y [1].
struct RmsSlopes {
    double along, across;
};
[[nodiscard]] RmsSlopes rms_slopes(const Surface& surface) noexcept;

/// Share of the surface, seen from above, that is steeper than 45 degrees, exp(-tau^2/(4 sigma_0^2)) [1]:
/// light that falls in along the normal is there reflected downwards and must hit the surface again, which
/// the model neglects. Derivation: both slopes are normal with variance 2 sigma_0^2/tau^2, so their squared
/// sum is exponential with mean 4 sigma_0^2/tau^2. Of an anisotropic surface the mean over azimuths psi of
/// exp(-1/(4 sigma_0^2 (cos^2 psi/tau_x^2 + sin^2 psi/tau_y^2))), by as many azimuths as 1e-9 needs
/// for lengths up to 1 : 10.
[[nodiscard]] double share_beyond_45_degrees(const Surface& surface) noexcept;

/// Radius of the rms curvature, tau^2/(2 sqrt(3) sigma_0) [um]; infinite for a mirror. Derivation: the
/// variance of the second derivative along any one direction is C''''(0) = 12 sigma_0^2/tau^4 (heights
/// Gaussian, C = exp(-r^2/tau^2)), and where slopes are gentle that derivative is the
/// curvature [Tsang00 (9.4.17)].
[[nodiscard]] double curvature_radius(const Surface& surface) noexcept;

// ---- regimes

/// How much of the sum for Phi a phase variance needs, so that at most regime_error of the reflected light
/// goes to the wrong place.
enum class Regime {
    smooth,       ///< a mirror: 1 - exp(-g), the light in the lobe, may be left out
    first_order,  ///< one term, g exp(-g - t): the terms behind carry 1 - exp(-g) (1 + g)
    full,         ///< the whole sum
    rough,        ///< the geometric limit exp(-t/g)/g, Beckmann's lobe: it misplaces 0.62/g of the lobe
};
inline constexpr double regime_error = 0.01;

/// Greatest g of smooth and of first_order, least g of rough: where the shares above are regime_error.
inline constexpr double most_smooth_g = 0.010050;
inline constexpr double most_first_order_g = 0.14855;
inline constexpr double least_rough_g = 62;

///   phase_variance   g, 0 or more; `PairFactors::phase_variance`
[[nodiscard]] Regime regime(double phase_variance) noexcept;
/// "smooth", "first order", "full", "rough limit".
[[nodiscard]] std::string_view name(Regime regime) noexcept;

// ---- criteria

enum class Criterion {
    correlation_length,  ///< tau/lambda, at least
    curvature,           ///< k R cos^3 theta_d, R the curvature_radius, at least
    slope,               ///< sigma_0/tau, at most
    shadowing,           ///< S_1 of the more grazing of the two directions, at least
    mirror,              ///< share of the light that the specular term loses to shadowing alone,
                         ///< exp(-g) (1 - S) at theta_i, at most
    energy,              ///< a + |F(theta_i)|^2, at most
};
inline constexpr std::size_t criterion_count = 6;

/// "correlation length", "curvature", …
[[nodiscard]] std::string_view name(Criterion criterion) noexcept;
/// What is measured: "tau/lambda", "k R cos^3(theta_d)", …
[[nodiscard]] std::string_view quantity(Criterion criterion) noexcept;
/// What goes wrong beyond the limits, one sentence without a full stop.
[[nodiscard]] std::string_view reason(Criterion criterion) noexcept;

enum class Severity { fine, caution, outside };

/// "fine", "caution", "outside".
[[nodiscard]] std::string_view name(Severity severity) noexcept;

/// Where a criterion turns to caution and to outside. Fine between infinity and `caution` where caution >
/// outside, between -infinity and `caution` where caution < outside.
struct Limits {
    double caution, outside;

    /// Whether smaller is worse.
    [[nodiscard]] bool least() const noexcept { return caution > outside; }
    [[nodiscard]] Severity severity(double measured) const noexcept;
};

/// Limits, with their origin ("exact": the method of moments for 1-D rough, perfectly conducting surfaces,
/// each 50 wavelengths long, 250 realisations, from `hts truth moments`, kept in validation/scattering/data/;
/// dB of the scattered intensity, unpolarised, rms over the scattering angles weighted with energy):
///   correlation_length   caution 1: 0.1 to 0.9 dB from exact at tau = lambda, sigma_0/tau <= 1/4, up to 60
///                        deg. outside 1/2: 1 dB at 0.35 lambda, 1.1 to 2.8 dB in TE and TM alone
///   curvature            "the radius of curvature large compared to the wavelength" [He91 2.2]; cos^3 since
///                        neighbours act in phase over a length 2/(k cos^2 theta_d), along which the surface
///                        turns by that over R, to be small beside the grazing angle's cos theta_d [Fock65].
///                        caution 2 pi: R is a wavelength at theta_d = 0. outside 1: nothing is large
///   slope                caution 1/4: rms slope 19 deg; above it exact differs by 1.2 to 2.1 dB at 60 deg,
///                        where Smith's shadowing of correlated heights would differ by 0.2 to 0.5 dB.
///                        outside 1/sqrt(2): rms slope 1, no gentle one
///   shadowing            caution 0.95: above it a lossless surface (tau >= lambda, sigma_0/tau <= 1/4)
///                        returns its light within 1 dB. outside 0.75: below it each such surface loses more
///                        than 1 dB (both by quadrature, in the tests)
///   mirror               caution 0.3 dB, a typical error of the model; outside 1 dB. A real surface turns
///                        into a mirror at grazing; the model's is shadowed instead
///   energy               caution 1: the terms together may reflect more than falls in. There is no outside,
///                        since the sum overestimates what the lobe of a rough surface reflects. Mirror and
///                        lobe alone pass 1 by some 4 % (|F| = 1, tau = lambda, sigma_0/tau =
///                        0.05 to 0.1, 70 to 80 deg)
[[nodiscard]] Limits limits(Criterion criterion) noexcept;

struct Finding {
    Criterion criterion;
    double measured;

    [[nodiscard]] Severity severity() const noexcept { return limits(criterion).severity(measured); }
};

// ---- verdicts

/// Distance of the model from exact scattering, by what has been computed of it (see `limits`): the least and
/// the greatest over the perfectly conducting 1-D surfaces of the map, up to 70 degrees, unpolarised. For
/// others a guide. A test in validation/ holds these numbers against the map.
enum class ModelError {
    none,     ///< sigma_0 = 0: Fresnel's equations
    best,     ///< 0 to 1.1 dB, half of them below 0.15: tau >= 2 lambda, nothing to be cautious of
    good,     ///< 0.1 to 2.1 dB, half of them below 0.7: tau >= lambda, or a caution
    between,  ///< 0.2 to 1 dB: 0.35 lambda < tau < lambda
    poor,     ///< 1 dB, but 1.1 to 2.4 in TE and TM alone: tau <= 0.35 lambda
    unknown,  ///< a criterion other than the correlation length says outside
};

struct Decibels {
    double least, most;
};
/// In numbers; none if unknown.
[[nodiscard]] std::optional<Decibels> decibels(ModelError error) noexcept;

/// The verdict on one evaluation.
struct Validity {
    double phase_variance;                          ///< g of the pair
    std::array<Finding, criterion_count> findings;  ///< in the order of Criterion, fine ones too
    ModelError error;
    /// tau < lambda/2 and sigma_0 < lambda/10: first-order perturbation theory would do better.
    bool perturbation_advised;

    [[nodiscard]] const Finding& operator[](Criterion criterion) const noexcept {
        return findings[static_cast<std::size_t>(criterion)];
    }
    /// The worst of the findings.
    [[nodiscard]] Severity severity() const noexcept;
};

/// Verdict on a surface at a pair of directions and a wavelength.
///   cost   less than an evaluation of the pair; allocates nothing
[[nodiscard]] Validity validity(const Surface& surface, const DirectionPair& pair,
                                const SpectralSample& sample) noexcept;
/// The same from views of this surface.
[[nodiscard]] Validity validity(const Surface& surface, const View& in, const View& out,
                                const SpectralSample& sample) noexcept;

/// Verdicts on a surface over wavelengths and angles of incidence, each in its mirror direction, which among
/// all pairs of directions that reach up to an angle is the worst: theta_d <= (theta_i +
/// theta_r)/2, and S_1 falls.
class MaterialValidity {
  public:
    struct Point {
        SpectralSample sample;
        Direction in;
        Validity validity;
    };

    ///   samples     what the surface is at each wavelength, Reflectance::samples
    ///   incidence   at least one direction, else hts::Error
    MaterialValidity(const Surface& surface, std::span<const SpectralSample> samples,
                     std::span<const Direction> incidence);

    /// All angles of the first wavelength, then of the next.
    [[nodiscard]] std::span<const Point> points() const noexcept { return points_; }
    /// The point where a criterion is measured worst.
    [[nodiscard]] const Point& worst(Criterion criterion) const noexcept;
    [[nodiscard]] Severity severity() const noexcept;
    [[nodiscard]] ModelError error() const noexcept;
    [[nodiscard]] bool perturbation_advised() const noexcept;

  private:
    std::vector<Point> points_;
};

}  // namespace hts::spectral
