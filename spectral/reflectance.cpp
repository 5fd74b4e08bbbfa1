#include "spectral/reflectance.hpp"

#include <cstddef>
#include <string>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

PairFactors factors(const Surface& surface, const DirectionPair& pair) {
    return {surface, view(surface, pair.in), view(surface, pair.out)};
}

}  // namespace

SpectralReflectance::SpectralReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                                         OutsideRange policy)
    : surface_{reflector.surface} {
    samples_.reserve(wavelengths.size());
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
        samples_.push_back({wavelengths[i], reflector.material.index(wavelengths[i], policy),
                            hts::uniform_diffuse(reflector.albedo(wavelengths[i], policy))});
    }
}

void SpectralReflectance::evaluate(const DirectionPair& pair, std::span<double> result) const noexcept {
    const PairFactors shared = factors(surface_, pair);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Sample& sample = samples_[i];
        result[i] =
            hts::directional_diffuse(shared, sample.wavelength, sample.index).brdf + sample.uniform_diffuse;
    }
}

std::vector<double> SpectralReflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size());
    evaluate(pair, result);
    return result;
}

void SpectralReflectance::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    if (result.size() != pairs.size() * size()) {
        throw Error{"brdf: result has " + std::to_string(result.size()) +
                    " values: must be pairs x wavelengths = " + std::to_string(pairs.size() * size())};
    }
    const auto count = static_cast<std::ptrdiff_t>(pairs.size());
#pragma omp parallel for schedule(dynamic, 64)
    for (std::ptrdiff_t j = 0; j < count; ++j) {
        const auto pair = static_cast<std::size_t>(j);
        evaluate(pairs[pair], result.subspan(pair * size(), size()));
    }
}

std::vector<DirectionalDiffuse> SpectralReflectance::directional_diffuse(const DirectionPair& pair) const {
    const PairFactors shared = factors(surface_, pair);
    std::vector<DirectionalDiffuse> result;
    result.reserve(size());
    for (const Sample& sample : samples_) {
        result.push_back(hts::directional_diffuse(shared, sample.wavelength, sample.index));
    }
    return result;
}

std::vector<double> SpectralReflectance::uniform_diffuse() const {
    std::vector<double> result;
    result.reserve(size());
    for (const Sample& sample : samples_) result.push_back(sample.uniform_diffuse);
    return result;
}

std::vector<SpecularReflectance> SpectralReflectance::specular_reflectance(const Direction& in) const {
    const View seen = view(surface_, in);
    std::vector<SpecularReflectance> result;
    result.reserve(size());
    for (const Sample& sample : samples_) {
        result.push_back(hts::specular_reflectance(surface_, seen, sample.wavelength, sample.index));
    }
    return result;
}

std::vector<Mueller> SpectralReflectance::mueller(const DirectionPair& pair) const {
    std::vector<Mueller> result;
    result.reserve(size());
    const std::vector<DirectionalDiffuse> terms = directional_diffuse(pair);
    for (std::size_t i = 0; i < size(); ++i) {
        result.push_back(directional_diffuse_mueller(pair.in, pair.out, terms[i]) +
                         Mueller::depolariser(samples_[i].uniform_diffuse));
    }
    return result;
}

std::vector<Mueller> SpectralReflectance::specular_mueller(const Direction& in) const {
    const View seen = view(surface_, in);
    std::vector<Mueller> result;
    result.reserve(size());
    for (const Sample& sample : samples_) {
        result.push_back(hts::specular_mueller(surface_, seen, sample.wavelength, sample.index));
    }
    return result;
}

}  // namespace hts::spectral
