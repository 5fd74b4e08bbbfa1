#include "bench/micro/bench_inputs.hpp"

#include <cmath>

#include "hts/sampling/random.hpp"
#include "spectral/materials/optical_constants_files.hpp"

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

const std::vector<std::array<double, 3>>& bench_uniforms() {
    static const auto numbers = [] {
        Random random{20240603};
        std::vector<std::array<double, 3>> drawn(bench_inputs);
        for (auto& u : drawn) u = random.uniforms();
        return drawn;
    }();
    return numbers;
}

const spectral::Reflector& bench_reflector() {
    static const spectral::Reflector aluminium{
        "rough aluminium", {0.28, 1.77}, spectral::built_in_material("Al"), spectral::DiffuseAlbedo{0}};
    return aluminium;
}

spectral::WavelengthGrid bench_wavelengths(int count) {
    if (count == 1) return spectral::WavelengthGrid::from_micrometres({0.55});
    return spectral::WavelengthGrid::linear(0.4, 0.7, count);
}

spectral::SpectralReflectance bench_he_torrance(int wavelengths, DiffuseLobe lobe) {
    return {bench_reflector(), bench_wavelengths(wavelengths), spectral::OutsideRange::error, bench_tolerance,
            lobe};
}

OpticalConstants bench_constants(int wavelengths) {
    const spectral::WavelengthGrid grid = bench_wavelengths(wavelengths);
    OpticalConstants constants;
    for (const double um : grid.micrometres()) {
        const auto index = bench_reflector().material.index(Wavelength::from_micrometres(um));
        constants.n.push_back(index.n());
        constants.k.push_back(index.k());
    }
    return constants;
}

}  // namespace hts::bench
