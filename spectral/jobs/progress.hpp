/// How far a long job is, for whoever watches the process; nobody does unless the program asks for it. Not
/// installed.
///
///     const Job job{"tracing rays", surfaces.size()};
///     for (const auto& surface : surfaces) {
///         …
///         job.done();
///     }
///
/// It can also be asked to stop. A job inside another one counts as its share of the outer one's next part.
/// parallel_for is a job of its own.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace hts::spectral {

/// What a watcher sees.
struct JobState {
    std::string step;  ///< of the innermost job that has a name
    double share;      ///< 0 … 1 of the outermost job of several parts; 0 if nobody knows
    std::chrono::steady_clock::time_point begun;        ///< that job
    std::chrono::steady_clock::time_point first_begun;  ///< the outermost job
};

/// Outside of parallel regions, one thread at a time makes and ends jobs; inside, and where nobody watches, a
/// job is nothing.
class Job {
  public:
    ///   step    what is done, in a word or two; "" of a part that needs no name
    ///   parts   how many there are; 0 if nobody knows
    Job(std::string step, std::size_t parts);
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// So many more parts are done. Any thread may call.
    void done(std::size_t parts = 1) const noexcept {
        if (watched_) done_ += parts;
    }
    /// So many are done in all.
    void set_done(std::size_t parts) const noexcept { done_ = parts; }
    /// What is done now has another name.
    void set_step(const std::string& step) const;
    /// The same of what takes a time of its own: none of it is done yet.
    void restart(const std::string& step);

  private:
    friend std::optional<JobState> job_state();

    mutable std::string step_;
    std::size_t parts_;
    mutable std::atomic<std::size_t> done_{0};
    std::chrono::steady_clock::time_point begun_;
    bool watched_;
};

/// What a job throws that was asked to stop.
struct Stopped {};
/// Whether the process, or the thread, is to give up what it does; called now and then by the thread that
/// began a job. Null, as at first: never.
using AskedToStop = bool (*)();
void stop_jobs_where(AskedToStop asked) noexcept;
/// The same on the thread that began the outermost parallel region, or outside of one; on others never.
[[nodiscard]] bool asked_to_stop();

/// The jobs that are under way; none if there are none.
[[nodiscard]] std::optional<JobState> job_state();

/// Called before something else is written to where the progress is drawn, and when the outermost job ends.
using ClearProgress = void (*)();
/// From here on jobs are watched; null: no longer. To be called while none is under way.
void watch_jobs(ClearProgress clear) noexcept;
/// Does what the watcher gave, if there is one.
void clear_progress() noexcept;

}  // namespace hts::spectral
