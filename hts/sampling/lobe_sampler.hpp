/// Draws directions from a rough surface in proportion to what it reflects, with the density that draws have.
///
/// The three terms are lobes to choose from: the specular term, the directional-diffuse lobe and
/// the uniform-diffuse one, each with a probability near its share of the albedo. The directional-diffuse
/// term is drawn from a mixture of simple densities, all normalised in closed form, so that the density
/// returned is that of the draw itself, to rounding. In the frame where the light is (s, 0, c), with q the
/// slopes of the facet that mirrors the light into the drawn direction, q = v_xy/v_z, and x = |q|^2/alpha^2:
///
///   lowered facets   exp(-x)/(pi alpha^2) (1 - q_x (1 - s)/c)     Beckmann's slopes [Walter07
///                    (25)], as many towards the
///                                            view as Fresnel's rise at grazing wants
///   raised facets    exp(-x)/(pi alpha^2) (1 + q_x (1 + s)/c)     towards the light; half of each
///                    makes 1 + q_x tan theta_i,
///                                            the slopes weighted by their area as the light sees it
///   grazing facets   2 q_x exp(-x)/(sqrt(pi) alpha^3), q_x > 0     these weighted slopes at grazing light
///   beam             v_xy normal, variance 2 m/tau^2 per axis     one term of Phi's Poisson sum [He91 (78)]
///   cosine           c_r/pi (1 + s sin theta_r cos phi)           light scattered back
///                    by very short correlation
///   uniform          1/(2 pi)                                     the defence that bounds every weight
///
/// In (1 + q_x a) values outside 0 ... 2 are moved to the nearer end, and where the facet of -q_x mirrors to
/// below the horizon the bracket is 2: p(q) + p(-q) stays 2, so every such density is normalised, whatever a,
/// and few draws are lost; likewise the beam's across its centre. Facets come in three widths each, alpha^2
/// halved or doubled; alpha follows the mean m of Phi's Poisson sum. Drawing Phi's own terms instead would
/// put a Phi, some 20 ns, into every density.
///
/// Of an anisotropic surface every normal density is that of stretched coordinates, S q or S v with S =
/// (tau_x/tau, tau_y/tau) along the axes: variances per axis 2 m/tau_x^2 and 2 m/tau_y^2, ellipses in place
/// of circles; the other of each pair is -q or -v. Then each of six parts of a right angle between light and
/// axis has shares of its own.
///
/// Shares, alpha and skews are constant in each of 66 intervals of cos theta_i, eighths of octaves, so that a
/// density reads one row of numbers; the shares are found at construction as those of the least
/// variance of brdf cos/pdf.
#pragma once

#include <cstddef>
#include <memory>

#include "hts/microfacet/model.hpp"
#include "hts/sampling/scattering_lobe.hpp"

namespace hts {

namespace accuracy {
/// Of `LobeSampler::pdf`, relative, for sigma_0/tau >= 0.005 and above 1e-280: rounding alone.
inline constexpr double pdf = 5e-12;
}  // namespace accuracy

/// A fitted sampler; copies share what they hold. Every call is const, allocates nothing, takes bounded time
/// and may run on any thread; the same numbers give the same direction.
class LobeSampler {
  public:
    ///   cost   some 30 ms, six times as much of an anisotropic surface
    explicit LobeSampler(const ScatteringLobe& lobe);

    /// Draws a direction; the weight is NaN, but 0 of none.
    [[nodiscard]] Draw draw(const Direction& in, const Uniforms& u) const noexcept;
    /// Density in solid angle of drawing `out` from a diffuse lobe [1/sr], whichever it was.
    ///   range   >= 0; 0 on and below the horizon. Its integral, the probabilities of the specular
    ///           lobe and of none add up to 1
    ///   error   accuracy::pdf
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    /// Probability of the specular lobe [1].
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept;
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    struct Fitted;
    std::shared_ptr<const Fitted> fitted_;
};

}  // namespace hts
