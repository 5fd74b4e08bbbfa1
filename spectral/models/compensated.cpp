#include "spectral/models/compensated.hpp"

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

/// Draws as the model does, with the weights of the compensated terms.
class CompensatedSampler final : public DirectionSampler {
  public:
    CompensatedSampler(const Reflectance& model, EnergyCompensation compensation, std::size_t wavelength)
        : uniform_diffuse_{model.samples()[wavelength].uniform_diffuse},
          sampler_{model.sampler(wavelength)},
          compensation_{std::move(compensation)} {}

    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        return sampler_.pdf(in, out);
    }
    [[nodiscard]] Draw draw(const Direction& in, const Uniforms& uniforms) const noexcept override {
        return sampler_.draw(in, uniforms);
    }
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept override {
        return sampler_.specular_probability(in);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept override {
        Draw drawn = sampler_.sample(in, uniforms);
        if (drawn.lobe == Lobe::none) return drawn;
        const double uniform =
            drawn.lobe == Lobe::specular ? 0 : uniform_diffuse_ * drawn.out.cos_theta() / drawn.pdf;
        const double factor = compensation_.factor(CompensationPair{{in, drawn.out}});
        drawn.weight = factor * (drawn.weight - uniform) + uniform;
        return drawn;
    }

  private:
    double uniform_diffuse_;
    Sampler sampler_;
    EnergyCompensation compensation_;
};

class CompensatedEvaluator final : public Evaluator {
  public:
    CompensatedEvaluator(const Reflectance& model, std::vector<EnergyCompensation> compensation)
        : Evaluator{model.name(), model.wavelengths()},
          uniform_diffuse_(wavelengths().size()),
          model_{model},
          compensation_{std::move(compensation)} {
        model_.evaluator().uniform_diffuse(uniform_diffuse_);
    }

    [[nodiscard]] Properties properties() const override { return model_.properties(); }
    [[nodiscard]] std::span<const SpectralSample> samples() const noexcept override {
        return model_.samples();
    }
    [[nodiscard]] std::size_t bytes() const noexcept override {
        std::size_t sum = sizeof *this + model_.bytes() + 2 * wavelengths().size() * sizeof(double);
        for (const EnergyCompensation& s : compensation_) sum += s.bytes();
        return sum;
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        model_.evaluator().brdf(pair, values);
        scale(pair, values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        model_.evaluator().brdf_batch(pairs, values);
        const std::size_t width = uniform_diffuse_.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) scale(pairs[i], values.subspan(i * width, width));
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_diffuse_, values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        model_.evaluator().directional_diffuse(pair, values);
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] *= compensation_[i].factor(at);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        model_.evaluator().specular_reflectance(in, values);
        const CompensationPair at{{in, in.mirror()}};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] *= compensation_[i].factor(at);
    }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        model_.evaluator().mueller(pair, values);
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double factor = compensation_[i].factor(at);
            values[i] = factor * values[i] + Mueller::depolariser((1 - factor) * uniform_diffuse_[i]);
        }
    }
    void directional_diffuse_mueller(const DirectionPair& pair,
                                     std::span<Mueller> values) const noexcept override {
        model_.evaluator().directional_diffuse_mueller(pair, values);
        const CompensationPair at{pair};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = compensation_[i].factor(at) * values[i];
    }
    void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept override {
        model_.evaluator().specular_mueller(in, values);
        const CompensationPair at{{in, in.mirror()}};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = compensation_[i].factor(at) * values[i];
    }

    void detail(const DirectionPair& pair, std::span<LobeDetail> values) const noexcept override {
        model_.evaluator().detail(pair, values);
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in,
                                                  std::size_t wavelength) const override {
        const SpectralSample& sample = samples()[wavelength];
        auto result = directional_hemispherical_reflectance(compensation_[wavelength], *properties().surface,
                                                            sample.index, sample.wavelength, in);
        result.uniform_diffuse = sample.uniform_diffuse * std::numbers::pi;
        return result;
    }
    [[nodiscard]] std::shared_ptr<const DirectionSampler> sampler(std::size_t wavelength) const override {
        return std::make_shared<const CompensatedSampler>(model_, compensation_[wavelength], wavelength);
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
    Reflectance model_;
    std::vector<EnergyCompensation> compensation_;
};

}  // namespace

Reflectance compensated(const Reflectance& model, std::vector<EnergyCompensation> compensation) {
    if (!model.properties().surface)
        throw Error{model.name() + ": energy compensation: must be of a rough surface"};
    if (compensation.size() != model.size()) {
        throw Error{model.name() + ": " + std::to_string(compensation.size()) +
                    " compensations: must be one for each of " + std::to_string(model.size()) +
                    " wavelengths"};
    }
    return Reflectance{std::make_shared<const CompensatedEvaluator>(model, std::move(compensation))};
}

}  // namespace hts::spectral
