#include "bench/micro/bench_inputs.hpp"

#include <cmath>

#include "hts/sampling/random.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"

namespace hts::bench {
namespace {

PhiInputs drawn(double least_g, double most_g) {
    Random random{20240601};
    PhiInputs inputs;
    for (std::size_t i = 0; i < bench_inputs; ++i) {
        const double g = random.logarithmic(least_g, most_g);
        inputs.g.push_back(g);
        inputs.t.push_back(g * random.uniform(0, 50));
    }
    return inputs;
}

}  // namespace

const PhiInputs& mixed_inputs() {
    static const PhiInputs inputs = drawn(1e-3, 1e6);
    return inputs;
}

PhiInputs inputs_at(double g) {
    return drawn(g, g);
}

const std::vector<spectral::DirectionPair>& bench_pairs() {
    static const std::vector<spectral::DirectionPair> pairs = [] {
        Random random{20240602};
        std::vector<spectral::DirectionPair> drawn;
        for (std::size_t i = 0; i < bench_inputs; ++i) {
            const Direction in = random.direction();
            drawn.push_back({in, random.direction()});
        }
        return drawn;
    }();
    return pairs;
}

const std::vector<VectorPair>& bench_vectors() {
    static const auto vectors = [] {
        std::vector<VectorPair> converted;
        for (const auto& [in, out] : bench_pairs()) converted.push_back({single(in), single(out)});
        return converted;
    }();
    return vectors;
}

const std::vector<std::array<double, 3>>& bench_uniforms() {
    static const auto numbers = [] {
        Random random{20240603};
        std::vector<std::array<double, 3>> drawn(bench_inputs);
        for (auto& u : drawn) u = random.uniforms();
        return drawn;
    }();
    return numbers;
}

Surface bench_surface() {
    return {0.28, 1.77};
}

const spectral::Material& bench_material() {
    static const auto aluminium = spectral::he_torrance_material("rough aluminium", bench_surface(),
                                                                 spectral::built_in_optical_constants("Al"));
    return aluminium;
}

spectral::WavelengthGrid bench_wavelengths(int count) {
    if (count == 1) return spectral::WavelengthGrid::from_micrometres({0.55});
    return spectral::WavelengthGrid::linear(0.4, 0.7, count);
}

spectral::Reflectance bench_he_torrance(int wavelengths, Tolerance tolerance, DiffuseLobe lobe) {
    return bench_material().at(bench_wavelengths(wavelengths), {.tolerance = tolerance, .lobe = lobe});
}

spectral::Reflectance bench_he_unified(int wavelengths, Tolerance tolerance, const UnifiedChoices& choices) {
    const spectral::RoughSurface surface{bench_surface(), choices};
    return spectral::he_torrance_material("rough aluminium", surface,
                                          spectral::built_in_optical_constants("Al"))
        .at(bench_wavelengths(wavelengths), {.tolerance = tolerance});
}

HeTorranceSpectrum bench_he_torrance_spectrum(int wavelengths) {
    return {bench_surface(), bench_samples(wavelengths), bench_tolerance};
}

std::vector<SpectralSample> bench_samples(int wavelengths) {
    const auto reflectance = bench_he_torrance(wavelengths);
    const auto samples = reflectance.samples();
    return {samples.begin(), samples.end()};
}

MetalIndices bench_indices(int wavelengths) {
    const auto reflectance = bench_he_torrance(wavelengths);
    MetalIndices indices;
    for (const SpectralSample& sample : reflectance.samples()) {
        indices.n.push_back(sample.index.substrate().n());
        indices.k.push_back(sample.index.substrate().k());
    }
    return indices;
}

PbrtConductor bench_pbrt_conductor(int wavelengths, Compilation compilation) {
    const auto [n, k] = bench_indices(wavelengths);
    return {bench_surface().slope_width(), n, k, compilation};
}

}  // namespace hts::bench
