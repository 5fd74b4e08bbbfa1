// Benchmarks of lookup tables beside the model they are of, on the same surface, wavelengths and pairs of
// directions.

#include <map>
#include <memory>
#include <string>

#include "bench/micro/bench_inputs.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "tables/table/build_table.hpp"

namespace hts::bench {
namespace {

/// Built when first asked for, in some seconds.
const tables::Table& bench_table(int wavelengths) {
    static std::map<int, std::unique_ptr<const tables::Table>> built;
    auto& table = built[wavelengths];
    if (!table) {
        const auto model = bench_he_torrance(wavelengths);
        table = std::make_unique<const tables::Table>(
            tables::build_table(model, {model.name(), "", ""}, {.tolerance = 1e-3}));
    }
    return *table;
}

void lookup(benchmark::State& state, int wavelengths) {
    const tables::Table& table = bench_table(wavelengths);
    const auto& pairs = bench_pairs();
    std::vector<double> result(table.wavelengths().size());
    Cycle cycle{pairs.size()};
    for (auto _ : state) {
        table.brdf(pairs[cycle.next()], std::span{result});
        benchmark::DoNotOptimize(result.data());
        benchmark::ClobberMemory();
    }
    report_items(state, 1);
    state.counters["bytes"] = static_cast<double>(table.bytes());
}

}  // namespace

void register_tables() {
    for (const int n : {1, 4, 8, 16, 31}) {
        benchmark::RegisterBenchmark(("lookup/he/" + std::to_string(n)).c_str(), lookup, n);
    }
}

}  // namespace hts::bench
