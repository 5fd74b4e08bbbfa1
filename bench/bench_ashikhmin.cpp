// Benchmarks of the reflectance made from a density of normals, Ashikhmin 2000.

#include <array>

#include "bench/bench_inputs.hpp"
#include "bench/bench_registrations.hpp"
#include "hts/microfacet/ashikhmin.hpp"

namespace hts::bench {
namespace {

/// Painted plastic of the paper's Fig 7, at four wavelengths that differ in the albedo of the paint.
std::array<AshikhminBrdf, 4> painted() {
    const AshikhminFacets facets{NormalDensity::gaussian(0.1, 0.2)};
    const auto at = [&](double albedo) { return AshikhminBrdf{facets, FacetFresnel::schlick(0.05), albedo}; };
    return {at(0.2), at(0.4), at(0.6), at(0.8)};
}

/// The geometry once, then each wavelength.
std::array<double, 4> values(const std::array<AshikhminBrdf, 4>& models, const Direction& in,
                             const Direction& out) {
    const FacetPair pair = models[0].facets().pair(in, out);
    std::array<double, 4> result{};
    for (std::size_t i = 0; i < 4; ++i) result[i] = models[i].brdf(pair, in, out);
    return result;
}

void evaluate(benchmark::State& state) {
    const auto models = painted();
    const auto& pairs = bench_pairs();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& [in, out] = pairs[cycle.next()];
        auto result = values(models, in, out);
        benchmark::DoNotOptimize(result);
    }
    report_items(state, 1);
}

/// Drawn at the first wavelength.
void sample(benchmark::State& state) {
    const auto models = painted();
    const auto& pairs = bench_pairs();
    const auto& uniforms = bench_uniforms();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        auto drawn = models[0].sample(pairs[i].in, uniforms[i]);
        auto result = values(models, pairs[i].in, drawn.out);
        benchmark::DoNotOptimize(drawn);
        benchmark::DoNotOptimize(result);
    }
    report_items(state, 1);
}

}  // namespace

void register_ashikhmin() {
    benchmark::RegisterBenchmark("eval/ashikhmin/4", evaluate);
    benchmark::RegisterBenchmark("sample/ashikhmin/4", sample);
}

}  // namespace hts::bench
