/// The three terms of he_unified (unified_terms.hpp) for one surface at several wavelengths, prepared
/// once for many evaluations.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"
#include "hts/unified/second_order_mirror.hpp"
#include "hts/unified/unified_choices.hpp"
#include "hts/unified/unified_terms.hpp"

namespace hts {

/// hts::Error for choices that no theory extends to films: the second-order mirror, the mixing of
/// polarisations and the shortcut of conductors.
void require_theory_of_films(const UnifiedChoices& choices);

/// Surface, optical constants at each wavelength, tolerance and choices; the calls are
/// those of HeTorranceSpectrum.
///
///     const hts::HeUnifiedSpectrum prepared{surface, samples, hts::Tolerance{1e-6}};
///     std::vector<double> spectrum(samples.size());
///     prepared.brdf({in, out}, spectrum);
///
/// At a tolerance of 1e-6 or coarser the lobe runs in vector lanes, as that of HeTorranceSpectrum does, and
/// where that takes the exact path so does this; so it does where only some of the wavelengths have films.
/// Under films the lanes have all but the Jones matrix, which comes from tables of amplitudes and fields
/// over the angles. Every call is
/// const, allocates nothing and may run on any thread. A pair's result has the same bits alone, in any
/// batch and at any place in it.
class HeUnifiedSpectrum {
  public:
    /// hts::Error for films with choices that have no theory of them, require_theory_of_films, and for
    /// conductor_shortcut where the flat surface reflects less than accuracy::least_of_conductors.
    HeUnifiedSpectrum(const Surface& surface, std::vector<SpectralSample> samples, Tolerance tolerance = {},
                      DiffuseLobe lobe = DiffuseLobe::full, const UnifiedChoices& choices = {});

    [[nodiscard]] const Surface& surface() const noexcept { return surface_; }
    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept { return samples_; }
    [[nodiscard]] Tolerance tolerance() const noexcept { return tolerance_; }
    [[nodiscard]] DiffuseLobe lobe() const noexcept { return lobe_; }
    [[nodiscard]] const UnifiedChoices& choices() const noexcept { return choices_; }
    /// Memory of this object alone.
    [[nodiscard]] std::size_t bytes() const noexcept;

    // Each call throws hts::Error where `result` has another size than it says, and nothing else.

    /// BRDF of the directional and uniform diffuse terms together [1/sr], one value per sample; with
    /// conductor_shortcut not quite element 00 of `mueller`.
    ///   error   relative, at most the tolerance, above 1e-280; accuracy::unified_brdf where that is more
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// The same for many pairs, all samples of a pair together, on the calling thread.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;
    /// Reflectance into the mirror direction, the specular term [1], one value per sample.
    ///   error   accuracy::unified_mirror, in lanes accuracy::unified_mirror_in_lanes
    void specular_reflectance(const Direction& in, std::span<double> result) const;
    /// Mueller matrix of both diffuse terms [1/sr], one per sample.
    ///   error    of each element relative to element 00, as of brdf
    void mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    /// Mueller matrix of the specular term [1], one per sample.
    void specular_mueller(const Direction& in, std::span<Mueller> result) const;

    /// What a direction contributes, for unified_lobe.
    ///   sample   that it is asked for, which matters where the correlation is not Gaussian
    [[nodiscard]] UnifiedView view(const Direction& direction, std::size_t sample = 0) const noexcept {
        if (seen_.empty()) return {surface_, return_factor_, direction};
        return {seen_[sample].surface, seen_[sample].return_factor, direction};
    }
    [[nodiscard]] std::span<const UnifiedWave> waves() const noexcept { return waves_; }
    /// The directional-diffuse term of unpolarised light [1/sr], with conductor_shortcut by it.
    ///   lobe_argument   as of unified_lobe
    [[nodiscard]] double unpolarised_lobe(const UnifiedView& in, const UnifiedView& out, std::size_t sample,
                                          std::optional<double> lobe_argument = {}) const noexcept;
    /// What a sampler of the first sample is fitted to.
    [[nodiscard]] ScatteringLobe scattering_lobe() const;

  private:
    struct Lanes;
    void exact_brdf(const DirectionPair& pair, std::span<double> result) const noexcept;
    void exact_mueller(const DirectionPair& pair, std::span<Mueller> result) const noexcept;
    [[nodiscard]] FresnelAmplitudes mirror(const Direction& in, std::size_t sample) const noexcept;

    struct Seen {
        Surface surface;
        ReturnFactor return_factor;
    };

    Surface surface_;
    std::vector<Seen> seen_;  // by each sample, where the correlation is not Gaussian
    std::vector<SpectralSample> samples_;
    Tolerance tolerance_;
    DiffuseLobe lobe_;
    UnifiedChoices choices_;
    ReturnFactor return_factor_;
    double mixed_;
    std::vector<UnifiedWave> waves_;
    std::vector<UnifiedWave> conductors_;     // the same with a perfect conductor's index, for the shortcut
    std::vector<SecondOrderMirror> mirrors_;  // none where the closed form is asked for
    std::shared_ptr<const Lanes> lanes_;      // null where the exact path takes everything
};

}  // namespace hts
