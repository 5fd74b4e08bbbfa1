/// Any hts::ReflectanceModel at a list of wavelengths, a value of the model for each, as a
/// Reflectance or as a Material.
///
///     const Material mine = material_of([](const Wavelength& at, OutsideRange) { return
///     MyModel{at.micrometres()}; });
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "hts/microfacet/albedo.hpp"
#include "hts/microfacet/spectrum.hpp"
#include "spectral/models/material.hpp"

namespace hts::spectral {

/// A model, and the part of its BRDF that is the same for all directions above the horizon [1/sr].
template <ReflectanceModel Model>
struct ModelAtWavelength {
    Model model;
    double uniform_diffuse = 0;
};
template <ReflectanceModel Model>
ModelAtWavelength(Model) -> ModelAtWavelength<Model>;
template <ReflectanceModel Model>
ModelAtWavelength(Model, double) -> ModelAtWavelength<Model>;

/// Draws of a model.
template <ReflectanceModel Model>
class ModelSampler final : public DirectionSampler {
  public:
    ModelSampler(Model model, double uniform_diffuse)
        : model_{std::move(model)}, uniform_diffuse_{uniform_diffuse} {}

    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        return model_.pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept override {
        Draw drawn = model_.sample(in, uniforms);
        const bool uniform =
            drawn.pdf > 0 && uniform_diffuse_ > 0 && model_.brdf(in, drawn.out) <= uniform_diffuse_;
        if (uniform) drawn.lobe = Lobe::uniform_diffuse;
        return drawn;
    }

  private:
    Model model_;
    double uniform_diffuse_;
};

///   uniform_diffuse   as in ModelAtWavelength
template <ReflectanceModel Model>
[[nodiscard]] std::shared_ptr<const DirectionSampler> sampler_of(Model model, double uniform_diffuse = 0) {
    return std::make_shared<const ModelSampler<Model>>(std::move(model), uniform_diffuse);
}

/// The models of a spectrum, which share what depends on directions alone.
template <ReflectanceModel Model>
class ModelEvaluator final : public Evaluator {
  public:
    /// One model per wavelength.
    ModelEvaluator(std::string name, WavelengthGrid wavelengths, std::vector<Model> models,
                   std::vector<double> uniform_diffuse, Tolerance tolerance)
        : Evaluator{std::move(name), std::move(wavelengths), tolerance},
          models_{std::move(models)},
          uniform_diffuse_{std::move(uniform_diffuse)},
          uniform_of_brdf_{uniform_diffuse_} {
        const Direction up = Direction::from_unit_vector({0, 0, 1});
        for (std::size_t i = 0; i < models_.size(); ++i)
            uniform_of_brdf_[i] = std::min(uniform_diffuse_[i], models_[i].brdf(up, up));
    }

    [[nodiscard]] Properties properties() const override {
        Properties result;
        for (std::size_t i = 0; i < models_.size(); ++i) result.transmitting |= transmits(i);
        return result;
    }
    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this + models_.size() * (sizeof(Model) + 3 * sizeof(double));
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        spectral_brdf<Model>(models_, pair.in, pair.out, values);
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(uniform_of_brdf_, values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf(pair, values);
        for (std::size_t i = 0; i < models_.size(); ++i)
            values[i] = std::max(0.0, values[i] - uniform_diffuse_[i]);
    }
    [[nodiscard]] bool transmits(std::size_t wavelength) const noexcept override {
        if constexpr (TransmittingModel<Model>) return models_[wavelength].transmits();
        return false;
    }
    void btdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        for (std::size_t i = 0; i < models_.size(); ++i) {
            if constexpr (TransmittingModel<Model>) {
                values[i] = models_[i].btdf(pair.in, pair.out);
            } else {
                values[i] = 0;
            }
        }
    }
    [[nodiscard]] HemisphericalReflectance albedo(const Direction& in,
                                                  std::size_t wavelength) const override {
        const double total = directional_albedo(models_[wavelength], in, tolerance());
        const double uniform = std::min(total, uniform_diffuse_[wavelength] * std::numbers::pi);
        return {0, total - uniform, uniform};
    }
    [[nodiscard]] std::shared_ptr<const DirectionSampler> sampler(std::size_t wavelength) const override {
        return sampler_of(models_[wavelength], uniform_diffuse_[wavelength]);
    }

  private:
    std::vector<Model> models_;
    std::vector<double> uniform_diffuse_;
    std::vector<double> uniform_of_brdf_;  // not above the BRDF by a rounding, where there is nothing else
};

/// A reflectance that is the uniform-diffuse part of another alone.
[[nodiscard]] Reflectance uniform_part_of(const Reflectance& whole);

/// A material of a model.
///   make   from a wavelength and the policy outside what is known, a ReflectanceModel or a
///          ModelAtWavelength; hts::Error where the material is not known at the wavelength
template <class Make>
[[nodiscard]] Material material_of(Make make, std::vector<std::string> warnings = {}) {
    const auto prepare = [make = std::move(make)](const std::string& name, const WavelengthGrid& wavelengths,
                                                  const EvaluationOptions& options) {
        using Model = decltype(ModelAtWavelength{make(wavelengths[0], options.outside)}.model);
        std::vector<Model> models;
        std::vector<double> uniform_diffuse;
        for (std::size_t i = 0; i < wavelengths.size(); ++i) {
            ModelAtWavelength made{make(wavelengths[i], options.outside)};
            models.push_back(std::move(made.model));
            uniform_diffuse.push_back(made.uniform_diffuse);
        }
        const Reflectance whole{std::make_shared<const ModelEvaluator<Model>>(
            name, wavelengths, std::move(models), std::move(uniform_diffuse), options.tolerance)};
        return options.lobe == DiffuseLobe::none ? uniform_part_of(whole) : whole;
    };
    return Material{prepare, {}, std::move(warnings)};
}

}  // namespace hts::spectral
