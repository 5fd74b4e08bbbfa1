#include "cli/io/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <iostream>

namespace hts::cli {
namespace {

constexpr int bar_columns = 40;

std::string bar(double share) {
    const int full = static_cast<int>(std::lround(share * bar_columns));
    return '[' + std::string(static_cast<std::size_t>(full), '#') +
           std::string(static_cast<std::size_t>(bar_columns - full), ' ') + ']';
}

}  // namespace

Progress::Progress() : terminal_{::isatty(STDERR_FILENO) == 1} {}

Progress::~Progress() {
    if (drawn_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::show(const std::string& step, double share) {
    if (!terminal_) return;
    const auto now = Clock::now();
    if (step != step_) {
        step_ = step;
        started_ = now;
        first_share_ = share;
    } else if (now - last_ < std::chrono::milliseconds{100}) {
        return;
    }
    last_ = now;
    drawn_ = true;
    std::cerr << "\r\033[K" << step << ' ' << bar(share) << ' ' << std::lround(100 * share) << " %";
    const double passed = std::chrono::duration<double>(now - started_).count();
    if (share > first_share_) {
        std::cerr << ", " << std::lround(passed * (1 - share) / (share - first_share_)) << " s left";
    }
    std::cerr << std::flush;
}

}  // namespace hts::cli
