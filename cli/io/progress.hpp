/// A progress bar with the time left, on standard error when that is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace hts::cli {

class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    ///   step    what is done, a word; each has its own bar
    ///   share   0 ... 1 of it
    void show(const std::string& step, double share);

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_, drawn_ = false;
    std::string step_;
    double first_share_ = 0;
    Clock::time_point started_{}, last_{};
};

}  // namespace hts::cli
