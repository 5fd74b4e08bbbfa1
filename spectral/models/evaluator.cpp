#include "spectral/models/evaluator.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "hts/microfacet/albedo.hpp"

namespace hts::spectral {

Evaluator::Evaluator(std::string name, WavelengthGrid wavelengths, Tolerance tolerance)
    : name_{std::move(name)}, wavelengths_{std::move(wavelengths)}, tolerance_{tolerance} {}

void Evaluator::brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept {
    const std::size_t width = wavelengths_.size();
    for (std::size_t i = 0; i < pairs.size(); ++i) brdf(pairs[i], values.subspan(i * width, width));
}

void Evaluator::uniform_diffuse(std::span<double> values) const noexcept {
    std::ranges::fill(values, 0.0);
}

void Evaluator::directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept {
    brdf(pair, values);
}

void Evaluator::specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept {
    std::ranges::fill(values, 0.0);
}

void Evaluator::mueller(const DirectionPair& /*pair*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

void Evaluator::directional_diffuse_mueller(const DirectionPair& pair,
                                            std::span<Mueller> values) const noexcept {
    mueller(pair, values);
}

void Evaluator::specular_mueller(const Direction& /*in*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

bool Evaluator::transmits(std::size_t /*wavelength*/) const noexcept {
    return false;
}

void Evaluator::btdf(const DirectionPair& /*pair*/, std::span<double> values) const noexcept {
    std::ranges::fill(values, 0.0);
}

void Evaluator::detail(const DirectionPair& /*pair*/, std::span<LobeDetail> /*values*/) const noexcept {}

HemisphericalReflectance Evaluator::albedo(const Direction& in, std::size_t wavelength) const {
    std::vector<double> spectrum(wavelengths_.size());
    const auto at_wavelength = [&](const Direction& out) {
        brdf({in, out}, spectrum);
        return spectrum[wavelength];
    };
    const double diffuse = directional_albedo(at_wavelength, in, tolerance_);
    uniform_diffuse(spectrum);
    const double uniform = std::min(diffuse, spectrum[wavelength] * std::numbers::pi);
    specular_reflectance(in, spectrum);
    return {spectrum[wavelength], diffuse - uniform, uniform};
}

HemisphericalReflectance Evaluator::albedo(const Direction& in, std::size_t wavelength,
                                           const Stokes& light) const {
    std::vector<Mueller> matrices(wavelengths_.size());
    const auto reflected = [&] { return (matrices[wavelength] * light).intensity() / light.intensity(); };
    const auto at_wavelength = [&](const Direction& out) {
        mueller({in, out}, matrices);
        return reflected();
    };
    const double diffuse = directional_albedo(at_wavelength, in, tolerance_);
    std::vector<double> spectrum(wavelengths_.size());
    uniform_diffuse(spectrum);
    const double uniform = std::min(diffuse, spectrum[wavelength] * std::numbers::pi);
    specular_mueller(in, matrices);
    return {reflected(), diffuse - uniform, uniform};
}

std::shared_ptr<const DirectionSampler> Evaluator::sampler(std::size_t /*wavelength*/) const {
    throw Error{name_ + ": no directions can be drawn from it"};
}

}  // namespace hts::spectral
