/// How much was evaluated in how long.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace hts::cli {

/// Adds up the time between `start` and `stop`.
class Stopwatch {
  public:
    void start() noexcept { started_ = Clock::now(); }
    void stop() noexcept { seconds_ += std::chrono::duration<double>(Clock::now() - started_).count(); }
    [[nodiscard]] double seconds() const noexcept { return seconds_; }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point started_{};
    double seconds_ = 0;
};

struct Summary {
    std::size_t pairs, wavelengths;
    double seconds;  ///< with reading, drawing and writing

    /// "1000000 pairs x 31 wavelengths: 21.3 s, 1.46e+06 evaluations/s, 2 threads".
    [[nodiscard]] std::string text() const;
};

}  // namespace hts::cli
