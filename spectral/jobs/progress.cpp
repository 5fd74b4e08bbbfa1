#include "spectral/jobs/progress.hpp"

#include <omp.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace hts::spectral {
namespace {

std::atomic<ClearProgress> watcher{nullptr};
std::atomic<AskedToStop> stop{nullptr};

/// The jobs under way, the outermost first.
struct Jobs {
    std::mutex mutex;
    std::vector<const Job*> all;
};
Jobs& jobs() {
    static Jobs jobs;
    return jobs;
}

}  // namespace

Job::Job(std::string step, std::size_t parts)
    : step_{std::move(step)},
      parts_{parts},
      begun_{std::chrono::steady_clock::now()},
      watched_{watcher.load() != nullptr && omp_in_parallel() == 0} {
    if (!watched_) return;
    const std::scoped_lock lock{jobs().mutex};
    jobs().all.push_back(this);
}

Job::~Job() {
    if (!watched_) return;
    bool last = false;
    {
        const std::scoped_lock lock{jobs().mutex};
        std::erase(jobs().all, this);
        last = jobs().all.empty();
    }
    if (last) clear_progress();
}

void Job::set_step(const std::string& step) const {
    const std::scoped_lock lock{jobs().mutex};
    step_ = step;
}

void Job::restart(const std::string& step) {
    const std::scoped_lock lock{jobs().mutex};
    step_ = step;
    done_ = 0;
    begun_ = std::chrono::steady_clock::now();
}

std::optional<JobState> job_state() {
    const std::scoped_lock lock{jobs().mutex};
    const auto& all = jobs().all;
    if (all.empty()) return std::nullopt;
    JobState state{"", 0, all.back()->begun_, all.front()->begun_};
    // NOLINTNEXTLINE(modernize-loop-convert): clang 14 does not take the library's views
    for (auto each = all.rbegin(); each != all.rend(); ++each) {
        const Job& job = **each;
        if (state.step.empty()) state.step = job.step_;
        const auto done = static_cast<double>(job.done_);
        if (job.parts_ == 1 && done == 0) continue;  // its time is that of what is inside
        state.begun = job.begun_;
        state.share =
            job.parts_ == 0 ? 0 : std::min(1.0, (done + state.share) / static_cast<double>(job.parts_));
    }
    return state;
}

void watch_jobs(ClearProgress clear) noexcept {
    watcher = clear;
}

void stop_jobs_where(AskedToStop asked) noexcept {
    stop = asked;
}

bool asked_to_stop() {
    const AskedToStop asked = stop.load();
    return asked != nullptr && omp_get_level() <= 1 && omp_get_thread_num() == 0 && asked();
}

void clear_progress() noexcept {
    if (const ClearProgress clear = watcher.load()) clear();
}

}  // namespace hts::spectral
