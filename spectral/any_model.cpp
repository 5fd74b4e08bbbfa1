#include "spectral/any_model.hpp"

#include <mutex>
#include <optional>

#include "hts/microfacet/albedo.hpp"

namespace hts::spectral {

class AnyModel::HeTorrance final : public AnyModel::Face {
  public:
    HeTorrance(const Surface& surface, const SpectralSample& sample) : surface_{surface}, sample_{sample} {}

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept override {
        const BrdfTerms parts = terms(in, out);
        return parts.directional_diffuse + parts.uniform_diffuse;
    }
    [[nodiscard]] BrdfTerms terms(const Direction& in, const Direction& out) const noexcept override {
        const PairFactors pair{surface_, in, out};
        return {directional_diffuse(pair, sample_.wavelength, sample_.index).brdf, sample_.uniform_diffuse};
    }
    [[nodiscard]] SpecularReflectance specular_reflectance(const Direction& in) const noexcept override {
        return hts::specular_reflectance(surface_, view(surface_, in), sample_.wavelength, sample_.index);
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        return sampler().pdf(in, out);
    }
    [[nodiscard]] WeightedDirection sample(const Direction& in,
                                           const Uniforms& uniforms) const noexcept override {
        return sampler().sample(in, uniforms);
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in) const override {
        auto parts = directional_hemispherical_reflectance(surface_, sample_.index, sample_.wavelength, in);
        parts.uniform_diffuse = sample_.uniform_diffuse * std::numbers::pi;
        return parts;
    }

  private:
    [[nodiscard]] const DirectionSampler& sampler() const noexcept {
        std::call_once(prepared_, [this] {
            sampler_.emplace(surface_, sample_, Tolerance{hts::accuracy::finest_tolerance});
        });
        return *sampler_;
    }

    Surface surface_;
    SpectralSample sample_;
    mutable std::once_flag prepared_;
    mutable std::optional<DirectionSampler> sampler_;
};

AnyModel AnyModel::he_torrance(const Surface& surface, const SpectralSample& sample) {
    return AnyModel{std::make_shared<const HeTorrance>(surface, sample)};
}

HemisphericalReflectance AnyModel::albedo_of(const Face& face, double uniform_diffuse, const Direction& in) {
    const double total = directional_albedo([&](const Direction& out) { return face.brdf(in, out); }, in);
    const double uniform = std::min(total, uniform_diffuse * std::numbers::pi);
    return {0, total - uniform, uniform};
}

}  // namespace hts::spectral
