#include "spectral/models/reflectance.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

void require_size(const char* call, std::size_t size, const char* rule, std::size_t expected) {
    if (size == expected) return;
    throw Error{std::string{call} + ": result has " + std::to_string(size) + " values: must be " + rule +
                " = " + std::to_string(expected)};
}

}  // namespace

std::vector<SpectralSample> spectral_samples(const Reflector& reflector, const WavelengthGrid& wavelengths,
                                             OutsideRange policy) {
    std::vector<SpectralSample> samples;
    samples.reserve(wavelengths.size());
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
        samples.push_back({wavelengths[i], reflector.material.index(wavelengths[i], policy),
                           hts::uniform_diffuse(reflector.albedo(wavelengths[i], policy))});
    }
    return samples;
}

SpectralReflectance::SpectralReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                                         OutsideRange policy, Tolerance tolerance, DiffuseLobe lobe)
    : prepared_{reflector.surface, spectral_samples(reflector, wavelengths, policy), tolerance, lobe} {}

std::vector<double> SpectralReflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size());
    prepared_.brdf(pair, result);
    return result;
}

void SpectralReflectance::brdf(const DirectionPair& pair, std::span<double> result) const {
    require_size("brdf", result.size(), "wavelengths", size());
    prepared_.brdf(pair, result);
}

void SpectralReflectance::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    require_size("brdf", result.size(), "pairs x wavelengths", pairs.size() * size());
    constexpr std::size_t chunk = 256;
    const auto chunks = static_cast<std::ptrdiff_t>((pairs.size() + chunk - 1) / chunk);
#pragma omp parallel for schedule(dynamic, 4)
    for (std::ptrdiff_t j = 0; j < chunks; ++j) {
        const std::size_t first = static_cast<std::size_t>(j) * chunk;
        const std::size_t count = std::min(chunk, pairs.size() - first);
        prepared_.brdf(pairs.subspan(first, count), result.subspan(first * size(), count * size()));
    }
}

std::vector<DirectionalDiffuse> SpectralReflectance::directional_diffuse(const DirectionPair& pair) const {
    const PairFactors shared{prepared_.surface(), pair.in, pair.out};
    std::vector<DirectionalDiffuse> result;
    result.reserve(size());
    for (const SpectralSample& sample : prepared_.samples()) {
        result.push_back(hts::directional_diffuse(shared, sample.wavelength, sample.index, prepared_.lobe()));
    }
    return result;
}

std::vector<double> SpectralReflectance::uniform_diffuse() const {
    std::vector<double> result;
    result.reserve(size());
    for (const SpectralSample& sample : prepared_.samples()) result.push_back(sample.uniform_diffuse);
    return result;
}

std::vector<SpecularReflectance> SpectralReflectance::specular_reflectance(const Direction& in) const {
    std::vector<double> values(size());
    prepared_.specular_reflectance(in, values);
    return {values.begin(), values.end()};
}

void SpectralReflectance::specular_reflectance(const Direction& in, std::span<double> result) const {
    require_size("specular_reflectance", result.size(), "wavelengths", size());
    prepared_.specular_reflectance(in, result);
}

std::vector<Mueller> SpectralReflectance::mueller(const DirectionPair& pair) const {
    std::vector<Mueller> result(size());
    prepared_.mueller(pair, result);
    return result;
}

void SpectralReflectance::mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    require_size("mueller", result.size(), "wavelengths", size());
    prepared_.mueller(pair, result);
}

std::vector<Mueller> SpectralReflectance::specular_mueller(const Direction& in) const {
    const View seen = view(prepared_.surface(), in);
    std::vector<Mueller> result;
    result.reserve(size());
    for (const SpectralSample& sample : prepared_.samples()) {
        result.push_back(hts::specular_mueller(prepared_.surface(), seen, sample.wavelength, sample.index));
    }
    return result;
}

}  // namespace hts::spectral
