// Benchmarks of drawing directions and of their density: this project's model and a GGX conductor of the same
// metal.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bench/micro/bench_inputs.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "bench/rivals/ggx_sampling.hpp"
#include "hts/he_torrance.hpp"

namespace hts::bench {
namespace {

HeTorrance he_sampler() {
    return {bench_surface(), bench_he_torrance(1).samples().front(), bench_tolerance};
}

GgxSampler ggx_sampler() {
    return GgxSampler{bench_surface().slope_width()};
}

/// A direction, its density and the weights of n wavelengths.
template <class Model, class Draw>
void sample(benchmark::State& state, const Model& model, const Draw& draw) {
    const auto& pairs = bench_pairs();
    const auto& uniforms = bench_uniforms();
    std::vector<double> weights(model.size());
    Cycle cycle{pairs.size()};
    benchmark::DoNotOptimize(draw(pairs[0].in, uniforms[0]));  // prepared before the clock runs
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        const Direction& in = pairs[i].in;
        const auto drawn = draw(in, uniforms[i]);
        if (drawn.pdf > 0) {
            model.brdf({in, drawn.out}, std::span{weights});
            const double factor = drawn.out.cos_theta() / drawn.pdf;
            for (double& weight : weights) weight *= factor;
        }
        benchmark::DoNotOptimize(weights.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// The same in single precision.
///   draw   model.sample of a view, its numbers and the BRDF that it gives
template <class Model, class Draw>
void sample_single(benchmark::State& state, const Model& model, const Draw& draw) {
    const auto& pairs = bench_vectors();
    const auto& uniforms = bench_uniforms();
    std::vector<float> weights(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        const auto drawn = draw(pairs[i].in, uniforms[i], weights);
        if (drawn.pdf > 0) {
            const float factor = drawn.out.z / drawn.pdf;
            for (float& weight : weights) weight *= factor;
        }
        benchmark::DoNotOptimize(weights.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// What pbrt-v4 does.
void sample_pbrt(benchmark::State& state, Compilation compilation) {
    const PbrtConductor model = bench_pbrt_conductor(4, compilation);
    sample_single(state, model, [&](const Vector3f& in, const Uniforms& u, std::span<float> brdf) {
        return model.sample(in, {u[1], u[2]}, brdf);
    });
}

/// By the mixture of three wavelengths.
void sample_he_single(benchmark::State& state) {
    const HeTorranceRendering model{bench_surface(), bench_samples(4)};
    sample_single(state, model, [&](const Vector3f& in, const Uniforms& u, std::span<float> brdf) {
        const auto single = [](double x) { return std::min(static_cast<float>(x), 0x1.fffffep-1F); };
        return model.sample(in, {single(u[0]), single(u[1]), single(u[2]), single(u[0])}, brdf);
    });
}

void draw_pbrt(benchmark::State& state, Compilation compilation) {
    const PbrtConductor model = bench_pbrt_conductor(4, compilation);
    const auto& pairs = bench_vectors();
    const auto& uniforms = bench_uniforms();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        auto drawn = model.draw(pairs[i].in, {uniforms[i][1], uniforms[i][2]});
        benchmark::DoNotOptimize(drawn);
    }
    report_items(state, 1);
}

void pdf_pbrt(benchmark::State& state, Compilation compilation) {
    const PbrtConductor model = bench_pbrt_conductor(4, compilation);
    const auto& pairs = bench_vectors();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& pair = pairs[cycle.next()];
        benchmark::DoNotOptimize(model.pdf(pair.in, pair.out));
    }
    report_items(state, 1);
}

template <class Draw>
void draw_only(benchmark::State& state, const Draw& draw) {
    const auto& pairs = bench_pairs();
    const auto& uniforms = bench_uniforms();
    Cycle cycle{pairs.size()};
    benchmark::DoNotOptimize(draw(pairs[0].in, uniforms[0]));  // prepared before the clock runs
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        auto drawn = draw(pairs[i].in, uniforms[i]);
        benchmark::DoNotOptimize(drawn);
    }
    report_items(state, 1);
}

template <class Sampler>
void pdf(benchmark::State& state, const Sampler& sampler) {
    const auto& pairs = bench_pairs();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& pair = pairs[cycle.next()];
        benchmark::DoNotOptimize(sampler.pdf(pair.in, pair.out));
    }
    report_items(state, 1);
}

}  // namespace

void register_sampling() {
    static const auto he = [](const Direction& in, const Uniforms& u) {
        static const HeTorrance sampler = he_sampler();
        return sampler.draw(in, u);
    };
    static const auto ggx = [](const Direction& in, const Uniforms& u) {
        static const GgxSampler sampler = ggx_sampler();
        return sampler.draw(in, {u[1], u[2]});
    };
    const auto add = [](const char* name, void (*run)(benchmark::State&)) {
        benchmark::RegisterBenchmark(name, run);
    };
    add("sample/he/4", [](benchmark::State& s) { sample(s, bench_he_torrance(4), he); });
    add("sample/ggx/4", [](benchmark::State& s) { sample(s, bench_conductor(4), ggx); });
    const auto both = [](const std::string& name, const char* after,
                         void (*run)(benchmark::State&, Compilation)) {
        benchmark::RegisterBenchmark((name + "/pbrt" + after).c_str(), run, Compilation::as_pbrt_is_built);
        benchmark::RegisterBenchmark((name + "/pbrt_without_errno" + after).c_str(), run,
                                     Compilation::without_errno);
    };
    add("sample/he_single/4", sample_he_single);
    both("sample", "/4", sample_pbrt);
    both("draw", "", draw_pbrt);
    both("pdf", "", pdf_pbrt);
    add("draw/he", [](benchmark::State& s) { draw_only(s, he); });
    add("draw/ggx", [](benchmark::State& s) { draw_only(s, ggx); });
    add("pdf/he", [](benchmark::State& s) { pdf(s, he_sampler()); });
    add("pdf/ggx", [](benchmark::State& s) { pdf(s, ggx_sampler()); });
}

}  // namespace hts::bench
