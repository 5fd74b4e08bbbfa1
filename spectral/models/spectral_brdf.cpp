#include "spectral/models/spectral_brdf.hpp"

#include <algorithm>
#include <utility>

#include "hts/error.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::spectral {
namespace {

std::size_t bytes_of(const WavelengthGrid& wavelengths) noexcept {
    return wavelengths.size() * sizeof(double);
}

class HeTorranceBrdf final : public SpectralBrdf {
  public:
    HeTorranceBrdf(const Reflector& reflector, const WavelengthGrid& wavelengths,
                   std::vector<SpectralSample> samples, Tolerance tolerance, DiffuseLobe lobe)
        : SpectralBrdf{reflector.name, wavelengths},
          uniform_diffuse_{taken_from(samples)},
          lobe_{reflector.surface, std::move(samples), tolerance, lobe} {}

    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this - sizeof lobe_ + lobe_.bytes() + 2 * bytes_of(wavelengths());
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        lobe_.brdf(pair, values);
        add_uniform(values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        lobe_.brdf(pairs, values);
        const std::size_t width = uniform_diffuse_.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) add_uniform(values.subspan(i * width, width));
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_diffuse_, values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        lobe_.brdf(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        lobe_.specular_reflectance(in, values);
    }
    [[nodiscard]] bool polarised() const noexcept override { return true; }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        lobe_.mueller(pair, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = values[i] + Mueller::depolariser(uniform_diffuse_[i]);
    }
    void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept override {
        const View seen = view(lobe_.surface(), in);
        std::ranges::transform(lobe_.samples(), values.begin(), [&](const SpectralSample& sample) {
            return hts::specular_mueller(lobe_.surface(), seen, sample.wavelength, sample.index);
        });
    }

  private:
    /// The uniform terms, which the samples then lack: so the lobe by itself is there without cancellation.
    [[nodiscard]] static std::vector<double> taken_from(std::vector<SpectralSample>& samples) {
        std::vector<double> taken;
        taken.reserve(samples.size());
        for (SpectralSample& sample : samples) taken.push_back(std::exchange(sample.uniform_diffuse, 0));
        return taken;
    }
    void add_uniform(std::span<double> values) const noexcept {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += uniform_diffuse_[i];
    }

    std::vector<double> uniform_diffuse_;
    PreparedReflectance lobe_;
};

class ModelBrdf final : public SpectralBrdf {
  public:
    ModelBrdf(const AnyReflector& reflector, const WavelengthGrid& wavelengths, OutsideRange policy)
        : SpectralBrdf{reflector.name(), wavelengths}, spectrum_{reflector.spectrum(wavelengths, policy)} {}

    [[nodiscard]] std::size_t bytes() const noexcept override {
        std::size_t sum = sizeof *this + 2 * bytes_of(wavelengths());
        for (const AnyModel& model : spectrum_.models()) sum += sizeof model + 2 * model.bytes();
        return sum;  // twice: together and each by itself
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        spectrum_.brdf(pair, values);
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(spectrum_.uniform_diffuse(), values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        spectrum_.directional_diffuse(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        spectrum_.specular_reflectance(in, values);
    }

  private:
    AnySpectrum spectrum_;
};

/// The uniform-diffuse part of a model alone.
class UniformBrdf final : public SpectralBrdf {
  public:
    explicit UniformBrdf(const SpectralBrdf& model)
        : SpectralBrdf{model.name(), model.wavelengths()}, uniform_diffuse_(wavelengths().size()) {
        model.uniform_diffuse(uniform_diffuse_);
    }

    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this + 2 * bytes_of(wavelengths());
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool lit_and_seen = pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = lit_and_seen ? uniform_diffuse_[i] : 0;
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_diffuse_, values.begin());
    }
    void directional_diffuse(const DirectionPair& /*pair*/,
                             std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }

  private:
    std::vector<double> uniform_diffuse_;
};

class CompensatedBrdf final : public SpectralBrdf {
  public:
    CompensatedBrdf(std::unique_ptr<SpectralBrdf> model, std::vector<EnergyCompensation> compensation)
        : SpectralBrdf{model->name(), model->wavelengths()},
          uniform_diffuse_(wavelengths().size()),
          model_{std::move(model)},
          compensation_{std::move(compensation)} {
        model_->uniform_diffuse(uniform_diffuse_);
    }

