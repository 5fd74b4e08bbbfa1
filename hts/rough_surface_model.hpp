/// A model of a rough surface at one wavelength as a value: evaluated, and drawn from in proportion to
/// what the surface reflects.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "hts/sampling/lobe_sampler.hpp"

namespace hts {

/// Evaluator and sampler of one wavelength: a ReflectanceModel.
///
///     const hts::HeTorrance model{surface, {wavelength, index, uniform_diffuse}};
///     const double f = model.brdf(in, out);                  // 1/sr
///     const Draw drawn = model.sample(in, {u0, u1, u2});     // mean weight: the albedo
///
/// For a spectrum draw at one wavelength, `draw`, and divide the BRDF of every wavelength, times cos theta_r,
/// by that pdf (for a specular draw the specular reflectance of every wavelength).
/// Every call is const, allocates nothing, takes bounded time and may run on any thread; the same numbers
/// give the same direction. Construction fits the sampler, some 30 ms: who only evaluates takes the Spectrum.
///   Spectrum   HeTorranceSpectrum or HeUnifiedSpectrum
template <class Spectrum>
class RoughSurfaceModel {
  public:
    ///   spectrum   of one wavelength; its tolerance is that of every value and of the weights
    explicit RoughSurfaceModel(Spectrum spectrum)
        : spectrum_{std::move(spectrum)}, sampler_{spectrum_.scattering_lobe()} {}
    ///   tolerance   of brdf, specular_reflectance, mueller and the weights, relative
    RoughSurfaceModel(const Surface& surface, const SpectralSample& sample, Tolerance tolerance = {})
        : RoughSurfaceModel{Spectrum{surface, {sample}, tolerance}} {}

    /// Both diffuse terms [1/sr].
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        double value = 0;
        spectrum_.brdf({in, out}, {&value, 1});
        return value;
    }
    /// Reflectance into the mirror direction.
    [[nodiscard]] SpecularReflectance specular_reflectance(const Direction& in) const noexcept {
        double value = 0;
        spectrum_.specular_reflectance(in, {&value, 1});
        return SpecularReflectance{value};
    }
    /// Mueller matrix of both diffuse terms [1/sr], and that of the specular term [1].
    [[nodiscard]] Mueller mueller(const Direction& in, const Direction& out) const noexcept {
        Mueller value;
        spectrum_.mueller({in, out}, {&value, 1});
        return value;
    }
    [[nodiscard]] Mueller specular_mueller(const Direction& in) const noexcept {
        Mueller value;
        spectrum_.specular_mueller(in, {&value, 1});
        return value;
    }

    /// Draws a direction with its weight. The mean of the weights is the
    /// directional-hemispherical reflectance.
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        Draw drawn = draw(in, u);
        if (drawn.lobe == Lobe::none) return drawn;
        const double value = drawn.lobe == Lobe::specular ? specular_reflectance(in).value()
                                                          : brdf(in, drawn.out) * drawn.out.cos_theta();
        drawn.weight = value / drawn.pdf;
        return drawn;
    }
    /// The same without an evaluation: the weight is NaN, but 0 of none.
    [[nodiscard]] Draw draw(const Direction& in, const Uniforms& u) const noexcept {
        return sampler_.draw(in, u);
    }
    /// Density in solid angle of drawing `out` from a diffuse lobe [1/sr], whichever
    /// it was: LobeSampler::pdf.
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        return sampler_.pdf(in, out);
    }
    /// Probability of the specular lobe [1].
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept {
        return sampler_.specular_probability(in);
    }

    [[nodiscard]] const Surface& surface() const noexcept { return spectrum_.surface(); }
    [[nodiscard]] const Spectrum& spectrum() const noexcept { return spectrum_; }
    [[nodiscard]] std::size_t bytes() const noexcept { return spectrum_.bytes() + sampler_.bytes(); }

  private:
    Spectrum spectrum_;
    LobeSampler sampler_;
};

}  // namespace hts
