/// A material at wavelengths: evaluates, samples and integrates. Everything that reflects becomes one: a
/// model, a lookup table, a measured file, a plan.
///
///     const Reflectance reflectance = material.at(wavelengths, {.tolerance = Tolerance{1e-9}});
///     std::vector<double> spectrum(reflectance.size());
///     reflectance.brdf({in, out}, spectrum);  // allocates nothing
///
/// Conventions of directions in hts/direction.hpp, of Stokes vectors and frames in hts/polarisation.hpp. What
/// does not depend on wavelength is computed once per pair of directions; spectra come in the grid's order.
/// One contract for sizes: a span that does not hold what the call says is a hts::Error that names both
/// numbers. So is a pair that measured data do not reach, unless the options said what
/// stands there (OutsideRange).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "spectral/models/evaluator.hpp"

namespace hts::spectral {

/// Draws directions at one wavelength, as Reflectance::sampler makes it. Copies share what they hold; calls
/// are total, allocate nothing and may run on any thread.
class Sampler {
  public:
    explicit Sampler(std::shared_ptr<const DirectionSampler> sampler) : sampler_{std::move(sampler)} {}

    /// As in DirectionSampler.
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        return sampler_->pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept {
        return sampler_->sample(in, uniforms);
    }
    [[nodiscard]] Draw draw(const Direction& in, const Uniforms& uniforms) const noexcept {
        return sampler_->draw(in, uniforms);
    }
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept {
        return sampler_->specular_probability(in);
    }

  private:
    std::shared_ptr<const DirectionSampler> sampler_;
};

/// Immutable; copies share what they hold. Any thread may call.
class Reflectance {
  public:
    ///   evaluator   not null
    ///   cost        where it is not known whether it is isotropic, 128 evaluations
    explicit Reflectance(std::shared_ptr<const Evaluator> evaluator);

    [[nodiscard]] const std::string& name() const noexcept { return evaluator_->name(); }
    [[nodiscard]] const WavelengthGrid& wavelengths() const noexcept { return evaluator_->wavelengths(); }
    /// Number of wavelengths.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] const Properties& properties() const noexcept { return properties_; }
    /// hts::Error that names pair and measured range if data end before the pair and the options said error.
    void require_known(const DirectionPair& pair) const {
        if (properties_.partial && !evaluator_->knows(pair)) refuse_pair(pair);
    }
    /// Memory of this object alone, not of tables that several share; 0 where not known.
    [[nodiscard]] std::size_t bytes() const noexcept { return evaluator_->bytes(); }
    /// What a rough surface is at each wavelength; empty for others.
    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept { return evaluator_->samples(); }
    /// What is evaluated: the same calls without checks of sizes, for a caller's own loops and threads.
    [[nodiscard]] const Evaluator& evaluator() const noexcept { return *evaluator_; }

    /// BRDF of all diffuse terms, unpolarised [1/sr], one value per wavelength, without the cosine.
    [[nodiscard]] std::vector<double> brdf(const DirectionPair& pair) const;
    /// The same into size() values.
    void brdf(const DirectionPair& pair, std::span<double> result) const {
        require_size("brdf", result.size(), 1);
        require_known(pair);
        evaluator_->brdf(pair, result);
    }
    /// The same for many pairs, into pairs.size() * size() values, all wavelengths of a pair together. Runs
    /// on all cores; the same bits for any number of threads.
    void brdf(std::span<const DirectionPair> pairs, std::span<double> result) const;
    /// Its part that is the same for all directions above the horizon [1/sr].
    [[nodiscard]] std::vector<double> uniform_diffuse() const;
    void uniform_diffuse(std::span<double> result) const;
    /// The rest, the lobe [1/sr].
    [[nodiscard]] std::vector<double> directional_diffuse(const DirectionPair& pair) const;
    void directional_diffuse(const DirectionPair& pair, std::span<double> result) const;
    /// Reflectance into the mirror direction, one per wavelength; 0 without a specular term.
    [[nodiscard]] std::vector<SpecularReflectance> specular_reflectance(const Direction& in) const;
    void specular_reflectance(const Direction& in, std::span<double> result) const;

    /// Mueller matrices of the diffuse terms [1/sr], of the lobe alone [1/sr], and of the specular term [1],
    /// one per wavelength; hts::Error unless properties().polarised.
    [[nodiscard]] std::vector<Mueller> mueller(const DirectionPair& pair) const;
    void mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    [[nodiscard]] std::vector<Mueller> directional_diffuse_mueller(const DirectionPair& pair) const;
    void directional_diffuse_mueller(const DirectionPair& pair, std::span<Mueller> result) const;
    [[nodiscard]] std::vector<Mueller> specular_mueller(const Direction& in) const;
    void specular_mueller(const Direction& in, std::span<Mueller> result) const;

    /// Whether light passes through the surface at a wavelength.
    [[nodiscard]] bool transmits(std::size_t wavelength) const;
    /// Radiance that leaves along pair.out, behind the surface, per irradiance from pair.in [1/sr], one value
    /// per wavelength; see hts::TransmittingModel. 0 where the surface is opaque.
    [[nodiscard]] std::vector<double> btdf(const DirectionPair& pair) const;

    /// Directional-hemispherical reflectance by term at one of the wavelengths.
    ///   error   accuracy::hemispherical_reflectance for rough surfaces, else the tolerance asked for, or
    ///           hts::accuracy::directional_albedo if that is more
    ///   cost    1 to 100 ms; at the finest tolerance some seconds of models that interpolate in tables
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in, std::size_t wavelength) const;
    /// The same of light in a state of polarisation; hts::Error unless properties().polarised. By Kirchhoff's
    /// law 1 less the total is the emissivity towards `in`, behind a polariser that passes this state.
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in, std::size_t wavelength,
                                                  const Stokes& light) const;
    /// Draws directions at one of the wavelengths; hts::Error where nobody knows how.
    ///   cost   some 30 ms of a rough surface
    [[nodiscard]] Sampler sampler(std::size_t wavelength) const;

  private:
    void require_size(const char* call, std::size_t size, std::size_t pairs) const {
        if (size != pairs * size_) refuse_size(call, size, pairs);
    }
    [[noreturn]] void refuse_size(const char* call, std::size_t size, std::size_t pairs) const;
    [[noreturn]] void refuse_pair(const DirectionPair& pair) const;
    void require_polarised() const;
    void require_wavelength(std::size_t wavelength) const;

    std::shared_ptr<const Evaluator> evaluator_;
    std::size_t size_;
    Properties properties_;
};

}  // namespace hts::spectral
