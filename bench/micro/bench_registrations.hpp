/// The benchmarks of hts_bench by their names, and what their loops share.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>

namespace hts::bench {

/// phi/<tol>, phi_at_g/<tol>/<g>, phi_batch/<tol>, phi_series_adaptive/<g>, phi_series_windowed/<g>,
/// phi_series_from_one/<g>, phi_series_fixed/<terms>.
void register_phi();

/// eval/he/<n>, eval/ggx/<n>, eval_batch/he/<n>, eval_batch/ggx/<n>, mueller/he/<n>, specular/he/<n> at n
/// wavelengths; eval/pbrt/<n> and eval/pbrt_without_errno/<n>, the conductor of pbrt-v4 in both compilations;
/// eval/he_single/<n>, eval_batch/he_single/<n> and eval_pdf/he_single/4 of unit vectors in single precision;
/// reflectance/he/<n> beside spectrum/he/<n>: what spectral::Reflectance costs on top of HeTorranceSpectrum.
void register_spectral();

/// sample/<model>/4, draw/<model>, pdf/<model> of models he, ggx, pbrt and pbrt_without_errno: a direction
/// with its density and the weights at 4 wavelengths, without weights, and the density of a given pair;
/// sample/he_single/4.
void register_sampling();

/// eval/<model>/4, eval/<model>/31, sample/<model>/4 of the models of hts/microfacet/ at 4 and 31
/// wavelengths.
void register_microfacet();

/// lookup/he/n: one pair of directions at n wavelengths from a table of tolerance 1e-3, beside eval/he/n and
/// eval_batch/he/n.
void register_tables();

/// Counters after the loop: items per second and time per item.
inline void report_items(benchmark::State& state, std::size_t items_per_iteration) {
    const auto items = static_cast<double>(state.iterations()) * static_cast<double>(items_per_iteration);
    state.SetItemsProcessed(static_cast<std::int64_t>(items));
    state.counters["per_item"] =
        benchmark::Counter(items, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Walks through indices 0, step, 2 step … below `size`, a multiple of step, again and again.
class Cycle {
  public:
    explicit Cycle(std::size_t size, std::size_t step = 1) : size_{size}, step_{step} {}

    std::size_t next() noexcept {
        const std::size_t now = next_;
        next_ = now + step_ < size_ ? now + step_ : 0;
        return now;
    }

  private:
    std::size_t size_, step_;
    std::size_t next_ = 0;
};

}  // namespace hts::bench
