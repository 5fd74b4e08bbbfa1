#include "spectral/models/reflectance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/models/symmetry.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t block = 512;  // pairs that a thread takes at a time

Properties known_properties(const Evaluator& evaluator) {
    Properties result = evaluator.properties();
    if (!result.isotropic) result.isotropic = anisotropy(evaluator, 64) < accuracy::isotropy;
    return result;
}

}  // namespace

Reflectance::Reflectance(std::shared_ptr<const Evaluator> evaluator)
    : evaluator_{std::move(evaluator)},
      size_{evaluator_->wavelengths().size()},
      properties_{known_properties(*evaluator_)} {}

std::vector<double> Reflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size_);
    brdf(pair, result);
    return result;
}

void Reflectance::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    require_size("brdf", result.size(), pairs.size());
    if (properties_.partial) std::ranges::for_each(pairs, [&](const auto& pair) { require_known(pair); });
    parallel_blocks(pairs.size(), block, [&](std::size_t first, std::size_t count) {
        evaluator_->brdf_batch(pairs.subspan(first, count), result.subspan(first * size_, count * size_));
    });
}

std::vector<double> Reflectance::uniform_diffuse() const {
    std::vector<double> result(size_);
    evaluator_->uniform_diffuse(result);
    return result;
}

void Reflectance::uniform_diffuse(std::span<double> result) const {
    require_size("uniform_diffuse", result.size(), 1);
    evaluator_->uniform_diffuse(result);
}

std::vector<double> Reflectance::directional_diffuse(const DirectionPair& pair) const {
    std::vector<double> result(size_);
    directional_diffuse(pair, result);
    return result;
}

void Reflectance::directional_diffuse(const DirectionPair& pair, std::span<double> result) const {
    require_size("directional_diffuse", result.size(), 1);
    require_known(pair);
    evaluator_->directional_diffuse(pair, result);
}

std::vector<SpecularReflectance> Reflectance::specular_reflectance(const Direction& in) const {
    std::vector<double> values(size_);
    evaluator_->specular_reflectance(in, values);
    return {values.begin(), values.end()};
}

void Reflectance::specular_reflectance(const Direction& in, std::span<double> result) const {
    require_size("specular_reflectance", result.size(), 1);
    evaluator_->specular_reflectance(in, result);
}

std::vector<Mueller> Reflectance::mueller(const DirectionPair& pair) const {
    std::vector<Mueller> result(size_);
    mueller(pair, result);
    return result;
}

void Reflectance::mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    require_polarised();
    require_size("mueller", result.size(), 1);
    evaluator_->mueller(pair, result);
}

std::vector<Mueller> Reflectance::directional_diffuse_mueller(const DirectionPair& pair) const {
    std::vector<Mueller> result(size_);
    directional_diffuse_mueller(pair, result);
    return result;
}

void Reflectance::directional_diffuse_mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    require_polarised();
    require_size("directional_diffuse_mueller", result.size(), 1);
    evaluator_->directional_diffuse_mueller(pair, result);
}

std::vector<Mueller> Reflectance::specular_mueller(const Direction& in) const {
    std::vector<Mueller> result(size_);
    specular_mueller(in, result);
    return result;
}

void Reflectance::specular_mueller(const Direction& in, std::span<Mueller> result) const {
    require_polarised();
    require_size("specular_mueller", result.size(), 1);
    evaluator_->specular_mueller(in, result);
}

bool Reflectance::transmits(std::size_t wavelength) const {
    require_wavelength(wavelength);
    return evaluator_->transmits(wavelength);
}

std::vector<double> Reflectance::btdf(const DirectionPair& pair) const {
    std::vector<double> result(size_);
    evaluator_->btdf(pair, result);
    return result;
}

HemisphericalReflectance Reflectance::albedo(const Direction& in, std::size_t wavelength) const {
    require_wavelength(wavelength);
    return evaluator_->albedo(in, wavelength);
}

HemisphericalReflectance Reflectance::albedo(const Direction& in, std::size_t wavelength,
                                             const Stokes& light) const {
    require_wavelength(wavelength);
    require_polarised();
    return evaluator_->albedo(in, wavelength, light);
}

Sampler Reflectance::sampler(std::size_t wavelength) const {
    require_wavelength(wavelength);
    return Sampler{evaluator_->sampler(wavelength)};
}

void Reflectance::refuse_size(const char* call, std::size_t size, std::size_t pairs) const {
    throw Error{std::string{call} + ": result has " + std::to_string(size) + " values: must be " +
                (pairs == 1 ? "" : "pairs x ") + "wavelengths = " + std::to_string(pairs * size_)};
}

void Reflectance::refuse_pair(const DirectionPair& pair) const {
    const auto degrees = [](double y, double x) {
        return brief(std::atan2(y, x) * 180 / std::numbers::pi, 6);
    };
    const Direction &in = pair.in, &out = pair.out;
    const double x = out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi();
    const double y = out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi();
    throw Error{name() + ": theta_i " + degrees(in.sin_theta(), in.cos_theta()) + ", theta_r " +
                degrees(out.sin_theta(), out.cos_theta()) + ", phi " + degrees(y, x) +
                " deg: outside what was measured: must be within " + evaluator_->domain().axes +
                "; --outside hold or zero answers beyond"};
}

void Reflectance::require_polarised() const {
    if (!properties_.polarised) throw Error{name() + ": has no Mueller matrices"};
}

void Reflectance::require_wavelength(std::size_t wavelength) const {
    if (wavelength >= size_) {
        throw out_of_range("wavelength's place", static_cast<double>(wavelength), "",
                           "less than " + std::to_string(size_));
    }
}

}  // namespace hts::spectral
