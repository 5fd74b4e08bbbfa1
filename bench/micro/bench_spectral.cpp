// Benchmarks of whole BRDFs: this project's model and a GGX conductor of the same metal.

#include <omp.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <string>

#include "bench/micro/bench_inputs.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "bench/rivals/ggx_lanes.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/parallel.hpp"

namespace hts::bench {
namespace {

/// Number of wavelengths.
template <class Model>
std::size_t wavelengths_of(const Model& model) {
    if constexpr (std::same_as<Model, HeTorranceSpectrum>)
        return model.samples().size();
    else
        return model.size();
}

/// One pair of directions per iteration.
template <class Model>
void evaluate(benchmark::State& state, const Model& model) {
    const auto& pairs = bench_pairs();
    std::vector<double> result(wavelengths_of(model));
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        model.brdf(pairs[cycle.next()], std::span{result});
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// The same of unit vectors in single precision, by a model or by pbrt-v4's.
template <class Model>
void evaluate_vectors(benchmark::State& state, const Model& model) {
    const auto& pairs = bench_vectors();
    std::vector<float> result(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& [in, out] = pairs[cycle.next()];
        model.brdf(in, out, std::span{result});
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// BRDF and density together, as for multiple importance sampling.
void evaluate_with_density(benchmark::State& state) {
    const HeTorranceRendering model{bench_surface(), bench_samples(4)};
    const auto& pairs = bench_vectors();
    std::vector<float> result(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& [in, out] = pairs[cycle.next()];
        float density = model.brdf_and_pdf(in, out, result);
        benchmark::DoNotOptimize(density);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// A block of pairs per iteration.
template <class Value = double, class Model, class Pair>
void evaluate_batch(benchmark::State& state, const Model& model, const std::vector<Pair>& all) {
    const std::span pairs{all};
    std::vector<Value> result(bench_block * model.size());
    Cycle cycle{pairs.size(), bench_block};
    for (auto _ : state) {
        model.brdf(pairs.subspan(cycle.next(), bench_block), std::span{result});
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, bench_block);
}

template <class Model>
void evaluate_batch(benchmark::State& state, const Model& model) {
    evaluate_batch(state, model, bench_pairs());
}

void evaluate_batch(benchmark::State& state, const HeTorranceSingle& model) {
    evaluate_batch<float>(state, model, bench_vectors());
}

/// As a caller with arrays has it: angles [degrees] in, values out, a million pairs, so many threads.
void evaluate_arrays(benchmark::State& state, int wavelengths, int threads) {
    constexpr std::size_t count = 1000000, block = 256;
    struct Angles {
        std::vector<double> theta_i, theta_r, phi;
    };
    static const Angles angles = [] {
        Random random{20240604};
        Angles drawn;
        for (std::size_t i = 0; i < count; ++i) {
            drawn.theta_i.push_back(random.uniform(0, 89));
            drawn.theta_r.push_back(random.uniform(0, 89));
            drawn.phi.push_back(random.uniform(0, 360));
        }
        return drawn;
    }();
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    const auto model = bench_he_torrance(wavelengths);
    std::vector<double> result(count * model.size());
    for (auto _ : state) {
        spectral::parallel_blocks(count, block, [&](std::size_t first, std::size_t number) {
            static constexpr std::array<double, block> along_x{};
            thread_local std::vector<Direction> in(block, Direction::from_degrees(0, 0)), out = in;
            thread_local std::vector<spectral::DirectionPair> pairs;
            const auto part = [=](const std::vector<double>& of) {
                return std::span{of}.subspan(first, number);
            };
            Direction::from_degrees(part(angles.theta_i), std::span{along_x}.first(number),
                                    std::span{in}.first(number));
            Direction::from_degrees(part(angles.theta_r), part(angles.phi), std::span{out}.first(number));
            pairs.clear();
            for (std::size_t i = 0; i < number; ++i) pairs.push_back({in[i], out[i]});
            model.evaluator().brdf_batch(
                pairs, std::span{result}.subspan(first * model.size(), number * model.size()));
        });
        benchmark::ClobberMemory();
    }
    omp_set_num_threads(before);
    report_items(state, count);
}

HeTorranceSingle bench_single(int wavelengths, DiffuseLobe lobe = DiffuseLobe::full) {
    return {bench_surface(), bench_samples(wavelengths), lobe};
}

void specular(benchmark::State& state, const spectral::Reflectance& model) {
    const auto& pairs = bench_pairs();
    std::vector<double> result(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        model.specular_reflectance(pairs[cycle.next()].in, result);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

void mueller(benchmark::State& state, const spectral::Reflectance& model) {
    const auto& pairs = bench_pairs();
    std::vector<Mueller> result(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        model.mueller(pairs[cycle.next()], std::span{result});
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

void add(const std::string& name, int wavelengths, void (*benchmark)(benchmark::State&, int)) {
    benchmark::RegisterBenchmark((name + '/' + std::to_string(wavelengths)).c_str(), benchmark, wavelengths);
}

}  // namespace

void register_spectral() {
    for (const int n : {1, 4, 8, 16, 31}) {
        add("eval/he", n, [](benchmark::State& s, int w) { evaluate(s, bench_he_torrance(w)); });
        add("eval/ggx", n, [](benchmark::State& s, int w) { evaluate(s, bench_conductor(w)); });
        add("eval/pbrt", n, [](benchmark::State& s, int w) {
            evaluate_vectors(s, bench_pbrt_conductor(w, Compilation::as_pbrt_is_built));
        });
        add("eval/pbrt_without_errno", n, [](benchmark::State& s, int w) {
            evaluate_vectors(s, bench_pbrt_conductor(w, Compilation::without_errno));
        });
        add("eval/he_single", n, [](benchmark::State& s, int w) { evaluate_vectors(s, bench_single(w)); });
        add("eval_batch/he_single", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_single(w)); });
        add("eval_batch/he", n, [](benchmark::State& s, int w) { evaluate_batch(s, bench_he_torrance(w)); });
        add("eval_batch/ggx", n, [](benchmark::State& s, int w) { evaluate_batch(s, bench_conductor(w)); });
        add("eval/ggx_lanes", n,
            [](benchmark::State& s, int w) { evaluate(s, bench_conductor<LaneConductor>(w)); });
        add("eval_batch/ggx_lanes", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_conductor<LaneConductor>(w)); });
        add("specular/he", n, [](benchmark::State& s, int w) { specular(s, bench_he_torrance(w)); });
        add("mueller/he", n, [](benchmark::State& s, int w) { mueller(s, bench_he_torrance(w)); });
    }
    for (const int n : {1, 4, 31}) {
        add("arrays/he/threads:1", n, [](benchmark::State& s, int w) { evaluate_arrays(s, w, 1); });
        add("arrays/he/threads:2", n, [](benchmark::State& s, int w) { evaluate_arrays(s, w, 2); });
    }
    for (const int n : {4, 31}) {
        add("reflectance/he", n, [](benchmark::State& s, int w) { evaluate(s, bench_he_torrance(w)); });
        add("spectrum/he", n, [](benchmark::State& s, int w) { evaluate(s, bench_he_torrance_spectrum(w)); });
    }
    for (const int n : {4, 31}) {
        add("eval/he_1e-3", n,
            [](benchmark::State& s, int w) { evaluate(s, bench_he_torrance(w, Tolerance{1e-3})); });
        add("eval_batch/he_1e-3", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_he_torrance(w, Tolerance{1e-3})); });
        add("eval_batch/he_single_rough_limit", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_single(w, DiffuseLobe::rough_limit)); });
    }
    for (const int n : {4, 31}) {
        static constexpr UnifiedChoices shortcut{.conductor_shortcut = true};
        static const Tolerance coarse{1e-3};
        add("eval/he_unified", n, [](benchmark::State& s, int w) { evaluate(s, bench_he_unified(w)); });
        add("eval_batch/he_unified", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_he_unified(w)); });
        add("eval/he_unified_1e-3", n,
            [](benchmark::State& s, int w) { evaluate(s, bench_he_unified(w, coarse)); });
        add("eval_batch/he_unified_1e-3", n,
            [](benchmark::State& s, int w) { evaluate_batch(s, bench_he_unified(w, coarse)); });
        add("eval/he_unified_shortcut", n,
            [](benchmark::State& s, int w) { evaluate(s, bench_he_unified(w, bench_tolerance, shortcut)); });
        add("eval_batch/he_unified_shortcut", n, [](benchmark::State& s, int w) {
            evaluate_batch(s, bench_he_unified(w, bench_tolerance, shortcut));
        });
        add("mueller/he_unified", n, [](benchmark::State& s, int w) { mueller(s, bench_he_unified(w)); });
        add("specular/he_unified", n, [](benchmark::State& s, int w) { specular(s, bench_he_unified(w)); });
    }
    benchmark::RegisterBenchmark("eval_pdf/he_single/4", evaluate_with_density);
    add("eval/he_first_order", 4, [](benchmark::State& s, int w) {
        evaluate(s, bench_he_torrance(w, bench_tolerance, DiffuseLobe::first_order));
    });
    add("eval/he_rough_limit", 4, [](benchmark::State& s, int w) {
        evaluate(s, bench_he_torrance(w, bench_tolerance, DiffuseLobe::rough_limit));
    });
}

}  // namespace hts::bench
