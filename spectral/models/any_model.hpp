/// Any reflectance model behind one face, at one wavelength or at many, for programs that learn at run time which it is.
///
/// A program that knows its model uses the model's own type (hts/microfacet/, hts/sampling.hpp): it is a plain value, its
/// calls are inlined, and it is a hts::ReflectanceModel. AnyModel is for the edge: `read_any_reflector` gives one for a
/// material file. Besides what the concept asks for it splits off a uniform-diffuse part, holds a specular delta, which is no
/// number (only He-Torrance has one), and so says of each draw which lobe it came from.
#pragma once

#include <algorithm>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"
#include "hts/microfacet/spectrum.hpp"
#include "hts/sampling.hpp"
#include "spectral/energy/energy.hpp"

namespace hts::spectral {

/// A BRDF by parts [1/sr].
struct BrdfTerms {
    double directional_diffuse;
    double uniform_diffuse;  ///< the part that is the same for all directions above the horizon
};

/// An immutable model at one wavelength; copies share it. Calls are total, allocate nothing and may run on any thread.
class AnyModel {
  public:
    ///   uniform_diffuse   part of the model's BRDF that is the same for all directions above the horizon [1/sr]
    template <ReflectanceModel Model>
    explicit AnyModel(Model model, double uniform_diffuse = 0)
        : face_{std::make_shared<const Of<Model>>(std::move(model), uniform_diffuse)} {}

    /// The He-Torrance model. The first draw or density prepares its sampler, some 20 ms.
    [[nodiscard]] static AnyModel he_torrance(const Surface& surface, const SpectralSample& sample);

    /// Both diffuse parts [1/sr], unpolarised.
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return face_->brdf(in, out);
    }
    /// The same by parts; the uniform one is the model's even where the other is 0.
    [[nodiscard]] BrdfTerms terms(const Direction& in, const Direction& out) const noexcept {
        return face_->terms(in, out);
    }
    /// Whether light passes through the surface.
    [[nodiscard]] bool transmits() const noexcept { return face_->transmits(); }
    /// Radiance that leaves along `behind` per irradiance from `in` [1/sr], see hts::TransmittingModel; 0 of an opaque
    /// surface.
    [[nodiscard]] double btdf(const Direction& in, const Direction& behind) const noexcept {
        return face_->btdf(in, behind);
    }
    /// Reflectance into the mirror direction; 0 for models without a delta.
    [[nodiscard]] SpecularReflectance specular_reflectance(const Direction& in) const noexcept {
        return face_->specular_reflectance(in);
    }
    /// Density in solid angle of `sample` drawing `out` from a diffuse lobe [1/sr].
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        return face_->pdf(in, out);
    }
    /// Draws a direction; the mean weight is the albedo. Models without a delta say Lobe::uniform_diffuse where that part
    /// is all there is, else directional_diffuse, or none.
    [[nodiscard]] WeightedDirection sample(const Direction& in, const Uniforms& uniforms) const noexcept {
        return face_->sample(in, uniforms);
    }
    /// Directional-hemispherical reflectance by term.
    ///   error   accuracy::hemispherical_reflectance for He-Torrance, else hts::accuracy::directional_albedo
    ///   cost    1 to 100 ms
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in) const { return face_->albedo(in); }
    /// Memory of the model's own values, without tables and lists that it points to.
    [[nodiscard]] std::size_t bytes() const noexcept { return face_->bytes(); }

  private:
    friend class AnySpectrum;

    /// Models evaluated together.
    struct SpectrumFace {
        virtual ~SpectrumFace() = default;
        virtual void brdf(const DirectionPair& pair, std::span<double> result) const noexcept = 0;
        virtual void directional_diffuse(const DirectionPair& pair,
                                         std::span<double> result) const noexcept = 0;
    };
    struct Face {
        virtual ~Face() = default;
        /// Null where not all models are of the kind of this one.
        [[nodiscard]] virtual std::shared_ptr<const SpectrumFace> together(
            std::span<const AnyModel> models) const = 0;
        [[nodiscard]] virtual double brdf(const Direction& in, const Direction& out) const noexcept = 0;
        [[nodiscard]] virtual bool transmits() const noexcept { return false; }
        [[nodiscard]] virtual double btdf(const Direction& /*in*/,
                                          const Direction& /*behind*/) const noexcept {
            return 0;
        }
        [[nodiscard]] virtual BrdfTerms terms(const Direction& in, const Direction& out) const noexcept = 0;
        [[nodiscard]] virtual SpecularReflectance specular_reflectance(
            const Direction& in) const noexcept = 0;
        [[nodiscard]] virtual double pdf(const Direction& in, const Direction& out) const noexcept = 0;
        [[nodiscard]] virtual WeightedDirection sample(const Direction& in,
                                                       const Uniforms& uniforms) const noexcept = 0;
        [[nodiscard]] virtual HemisphericalReflectance albedo(const Direction& in) const = 0;
        [[nodiscard]] virtual std::size_t bytes() const noexcept = 0;
    };
    template <ReflectanceModel Model>
    class Of;
    class HeTorrance;
    class HeTorranceSpectrum;

    explicit AnyModel(std::shared_ptr<const Face> face) : face_{std::move(face)} {}
    /// Albedo of a whole BRDF less its uniform part.
    [[nodiscard]] static HemisphericalReflectance albedo_of(const Face& face, double uniform_diffuse,
                                                            const Direction& in);

    std::shared_ptr<const Face> face_;
};