    [[nodiscard]] std::size_t bytes() const noexcept override {
        std::size_t sum = sizeof *this + model_->bytes() + 2 * bytes_of(wavelengths());
        for (const EnergyCompensation& s : compensation_) sum += s.bytes();
        return sum;
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        model_->brdf(pair, values);
        scale(pair, values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        model_->brdf_batch(pairs, values);
        const std::size_t width = uniform_diffuse_.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) scale(pairs[i], values.subspan(i * width, width));
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_diffuse_, values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        model_->directional_diffuse(pair, values);
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] *= compensation_[i].factor(at);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        model_->specular_reflectance(in, values);
        const CompensationPair at{{in, in.mirror()}};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] *= compensation_[i].factor(at);
    }
    [[nodiscard]] bool polarised() const noexcept override { return model_->polarised(); }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        model_->mueller(pair, values);
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double factor = compensation_[i].factor(at);
            values[i] = factor * values[i] + Mueller::depolariser((1 - factor) * uniform_diffuse_[i]);
        }
    }
    void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept override {
        model_->specular_mueller(in, values);
        const CompensationPair at{{in, in.mirror()}};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = compensation_[i].factor(at) * values[i];
    }

  private:
    void scale(const DirectionPair& pair, std::span<double> values) const noexcept {
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double uniform = uniform_diffuse_[i];
            values[i] = compensation_[i].factor(at) * (values[i] - uniform) + uniform;
        }
    }

    std::vector<double> uniform_diffuse_;
    std::unique_ptr<SpectralBrdf> model_;
    std::vector<EnergyCompensation> compensation_;
};

}  // namespace

SpectralBrdf::SpectralBrdf(std::string name, WavelengthGrid wavelengths)
    : name_{std::move(name)}, wavelengths_{std::move(wavelengths)} {}

void SpectralBrdf::brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept {
    const std::size_t width = wavelengths_.size();
    for (std::size_t i = 0; i < pairs.size(); ++i) brdf(pairs[i], values.subspan(i * width, width));
}

void SpectralBrdf::uniform_diffuse(std::span<double> values) const noexcept {
    std::ranges::fill(values, 0.0);
}

void SpectralBrdf::directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept {
    brdf(pair, values);
}

void SpectralBrdf::mueller(const DirectionPair& /*pair*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

void SpectralBrdf::specular_mueller(const Direction& /*in*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

std::unique_ptr<SpectralBrdf> model_brdf(const AnyReflector& reflector, const WavelengthGrid& wavelengths,
                                         OutsideRange policy, Tolerance tolerance, DiffuseLobe lobe) {
    if (const Reflector* he = reflector.he_torrance()) {
        return std::make_unique<HeTorranceBrdf>(*he, wavelengths, spectral_samples(*he, wavelengths, policy),
                                                tolerance, lobe);
    }
    auto whole = std::make_unique<ModelBrdf>(reflector, wavelengths, policy);
    if (lobe == DiffuseLobe::full) return whole;
    if (lobe == DiffuseLobe::none) return std::make_unique<UniformBrdf>(*whole);
    throw Error{reflector.name() + ": lobe " + name(lobe) + ": must be full or none, since its model is " +
                reflector.model_name() + ", not he"};
}

std::unique_ptr<SpectralBrdf> compensated_brdf(const Reflector& reflector, const WavelengthGrid& wavelengths,
                                               OutsideRange policy, Tolerance tolerance) {
    return compensated_brdf(model_brdf(AnyReflector{reflector}, wavelengths, policy, tolerance),
                            EnergyCompensation::of(reflector.surface, wavelengths));
}

std::unique_ptr<SpectralBrdf> compensated_brdf(std::unique_ptr<SpectralBrdf> model,
                                               std::vector<EnergyCompensation> compensation) {
    if (compensation.size() != model->wavelengths().size()) {
        throw Error{model->name() + ": " + std::to_string(compensation.size()) +
                    " compensations: must be one for each of " + std::to_string(model->wavelengths().size()) +
                    " wavelengths"};
    }
    return std::make_unique<CompensatedBrdf>(std::move(model), std::move(compensation));
}

}  // namespace hts::spectral
