// Benchmarks of Phi: this project's and, for comparison, the series.

#include <array>
#include <string>
#include <utility>

#include "bench/micro/bench_inputs.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "bench/phi/phi_methods.hpp"
#include "hts/phi.hpp"

namespace hts::bench {
namespace {

struct NamedTolerance {
    const char* name;
    Tolerance tolerance;
};
constexpr std::array tolerances{NamedTolerance{"1e-3", Tolerance{1e-3}},
                                NamedTolerance{"1e-6", Tolerance{1e-6}},
                                NamedTolerance{"1e-12", Tolerance{1e-12}}};

constexpr std::array decades{"1e-3", "1e-2", "1e-1", "1e0", "1e1", "1e2",
                             "1e3",  "1e4",  "1e5",  "1e6", "1e7", "1e8"};

/// One value per iteration.
template <class Method>
void one_at_a_time(benchmark::State& state, const PhiInputs& inputs, Method&& method) {
    Cycle cycle{inputs.size()};
    for (auto _ : state) {
        const std::size_t i = cycle.next();
        benchmark::DoNotOptimize(method(inputs.g[i], inputs.t[i]));
    }
    report_items(state, 1);
}

template <class Method>
void add(const std::string& name, Method method) {
    benchmark::RegisterBenchmark(
        name.c_str(), [method](benchmark::State& state) { one_at_a_time(state, mixed_inputs(), method); });
}

template <class Method>
void add_at(const std::string& name, const char* g, Method method) {
    benchmark::RegisterBenchmark((name + '/' + g).c_str(), [method, g](benchmark::State& state) {
        const PhiInputs inputs = inputs_at(std::stod(g));
        one_at_a_time(state, inputs, method);
    });
}

void batch(benchmark::State& state, Tolerance tolerance) {
    const PhiInputs& inputs = mixed_inputs();
    std::vector<double> result(bench_block);
    Cycle cycle{inputs.size(), bench_block};
    for (auto _ : state) {
        const std::size_t first = cycle.next();
        phi(std::span{inputs.g}.subspan(first, bench_block), std::span{inputs.t}.subspan(first, bench_block),
            result, tolerance);
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, bench_block);
}

void register_ours() {
    for (const auto& [name, tolerance] : tolerances) {
        const auto method = [tolerance = tolerance](double g, double t) { return phi(g, t, tolerance); };
        add(std::string{"phi/"} + name, method);
        benchmark::RegisterBenchmark((std::string{"phi_batch/"} + name).c_str(), batch, tolerance);
        for (const char* g : decades) add_at(std::string{"phi_at_g/"} + name, g, method);
    }
}

void register_series() {
    for (const char* g : {"1e-2", "1e0", "1e1", "1e2", "3e2"}) {
        add_at("phi_series_adaptive", g, [](double x, double t) { return phi_series_adaptive(x, t); });
    }
    for (const char* g : {"1e0", "1e1", "1e2", "1e3", "1e4", "1e5", "1e6"}) {
        add_at("phi_series_windowed", g, [](double x, double t) { return phi_series_windowed(x, t); });
        add_at("phi_series_from_one", g, phi_series_from_one);
    }
    for (const int terms : {10, 40, 64, 200}) {
        add("phi_series_fixed/" + std::to_string(terms),
            [terms](double g, double t) { return phi_series_fixed(g, t, terms); });
    }
}

}  // namespace

void register_phi() {
    register_ours();
    register_series();
}

}  // namespace hts::bench
