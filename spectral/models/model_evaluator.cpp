#include "spectral/models/model_evaluator.hpp"

#include <algorithm>

namespace hts::spectral {
namespace {

/// The uniform-diffuse part of a model alone.
class UniformEvaluator final : public Evaluator {
  public:
    explicit UniformEvaluator(const Reflectance& model)
        : Evaluator{model.name(), model.wavelengths()}, uniform_diffuse_(wavelengths().size()) {
        model.uniform_diffuse(uniform_diffuse_);
    }

    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this + 2 * wavelengths().size() * sizeof(double);
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

  private:
    std::vector<double> uniform_diffuse_;
};

}  // namespace

Reflectance uniform_part_of(const Reflectance& whole) {
    return Reflectance{std::make_shared<const UniformEvaluator>(whole)};
}

}  // namespace hts::spectral
