/// What a Reflectance evaluates: the interface that models, lookup tables, measured
/// files and plans implement.
///
/// Programs use spectral/models/reflectance.hpp. This page is for who adds something that reflects; a
/// hts::ReflectanceModel needs no evaluator of its own: model_evaluator.hpp makes one.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"
#include "hts/microfacet/model.hpp"
#include "hts/polarisation.hpp"
#include "hts/tolerance.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/energy/rough_surface.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

using hts::DirectionPair;

/// What can be asked of a material or a reflectance.
struct Properties {
    bool polarised = false;      ///< has Mueller matrices
    bool transmitting = false;   ///< may let light through: see `transmits`
    bool specular_term = false;  ///< may reflect into the mirror direction alone
    bool isotropic = false;      ///< the same when both directions turn together about the normal
    bool partial = false;        ///< only known at some pairs of directions: see `knows`
    /// What its wavelengths stand for where they are channels of a colour, no spectrum:
    /// B, G, R or Z, Y, X or Y.
    std::vector<std::string> channels{};
    /// Statistics of the heights and the theory, where the model is one of a rough surface: then the limits
    /// of DiffuseLobe, tolerances, validity, energy compensation, `samples` and `detail` mean
    /// something. None for others.
    std::optional<RoughSurface> surface{};
};

/// What the lobe of a rough surface is made of at a pair of directions and a wavelength.
struct LobeDetail {
    double phase_variance;       ///< g
    double lobe_argument;        ///< t
    double effective_roughness;  ///< sigma of g [um]: sigma_0 of he_unified
    double shadowing;            ///< S, of he_unified G
    double fresnel;              ///< |F|^2 at theta_d, unpolarised
    PhiMethod method;            ///< which branch computes Phi as exactly as it can be
};

/// Where measured data know a reflectance.
struct MeasuredDomain {
    std::vector<double> theta_i{0, 90};  ///< of the light [deg], each that was measured, or the ends
    /// Every axis in words.
    std::string axes = "theta_i 0 to 90 deg, theta_r 0 to 90 deg, phi 0 to 360 deg";
};

/// Draws directions at one wavelength. Immutable; calls are total, allocate nothing
/// and may run on any thread.
class DirectionSampler {
  public:
    virtual ~DirectionSampler() = default;

    /// Density in solid angle of `sample` drawing `out` from a diffuse lobe [1/sr].
    [[nodiscard]] virtual double pdf(const Direction& in, const Direction& out) const noexcept = 0;
    /// Draws a direction; the mean weight is the albedo. Models without a specular term say
    /// Lobe::uniform_diffuse where that part is all there is, else directional_diffuse, or none.
    [[nodiscard]] virtual Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept = 0;
    /// The same without its weight, which may be NaN, where that is quicker.
    [[nodiscard]] virtual Draw draw(const Direction& in, const Uniforms& uniforms) const noexcept {
        return sample(in, uniforms);
    }
    /// Probability of drawing the mirror direction [1].
    [[nodiscard]] virtual double specular_probability(const Direction& /*in*/) const noexcept { return 0; }
};

/// Immutable. Evaluation is total, allocates nothing and may run on any thread. On the horizon lobes are 0;
/// the uniform-diffuse term stays there of rough surfaces, and is 0 of others. Spans hold what each call
/// says: Reflectance checks them.
class Evaluator {
  public:
    virtual ~Evaluator() = default;

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const WavelengthGrid& wavelengths() const noexcept { return wavelengths_; }
    /// `isotropic` may be left false where it is not known: Reflectance then tries.
    [[nodiscard]] virtual Properties properties() const { return {}; }
    /// Whether the data reach a pair above the horizon; models are known everywhere. What is evaluated
    /// elsewhere is the value at the nearer end.
    [[nodiscard]] virtual bool knows(const DirectionPair& /*pair*/) const noexcept { return true; }
    [[nodiscard]] virtual MeasuredDomain domain() const { return {}; }
    /// Memory of this object alone, not of tables that several share; 0 where not known.
    [[nodiscard]] virtual std::size_t bytes() const noexcept { return 0; }
    /// What a rough surface is at each wavelength; empty for others.
    [[nodiscard]] virtual std::span<const SpectralSample> samples() const noexcept { return {}; }

    /// BRDF of all diffuse terms, unpolarised [1/sr], one value per wavelength, without the cosine.
    virtual void brdf(const DirectionPair& pair, std::span<double> values) const noexcept = 0;
    /// The same for many pairs, all wavelengths of a pair together, on the calling thread.
    ///   values   pairs.size() * wavelengths().size()
    virtual void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept;
    /// Its part that is the same for all directions above the horizon [1/sr], one value per
    /// wavelength; 0 where not known.
    virtual void uniform_diffuse(std::span<double> values) const noexcept;
    /// The rest, the lobe [1/sr]: without cancellation also where it is far smaller.
    virtual void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept;
    /// Reflectance into the mirror direction [1], one value per wavelength; 0 without a specular term.
    virtual void specular_reflectance(const Direction& in, std::span<double> values) const noexcept;
    /// Mueller matrices of the diffuse terms [1/sr], one per wavelength; only where polarised.
    virtual void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept;
    /// Those of the lobe alone; the same where the uniform part is not known.
    virtual void directional_diffuse_mueller(const DirectionPair& pair,
                                             std::span<Mueller> values) const noexcept;
    /// Mueller matrices of the specular term [1], one per wavelength; zeros where not known.
    virtual void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept;
    /// Whether light passes through the surface at a wavelength.
    [[nodiscard]] virtual bool transmits(std::size_t wavelength) const noexcept;
    /// Radiance that leaves along pair.out, behind the surface, per irradiance from pair.in [1/sr], see
    /// hts::TransmittingModel; 0 of an opaque surface.
    virtual void btdf(const DirectionPair& pair, std::span<double> values) const noexcept;

    /// What the lobe of a rough surface is made of, by the exact formulas, one per
    /// wavelength; untouched by others.
    virtual void detail(const DirectionPair& pair, std::span<LobeDetail> values) const noexcept;

    /// Directional-hemispherical reflectance by term at one of the wavelengths.
    [[nodiscard]] virtual HemisphericalReflectance albedo(const Direction& in, std::size_t wavelength) const;
    /// The same of polarised light; only where polarised.
    [[nodiscard]] virtual HemisphericalReflectance albedo(const Direction& in, std::size_t wavelength,
                                                          const Stokes& light) const;
    /// Draws at one of the wavelengths; hts::Error where nobody knows how.
    [[nodiscard]] virtual std::shared_ptr<const DirectionSampler> sampler(std::size_t wavelength) const;

  protected:
    ///   tolerance   of `albedo`
    Evaluator(std::string name, WavelengthGrid wavelengths, Tolerance tolerance = Tolerance{});
    Evaluator(const Evaluator&) = default;
    Evaluator(Evaluator&&) = default;
    Evaluator& operator=(const Evaluator&) = default;
    Evaluator& operator=(Evaluator&&) = default;

    [[nodiscard]] Tolerance tolerance() const noexcept { return tolerance_; }

  private:
    std::string name_;
    WavelengthGrid wavelengths_;
    Tolerance tolerance_;
};

}  // namespace hts::spectral
