// hts_bench: times by Google Benchmark, all per item: one Phi, or one pair of directions at n wavelengths.
//
//   hts_bench --benchmark_filter='phi/' --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
//
// One at a time, an iteration is an item, so Benchmark's Time is per item. A batch's iteration is a block of
// many items: there the counter per_item is the time of one, in seconds with a unit ("5.1n" is 5.1 ns).
// Every benchmark has per_item, so scripts can read that alone.
// --instructions=avx2 or sse4, before all other arguments, leaves out every wider instruction set of x86, for
// the library and for the yardsticks alike; the context says which is used.
// All on one core, unless OMP_NUM_THREADS says otherwise for the batches of BRDFs.
// Inputs are drawn beforehand with fixed seeds, 2^17 of each kind, and walked through in order.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cstdlib>
#include <string_view>

#include "bench/charts/machine.hpp"
#include "bench/micro/bench_registrations.hpp"
#include "hwy/targets.h"

namespace {

/// Whether the argument was of this kind; better targets have lower bits.
bool limits_instructions(std::string_view argument) {
    if (argument == "--instructions=avx2") {
        hwy::DisableTargets(HWY_AVX2 - 1);
    } else if (argument == "--instructions=sse4") {
        hwy::DisableTargets(HWY_SSE4 - 1);
    } else {
        return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && limits_instructions(argv[1])) {
        argv[1] = argv[0];
        --argc;
        ++argv;
    }
    if (std::getenv("OMP_NUM_THREADS") == nullptr) omp_set_num_threads(1);
    hts::bench::register_phi();
    hts::bench::register_spectral();
    hts::bench::register_microfacet();
    hts::bench::register_tables();
    hts::bench::register_sampling();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("hts", hts::bench::machine().text());
    const auto targets = hwy::SupportedTargets();
    benchmark::AddCustomContext("lanes", hwy::TargetName(targets & -targets));
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
