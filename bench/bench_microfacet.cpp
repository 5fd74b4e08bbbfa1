// Benchmarks of the models of hts/microfacet/ at four wavelengths: four values of a model that differ in their reflectivities.

#include <array>
#include <string>

#include "bench/bench_inputs.hpp"
#include "bench/bench_registrations.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/ward.hpp"

namespace hts::bench {
namespace {

template <ReflectanceModel Model>
using FourWavelengths = std::array<Model, 4>;

template <class Model>
void evaluate(benchmark::State& state, const FourWavelengths<Model>& models) {
    const auto& pairs = bench_pairs();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const auto& [in, out] = pairs[cycle.next()];
        for (const Model& model : models) benchmark::DoNotOptimize(model.brdf(in, out));
    }
    report_items(state, 1);
}

/// A direction of the first wavelength and the weights of all.
template <class Model>
void sample(benchmark::State& state, const FourWavelengths<Model>& models) {
    const auto& pairs = bench_pairs();
    const auto& uniforms = bench_uniforms();
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        const DrawnDirection drawn = models[0].sample(pairs[i].in, uniforms[i]);
        std::array<double, 4> weights{drawn.weight, 0, 0, 0};
        if (drawn.pdf > 0) {
            const double factor = drawn.out.cos_theta() / drawn.pdf;
            for (std::size_t k = 1; k < 4; ++k) weights[k] = factor * models[k].brdf(pairs[i].in, drawn.out);
        }
        benchmark::DoNotOptimize(weights);
    }
    report_items(state, 1);
}

/// Four values of a model, made from a reflectivity each.
template <class Make>
auto four(const Make& make) {
    return std::array{make(0.2), make(0.25), make(0.3), make(0.35)};
}

template <class Make>
void add(const std::string& name, const Make& make) {
    benchmark::RegisterBenchmark(("eval/" + name + "/4").c_str(),
                                 [make](benchmark::State& s) { evaluate(s, four(make)); });
    benchmark::RegisterBenchmark(("sample/" + name + "/4").c_str(),
                                 [make](benchmark::State& s) { sample(s, four(make)); });
}

/// A diffuse term and a lobe, weighted alike.
template <class Shape>
auto with(const Shape& lobe) {
    return [lobe](double k) { return DiffuseAndLobes<Shape>{k, {{k, lobe}}}; };
}

}  // namespace

void register_microfacet() {
    add("lambert", [](double k) { return LambertianModel{k}; });
    add("oren_nayar", [](double k) { return OrenNayar{k, 0.4}; });
    add("kurt", [](double k) { return Kurt{k, {{k, {0.2, 0.1, 0.3, 0.2}}}}; });
    add("ward", with(WardLobe{0.1, 0.3}));
    add("ward_duer", with(WardDuerLobe{0.1, 0.3}));
    add("cook_torrance", with(CookTorranceLobe{0.2, 0.3}));
    add("blinn_phong", with(BlinnPhongLobe{50}));
    add("ashikhmin_shirley", [](double k) { return AshikhminShirley{k, {0.2, 20, 200}}; });
    add("lafortune", with(LafortuneLobe{-1, -0.9, 50}));
}

}  // namespace hts::bench
