/// The progress of a long job, drawn on standard error where that is a terminal: what is done, a bar, the
/// share and the time left, on a line of its own that is gone before anything else is written.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "spectral/jobs/progress.hpp"

namespace hts::cli {

/// The line that is drawn, at most `columns` letters: "tracing [####    ] 52 %, 1 min 20 s left"; the time
/// that has passed where nobody knows the share.
///   seconds   since the job began
[[nodiscard]] std::string progress_line(const spectral::JobState& state, double seconds, std::size_t columns);

/// Draws for as long as it lives, from the second second of a job on.
class ProgressWatcher {
  public:
    ProgressWatcher();
    ~ProgressWatcher();
    ProgressWatcher(const ProgressWatcher&) = delete;
    ProgressWatcher& operator=(const ProgressWatcher&) = delete;

  private:
    struct Drawing;
    std::unique_ptr<Drawing> drawing_;  // none where standard error is no terminal
};

/// Erases what is drawn. Safe to call from a signal handler.
void erase_progress() noexcept;

}  // namespace hts::cli
