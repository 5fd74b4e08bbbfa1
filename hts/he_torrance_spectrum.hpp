/// The three terms of one surface at several wavelengths, prepared once for many fast evaluations.
///
/// At a tolerance of 1e-6 or coarser all runs in vector lanes, which are wavelengths for one pair of
/// directions and pairs for many, chosen by the processor at run time; a BRDF at 1e-3 or coarser in single
/// precision (evaluation/single_precision.hpp). Finer tolerances, extreme lengths or indices, grazing within
/// lowest_cosine and the other limit of a correlation that is not Gaussian take the exact path of terms.hpp.
///
/// Where there are films the lanes compute the lobe of facets that reflect everything, and the films'
/// reflectance multiplies it, from a table over cos theta_d for each wavelength (amplitudes to 1e-10);
/// one by one where no table of bounded size would do.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hts/terms.hpp"
#include "hts/tolerance.hpp"

namespace hts {

struct ScatteringLobe;

namespace accuracy {
/// The coarser tolerances; finer ones give accuracy::brdf.
inline constexpr double finest_lane_tolerance = 1e-6;
}  // namespace accuracy

/// Light from `in` seen from `out`.
struct DirectionPair {
    Direction in, out;
};

/// What a reflector is at one wavelength.
struct SpectralSample {
    Wavelength wavelength;
    CoatedIndex index;
    double uniform_diffuse;  ///< BRDF [1/sr], see hts::uniform_diffuse
};

/// Surface, optical constants at each wavelength, and tolerance.
///
///     const hts::HeTorranceSpectrum prepared{surface, samples, hts::Tolerance{1e-6}};
///     std::vector<double> spectrum(samples.size());
///     prepared.brdf({in, out}, spectrum);
///
/// Every call is const, allocates nothing and may run on any thread. A pair's result has the same bits alone,
/// in any batch and at any place in it.
class HeTorranceSpectrum {
  public:
    ///   tolerance   of the arithmetic; what a limit neglects comes on top. Of a correlation that is not
    ///               Gaussian the lobe has the error of its table, accuracy::correlation_lobe, at best
    /// Throws hts::Error where such a correlation is asked for the rough limit, or its table does
    /// not reach sigma_0/lambda.
    HeTorranceSpectrum(const Surface& surface, std::vector<SpectralSample> samples, Tolerance tolerance = {},
                       DiffuseLobe lobe = DiffuseLobe::full);
    ~HeTorranceSpectrum();
    HeTorranceSpectrum(const HeTorranceSpectrum& other);
    HeTorranceSpectrum(HeTorranceSpectrum&& other) noexcept;
    HeTorranceSpectrum& operator=(HeTorranceSpectrum other) noexcept;

    [[nodiscard]] const Surface& surface() const noexcept { return surface_; }
    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept { return samples_; }
    [[nodiscard]] Tolerance tolerance() const noexcept { return tolerance_; }
    [[nodiscard]] DiffuseLobe lobe() const noexcept { return lobe_; }
    /// Memory of this object alone; the table of Phi, phi_table_bytes(tolerance()), is shared by all.
    [[nodiscard]] std::size_t bytes() const noexcept;

    // Each call throws hts::Error where `result` has another size than it says, and nothing else.

    /// BRDF of the directional and uniform diffuse terms together [1/sr], one value per sample.
    ///   result   samples().size() values
    ///   error    relative, the tolerance or accuracy::brdf, above 1e-280; in single precision above 1e-30
    void brdf(const DirectionPair& pair, std::span<double> result) const;
    /// The same for many pairs, all samples of a pair together, on the calling thread.
    ///   result   pairs.size() * samples().size() values
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;
    /// Reflectance into the mirror direction, the specular term [1], one value per sample.
    ///   result   samples().size() values
    ///   error    relative, at most the tolerance, above 1e-280;
    ///            accuracy::specular_reflectance where that is more
    void specular_reflectance(const Direction& in, std::span<double> result) const;
    /// Mueller matrix of both terms [1/sr], one per sample.
    ///   result   samples().size() matrices
    ///   error    of each element relative to element 00, as of brdf
    void mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    /// Mueller matrix of the specular term [1], one per sample.
    ///   result   samples().size() matrices
    void specular_mueller(const Direction& in, std::span<Mueller> result) const;

    /// What a pair contributes at a sample, and at all where the correlation is Gaussian.
    [[nodiscard]] PairFactors factors(const DirectionPair& pair, std::size_t sample) const noexcept {
        return {surface_, view(seen(sample), pair.in), view(seen(sample), pair.out)};
    }
    /// What a sampler of the first sample is fitted to.
    [[nodiscard]] ScatteringLobe scattering_lobe() const;

  private:
    struct Lanes;
    void add_films(const DirectionPair& pair, std::span<double> result) const noexcept;
    void exact_brdf(const DirectionPair& pair, std::span<double> result) const noexcept;
    void exact_specular_reflectance(const Direction& in, std::span<double> result) const noexcept;
    void exact_mueller(const DirectionPair& pair, std::span<Mueller> result) const noexcept;

    /// What a sample sees of the surface.
    [[nodiscard]] const Surface& seen(std::size_t sample) const noexcept {
        return seen_.empty() ? surface_ : seen_[sample];
    }

    Surface surface_;
    std::vector<Surface> seen_;  // by each sample, where the correlation is not Gaussian
    std::vector<SpectralSample> samples_;
    Tolerance tolerance_;
    DiffuseLobe lobe_;
    std::unique_ptr<const Lanes> lanes_;  // null where the exact path takes everything
};

}  // namespace hts