/// A model at several wavelengths, which share what depends on directions alone: quicker than each AnyModel by itself. Immutable;
/// copies share it. Calls are total, allocate nothing and may run on any thread.
///
///     const AnySpectrum gold = read_any_reflector("gold.json").spectrum(wavelengths);
///     std::vector<double> f(gold.size());
///     gold.brdf({in, out}, f);
class AnySpectrum {
  public:
    /// Of one kind or of several; those of one kind alone are quicker.
    explicit AnySpectrum(std::vector<AnyModel> models);

    [[nodiscard]] std::size_t size() const noexcept { return models_.size(); }
    /// Each by itself, for what is not a BRDF: draws, densities, transmission.
    [[nodiscard]] const std::vector<AnyModel>& models() const noexcept { return models_; }

    /// Both diffuse parts [1/sr], size() values: the bits of each model by itself.
    void brdf(const DirectionPair& pair, std::span<double> result) const noexcept {
        face_->brdf(pair, result);
    }
    /// The same without the uniform part, AnyModel::terms' directional_diffuse.
    void directional_diffuse(const DirectionPair& pair, std::span<double> result) const noexcept {
        face_->directional_diffuse(pair, result);
    }
    /// The part that is the same for all directions above the horizon [1/sr], size() values.
    [[nodiscard]] std::span<const double> uniform_diffuse() const noexcept { return uniform_diffuse_; }
    /// Reflectance into the mirror direction, size() values; 0 for models without a delta.
    void specular_reflectance(const Direction& in, std::span<double> result) const noexcept;

  private:
    class OneByOne;

    std::vector<AnyModel> models_;
    std::vector<double> uniform_diffuse_;
    std::shared_ptr<const AnyModel::SpectrumFace> face_;
};

template <ReflectanceModel Model>
class AnyModel::Of final : public AnyModel::Face {
  public:
    Of(Model model, double uniform_diffuse) : model_{std::move(model)}, uniform_diffuse_{uniform_diffuse} {}

    [[nodiscard]] std::shared_ptr<const SpectrumFace> together(
        std::span<const AnyModel> models) const override {
        auto same = std::make_shared<Spectrum>();
        for (const AnyModel& each : models) {
            const auto* const of = dynamic_cast<const Of*>(each.face_.get());
            if (of == nullptr) return nullptr;
            same->models.push_back(of->model_);
            same->uniform_diffuse.push_back(of->uniform_diffuse_);
        }
        return same;
    }

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept override {
        return model_.brdf(in, out);
    }
    [[nodiscard]] bool transmits() const noexcept override {
        if constexpr (TransmittingModel<Model>) return model_.transmits();
        return false;
    }
    [[nodiscard]] double btdf(const Direction& in, const Direction& behind) const noexcept override {
        if constexpr (TransmittingModel<Model>) return model_.btdf(in, behind);
        return 0;
    }
    [[nodiscard]] BrdfTerms terms(const Direction& in, const Direction& out) const noexcept override {
        const double sum = model_.brdf(in, out);
        return {std::max(0.0, sum - uniform_diffuse_), std::min(sum, uniform_diffuse_)};
    }
    [[nodiscard]] SpecularReflectance specular_reflectance(const Direction& /*in*/) const noexcept override {
        return SpecularReflectance{0};
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        return model_.pdf(in, out);
    }
    [[nodiscard]] WeightedDirection sample(const Direction& in,
                                           const Uniforms& uniforms) const noexcept override {
        const DrawnDirection drawn = model_.sample(in, uniforms);
        if (!(drawn.pdf > 0)) return {drawn.out, Lobe::none, 0, 0};
        const bool uniform = uniform_diffuse_ > 0 && terms(in, drawn.out).directional_diffuse == 0;
        return {drawn.out, uniform ? Lobe::uniform_diffuse : Lobe::directional_diffuse, drawn.weight,
                drawn.pdf};
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in) const override {
        return albedo_of(*this, uniform_diffuse_, in);
    }
    [[nodiscard]] std::size_t bytes() const noexcept override { return sizeof *this; }

  private:
    struct Spectrum final : SpectrumFace {
        void brdf(const DirectionPair& pair, std::span<double> result) const noexcept override {
            spectral_brdf<Model>(models, pair.in, pair.out, result);
        }
        void directional_diffuse(const DirectionPair& pair,
                                 std::span<double> result) const noexcept override {
            brdf(pair, result);
            for (std::size_t i = 0; i < models.size(); ++i)
                result[i] = std::max(0.0, result[i] - uniform_diffuse[i]);
        }
        std::vector<Model> models;
        std::vector<double> uniform_diffuse;
    };

    Model model_;
    double uniform_diffuse_;
};

}  // namespace hts::spectral
