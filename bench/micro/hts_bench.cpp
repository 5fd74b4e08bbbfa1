// hts_bench: times by Google Benchmark, all per item: one Phi, or one pair of directions at n wavelengths.
//
//   hts_bench --benchmark_filter='phi/' --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
//
// One at a time, an iteration is an item, so Benchmark's Time is per item. A batch's iteration is a block of
// many items: there the counter per_item is the time of one, in seconds with a unit ("5.1n" is 5.1 ns).
// Every benchmark has per_item, so scripts can read that alone.
// All on one core, unless OMP_NUM_THREADS says otherwise for the batches of BRDFs.
// Inputs are drawn beforehand with fixed seeds, 2^17 of each kind, and walked through in order.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cstdlib>

#include "bench/charts/machine.hpp"
#include "bench/micro/bench_registrations.hpp"

int main(int argc, char** argv) {
    if (std::getenv("OMP_NUM_THREADS") == nullptr) omp_set_num_threads(1);
    hts::bench::register_phi();
    hts::bench::register_spectral();
    hts::bench::register_microfacet();
    hts::bench::register_tables();
    hts::bench::register_sampling();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("hts", hts::bench::machine().text());
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
