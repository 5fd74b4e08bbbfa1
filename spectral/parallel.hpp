/// A loop over independent pieces of work, on all cores.
#pragma once

#include <cstddef>
#include <exception>
#include <utility>

namespace hts::spectral {

/// Calls f(0) … f(count - 1) in any order on all cores, `chunk` at a time. If calls throw, the exception of the lowest index is
/// thrown again once all are through, so that the message is the same for any number of threads.
template <class Function>
void parallel_for(std::size_t count, Function&& f, int chunk = 16) {
    std::exception_ptr failure;
    std::size_t failed = count;
#pragma omp parallel for schedule(dynamic, chunk)
    for (std::ptrdiff_t j = 0; j < static_cast<std::ptrdiff_t>(count); ++j) {
        const auto i = static_cast<std::size_t>(j);
        try {
            f(i);
        } catch (...) {
#pragma omp critical(hts_failure)
            if (i < failed) {
                failed = i;
                failure = std::current_exception();
            }
        }
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace hts::spectral
