// Benchmarks of the models of hts/microfacet/ at several wavelengths: values of a model that differ in their
// reflectivities, through the face that programs use.

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/micro/bench_inputs.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "hts/microfacet/ashikhmin.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/walter.hpp"
#include "hts/microfacet/ward.hpp"
#include "spectral/models/model_evaluator.hpp"

namespace hts::bench {
namespace {

/// A model at a number of wavelengths.
using MakeReflectance = std::function<spectral::Reflectance(int wavelengths)>;

void evaluate(benchmark::State& state, const MakeReflectance& make, int wavelengths) {
    const spectral::Reflectance model = make(wavelengths);
    const auto& pairs = bench_pairs();
    std::vector<double> result(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        model.brdf(pairs[cycle.next()], result);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

/// A direction of the first wavelength and the weights of all.
void sample(benchmark::State& state, const MakeReflectance& make, int wavelengths) {
    const spectral::Reflectance model = make(wavelengths);
    const spectral::Sampler sampler = model.sampler(0);
    const auto& pairs = bench_pairs();
    const auto& uniforms = bench_uniforms();
    std::vector<double> weights(model.size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        const Direction& in = pairs[i].in;
        const auto drawn = sampler.sample(in, uniforms[i]);
        if (drawn.pdf > 0) {
            model.brdf({in, drawn.out}, weights);
            const double factor = drawn.out.cos_theta() / drawn.pdf;
            for (double& weight : weights) weight *= factor;
        }
        benchmark::DoNotOptimize(weights.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
}

void add(const std::string& name, const MakeReflectance& make) {
    for (const int n : {4, 31}) {
        benchmark::RegisterBenchmark(("eval/" + name + '/' + std::to_string(n)).c_str(),
                                     [make, n](benchmark::State& s) { evaluate(s, make, n); });
    }
    benchmark::RegisterBenchmark(("sample/" + name + "/4").c_str(),
                                 [make](benchmark::State& s) { sample(s, make, 4); });
}

/// One value of a model per wavelength.
template <class Model>
spectral::Reflectance reflectance_of(std::vector<Model> models) {
    const auto wavelengths = bench_wavelengths(static_cast<int>(models.size()));
    return spectral::Reflectance{std::make_shared<const spectral::ModelEvaluator<Model>>(
        "", wavelengths, std::move(models), std::vector<double>(wavelengths.size()), Tolerance{})};
}

/// make(k) for reflectivities k from 0.2 up.
template <class Make>
MakeReflectance by_reflectivity(const Make& make) {
    return [make](int wavelengths) {
        std::vector<decltype(make(0.0))> models;
        models.reserve(static_cast<std::size_t>(wavelengths));
        for (int i = 0; i < wavelengths; ++i) models.push_back(make(0.2 + 0.5 * i / wavelengths));
        return reflectance_of(std::move(models));
    };
}

/// A diffuse term and a lobe, weighted alike.
template <class Shape>
MakeReflectance with(const Shape& lobe) {
    return by_reflectivity([lobe](double k) { return DiffuseAndLobes<Shape>{k, {{k, lobe}}}; });
}

/// Facets of the metal, as wide as the lobe of bench_surface().
MakeReflectance metal(FacetDistribution (*facets)(double alpha)) {
    return [facets](int wavelengths) {
        const auto [n, k] = bench_indices(wavelengths);
        std::vector<WalterBrdf> models;
        for (std::size_t i = 0; i < n.size(); ++i)
            models.push_back(WalterBrdf{facets(bench_surface().slope_width()), {n[i], k[i]}});
        return reflectance_of(std::move(models));
    };
}

/// Painted plastic of the paper's Fig 7; the wavelengths differ in the albedo of the paint. Its tables are
/// made when first run.
MakeReflectance painted() {
    return by_reflectivity([](double albedo) {
        static const AshikhminFacets facets{NormalDensity::gaussian(0.1, 0.2)};
        return AshikhminBrdf{facets, FacetFresnel::schlick(0.05), albedo};
    });
}

}  // namespace

void register_microfacet() {
    add("walter", metal([](double alpha) { return FacetDistribution::beckmann(alpha); }));
    add("walter_ggx", metal(FacetDistribution::ggx));
    add("ashikhmin", painted());
    add("lambert", by_reflectivity([](double k) { return LambertianModel{k}; }));
    add("oren_nayar", by_reflectivity([](double k) { return OrenNayar{k, 0.4}; }));
    add("kurt", by_reflectivity([](double k) { return Kurt{k, {{k, {0.2, 0.1, 0.3, 0.2}}}}; }));
    add("ward", with(WardLobe{0.1, 0.3}));
    add("ward_duer", with(WardDuerLobe{0.1, 0.3}));
    add("cook_torrance", with(CookTorranceLobe{0.2, 0.3}));
    add("blinn_phong", with(BlinnPhongLobe{50}));
    add("ashikhmin_shirley", by_reflectivity([](double k) { return AshikhminShirley{k, {0.2, 20, 200}}; }));
    add("lafortune", with(LafortuneLobe{-1, -0.9, 50}));
}

}  // namespace hts::bench
