#include "spectral/models/any_model.hpp"

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
    [[nodiscard]] std::size_t bytes() const noexcept override { return sizeof *this; }

    [[nodiscard]] std::shared_ptr<const SpectrumFace> together(
        std::span<const AnyModel> models) const override;

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

/// Factors of the pair once, Phi and Fresnel at each wavelength.
class AnyModel::HeTorranceSpectrum final : public AnyModel::SpectrumFace {
  public:
    HeTorranceSpectrum(const Surface& surface, std::vector<SpectralSample> lobes,
                       std::vector<double> uniform_diffuse)
        : lobes_{surface, std::move(lobes), Tolerance{hts::accuracy::finest_tolerance}},
          uniform_diffuse_{std::move(uniform_diffuse)} {}

    void brdf(const DirectionPair& pair, std::span<double> result) const noexcept override {
        lobes_.brdf(pair, result);
        for (std::size_t i = 0; i < uniform_diffuse_.size(); ++i) result[i] += uniform_diffuse_[i];
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> result) const noexcept override {
        lobes_.brdf(pair, result);
    }

  private:
    PreparedReflectance lobes_;  // without their uniform parts
    std::vector<double> uniform_diffuse_;
};

std::shared_ptr<const AnyModel::SpectrumFace> AnyModel::HeTorrance::together(
    std::span<const AnyModel> models) const {
    std::vector<SpectralSample> lobes;
    std::vector<double> uniform_diffuse;
    for (const AnyModel& each : models) {
        const auto* const he = dynamic_cast<const HeTorrance*>(each.face_.get());
        const bool same = he != nullptr && he->surface_.rms_roughness() == surface_.rms_roughness() &&
                          he->surface_.correlation_length() == surface_.correlation_length();
        if (!same) return nullptr;
        lobes.push_back({he->sample_.wavelength, he->sample_.index, 0});
        uniform_diffuse.push_back(he->sample_.uniform_diffuse);
    }
    return std::make_shared<const HeTorranceSpectrum>(surface_, std::move(lobes), std::move(uniform_diffuse));
}

AnyModel AnyModel::he_torrance(const Surface& surface, const SpectralSample& sample) {
    return AnyModel{std::make_shared<const HeTorrance>(surface, sample)};
}

HemisphericalReflectance AnyModel::albedo_of(const Face& face, double uniform_diffuse, const Direction& in) {
    const double total = directional_albedo([&](const Direction& out) { return face.brdf(in, out); }, in);
    const double uniform = std::min(total, uniform_diffuse * std::numbers::pi);
    return {0, total - uniform, uniform};
}

/// Of several kinds.
class AnySpectrum::OneByOne final : public AnyModel::SpectrumFace {
  public:
    explicit OneByOne(std::vector<AnyModel> models) : models_{std::move(models)} {}

    void brdf(const DirectionPair& pair, std::span<double> result) const noexcept override {
        std::ranges::transform(models_, result.begin(),
                               [&](const AnyModel& model) { return model.brdf(pair.in, pair.out); });
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> result) const noexcept override {
        std::ranges::transform(models_, result.begin(), [&](const AnyModel& model) {
            return model.terms(pair.in, pair.out).directional_diffuse;
        });
    }

  private:
    std::vector<AnyModel> models_;
};

AnySpectrum::AnySpectrum(std::vector<AnyModel> models) : models_{std::move(models)} {
    const Direction up = Direction::from_unit_vector({0, 0, 1});
    for (const AnyModel& model : models_) uniform_diffuse_.push_back(model.terms(up, up).uniform_diffuse);
    if (!models_.empty()) face_ = models_.front().face_->together(models_);
    if (!face_) face_ = std::make_shared<const OneByOne>(models_);
}

void AnySpectrum::specular_reflectance(const Direction& in, std::span<double> result) const noexcept {
    std::ranges::transform(models_, result.begin(),
                           [&](const AnyModel& model) { return model.specular_reflectance(in).value(); });
}

}  // namespace hts::spectral
