/// What the benchmarks share: inputs drawn beforehand with a fixed seed, and the surface that is evaluated.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/phi/accuracy_sweep.hpp"
#include "bench/rivals/ggx.hpp"
#include "bench/rivals/pbrt_conductor.hpp"
#include "hts/rendering/he_torrance_single.hpp"
#include "hts/unified/unified_choices.hpp"
#include "spectral/models/material.hpp"

namespace hts::bench {

/// More than any cache of first or second level and any branch predictor remembers.
inline constexpr std::size_t bench_inputs = std::size_t{1} << 17;

/// Values per call of a batch benchmark: its inputs and results fit the first-level cache.
inline constexpr std::size_t bench_block = 1024;

/// g log-uniform in 1e-3 ... 1e6, t/g uniform in 0 ... 50.
[[nodiscard]] const PhiInputs& mixed_inputs();

/// The same t/g at one g.
[[nodiscard]] PhiInputs inputs_at(double g);

/// Pairs of directions, each uniform in solid angle over the hemisphere.
[[nodiscard]] const std::vector<spectral::DirectionPair>& bench_pairs();

/// The same pairs as unit vectors in single precision.
[[nodiscard]] const std::vector<VectorPair>& bench_vectors();

/// Numbers to draw directions from, as many as there are pairs.
[[nodiscard]] const std::vector<std::array<double, 3>>& bench_uniforms();

/// sigma_0 = 0.28 um, tau = 1.77 um: the aluminium of He et al.
[[nodiscard]] Surface bench_surface();
[[nodiscard]] const spectral::Material& bench_material();

/// `count` wavelengths over 0.4 ... 0.7 um.
[[nodiscard]] spectral::WavelengthGrid bench_wavelengths(int count);

/// The accuracy at which wave optics are compared with microfacets.
inline constexpr Tolerance bench_tolerance{1e-6};

/// That material at those wavelengths, and the prepared spectrum beneath it.
[[nodiscard]] spectral::Reflectance bench_he_torrance(int wavelengths, Tolerance tolerance = bench_tolerance,
                                                      DiffuseLobe lobe = DiffuseLobe::full);
[[nodiscard]] HeTorranceSpectrum bench_he_torrance_spectrum(int wavelengths);
/// The same surface by the successor.
[[nodiscard]] spectral::Reflectance bench_he_unified(int wavelengths, Tolerance tolerance = bench_tolerance,
                                                     const UnifiedChoices& choices = {});

/// The metal's refractive indices at those wavelengths.
struct MetalIndices {
    std::vector<double> n, k;
};
[[nodiscard]] MetalIndices bench_indices(int wavelengths);

/// GGX facets of the same metal, as wide as the He-Torrance lobe: alpha = 2 sigma_0/tau.
template <class Conductor = RoughConductor>
[[nodiscard]] Conductor bench_conductor(int wavelengths) {
    const auto [n, k] = bench_indices(wavelengths);
    return {bench_surface().slope_width(), n, k};
}

[[nodiscard]] PbrtConductor bench_pbrt_conductor(int wavelengths, Compilation compilation);

/// What the material is at those wavelengths.
[[nodiscard]] std::vector<SpectralSample> bench_samples(int wavelengths);

}  // namespace hts::bench
