/// The model in single precision for renderers: unit vectors in, spectra of floats out, evaluated and drawn
/// in one place.
///
/// Conventions of direction.hpp: z is the outward normal, and both vectors point away from the surface, so
/// `in` leads to the light and `out` to the viewer, or the other way about: the BRDF is reciprocal.
///
/// Lanes hold 16 floats of AVX-512, 8 of AVX2, 4 of SSE4 and NEON. HeTorranceSpectrum takes the same lanes
/// at tolerances of accuracy::single_precision_brdf and coarser. What single precision does not hold
/// (lengths outside 0.001 to 10 000 um, wavelengths outside 0.05 to 1000 um, indices above 1000, total
/// reflection without absorption, correlations that are not Gaussian, a cosine below 1.1e-5) is computed in
/// double precision and rounded.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "hts/evaluation/single_precision.hpp"
#include "hts/sampling/lobe_sampler.hpp"

namespace hts {

/// A direction drawn for all wavelengths.
struct SpectralDraw {
    Vector3f out;  ///< the mirror direction of a specular draw and of none
    float pdf;  ///< of all diffuse lobes together [1/sr]; of a specular draw its probability [1]; 0 of none
    Lobe lobe;
};

/// A rough surface at some wavelengths, immutable; copies share what they hold. Calls may run on any thread
/// and allocate nothing, but for more than 64 wavelengths where double precision takes over. They throw
/// hts::Error where `result` has another size than said, and nothing else.
class HeTorranceSingle {
  public:
    HeTorranceSingle(const Surface& surface, std::vector<SpectralSample> samples,
                     DiffuseLobe lobe = DiffuseLobe::full);

    /// Number of wavelengths.
    [[nodiscard]] std::size_t size() const noexcept;

    /// BRDF of the diffuse terms [1/sr], one value per wavelength; 0 on and below the horizon.
    ///   result   size() values
    ///   error    accuracy::single_precision_brdf above accuracy::single_precision_floor, below it absolute
    void brdf(const Vector3f& in, const Vector3f& out, std::span<float> result) const;
    /// The same for many pairs, all wavelengths of a pair together, on the calling thread; the same bits in
    /// any batch.
    ///   result   pairs.size() * size() values
    void brdf(std::span<const VectorPair> pairs, std::span<float> result) const;
    /// Reflectance into the mirror direction [1].
    ///   result   size() values
    void specular_reflectance(const Vector3f& in, std::span<float> result) const;

    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept;

  private:
    struct Data;
    std::shared_ptr<const Data> data_;
};

/// The same with a sampler: what a path tracer asks of a material.
///
///     const hts::HeTorranceRendering metal{surface, samples};
///     std::vector<float> f(metal.size());
///     const float pdf = metal.brdf_and_pdf(light, view, f);  // for multiple importance sampling
///     const hts::SpectralDraw drawn = metal.sample(view, {u0, u1, u2, u3}, f);
///
/// Directions are drawn for one of three wavelengths, a sixth, half and five sixths of the way through the
/// list, and the density is the mean of the three, so that no wavelength's weight runs away.
class HeTorranceRendering : public HeTorranceSingle {
  public:
    ///   cost   three samplers, some 30 ms each
    HeTorranceRendering(const Surface& surface, const std::vector<SpectralSample>& samples);

    /// Density in solid angle of `sample` drawing `out` from a diffuse lobe [1/sr]; 0 on and below the
    /// horizon.
    [[nodiscard]] float pdf(const Vector3f& in, const Vector3f& out) const noexcept;
    /// Both at once.
    [[nodiscard]] float brdf_and_pdf(const Vector3f& in, const Vector3f& out, std::span<float> result) const;
    /// Draws a direction and evaluates it.
    ///   u        four numbers in [0, 1); the last chooses one of the three wavelengths
    ///   result   size() values: the BRDF [1/sr] of a diffuse draw, whose weight is BRDF cos theta_out / pdf;
    ///            the reflectance [1] of a specular one, whose weight is reflectance / pdf; 0 of none
    [[nodiscard]] SpectralDraw sample(const Vector3f& in, const std::array<float, 4>& u,
                                      std::span<float> result) const;
    /// Probability of the specular lobe [1].
    [[nodiscard]] float specular_probability(const Vector3f& in) const noexcept;

  private:
    std::vector<LobeSampler> samplers_;
};

}  // namespace hts
