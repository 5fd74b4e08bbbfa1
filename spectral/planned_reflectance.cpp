#include "spectral/planned_reflectance.hpp"

#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {

PlannedReflectance::PlannedReflectance(const Reflector& reflector, Rung rung, OutsideRange policy,
                                       std::optional<Illuminant> illuminant)
    : name_{reflector.name},
      rung_{std::move(rung)},
      diffuse_{reflector, rung_.wavelengths, policy, rung_.lobe_tolerance, rung_.lobe} {
    if (illuminant) weights_ = tristimulus_weights(rung_.wavelengths.micrometres(), *illuminant);
}

std::size_t PlannedReflectance::bytes() const noexcept {
    const std::size_t grid = rung_.wavelengths.size() * sizeof(double);
    const std::size_t colour = weights_ ? weights_->weights().size() * sizeof(Xyz) : 0;
    return sizeof *this - sizeof diffuse_ + diffuse_.bytes() + grid + colour;
}

std::vector<SpecularReflectance> PlannedReflectance::specular_reflectance(const Direction& in) const {
    if (rung_.specular) return diffuse_.specular_reflectance(in);
    std::vector<SpecularReflectance> dropped(size(), SpecularReflectance{0});
    return dropped;
}

std::vector<Mueller> PlannedReflectance::specular_mueller(const Direction& in) const {
    if (!rung_.specular) return std::vector<Mueller>(size());
    return diffuse_.specular_mueller(in);
}

Xyz PlannedReflectance::colour(const DirectionPair& pair, std::span<double> scratch) const {
    diffuse_.brdf(pair, scratch);
    return weights().of_brdf(scratch);
}

Xyz PlannedReflectance::specular_colour(const Direction& in) const {
    std::vector<double> reflectance;
    for (const SpecularReflectance& value : specular_reflectance(in)) reflectance.push_back(value.value());
    return weights()(reflectance);
}

const TristimulusWeights& PlannedReflectance::weights() const {
    if (!weights_) throw Error{name_ + ": no colour: the scene's output must be rgb"};
    return *weights_;
}

}  // namespace hts::spectral
