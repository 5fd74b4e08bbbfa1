/// A loop over independent pieces of work, on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <utility>

#include "spectral/jobs/progress.hpp"

namespace hts::spectral {

/// Calls f(0) … f(count - 1) in any order on all cores, `chunk` at a time. If calls throw, the exception of
/// the lowest index is thrown again once all are through, so that the message is the same
/// for any number of threads. Throws Stopped where the process is asked to stop (jobs/progress.hpp).
template <class Function>
void parallel_for(std::size_t count, Function&& f, int chunk = 1) {
    const Job job{"", count};
    std::exception_ptr failure;
    std::size_t failed = count;
    std::atomic<bool> stopped{false};
#pragma omp parallel for schedule(dynamic, chunk) if (count > 1)
    for (std::ptrdiff_t j = 0; j < static_cast<std::ptrdiff_t>(count); ++j) {
        const auto i = static_cast<std::size_t>(j);
        if (stopped) continue;
        try {
            f(i);
            job.done();
        } catch (...) {
#pragma omp critical(hts_failure)
            if (i < failed) {
                failed = i;
                failure = std::current_exception();
            }
        }
        if (asked_to_stop()) stopped = true;
    }
    if (stopped) throw Stopped{};
    if (failure) std::rethrow_exception(failure);
}

/// The same in blocks, for work that needs buffers or is too small to be handed out one by one. Calls
/// f(first, number) so that each of 0 … count - 1 is in one block; all blocks but the
/// last hold `block` of them.
template <class Function>
void parallel_blocks(std::size_t count, std::size_t block, Function&& f) {
    parallel_for((count + block - 1) / block, [&](std::size_t i) {
        const std::size_t first = i * block;
        f(first, std::min(block, count - first));
    });
}

}  // namespace hts::spectral
