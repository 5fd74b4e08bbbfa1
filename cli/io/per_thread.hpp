/// A value for each thread, so that none waits for another.
#pragma once

#include <omp.h>

#include <cstddef>
#include <vector>

namespace hts::cli {

template <class Value>
class PerThread {
  public:
    /// That of the calling thread.
    [[nodiscard]] Value& mine() { return slots_[static_cast<std::size_t>(omp_get_thread_num())].value; }
    /// Calls f(value) for each, once the threads are through.
    template <class Function>
    void for_each(const Function& f) const {
        for (const Slot& slot : slots_) f(slot.value);
    }

  private:
    struct alignas(128) Slot {  // no cache line in common
        Value value{};
    };
    std::vector<Slot> slots_ = std::vector<Slot>(static_cast<std::size_t>(omp_get_max_threads()));
};

}  // namespace hts::cli
