#include "cli/io/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <streambuf>
#include <string_view>
#include <thread>

namespace hts::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t bar_columns = 40, least_bar_columns = 8;
constexpr double first_after = 1;  // s
constexpr std::chrono::milliseconds between{200};
constexpr std::string_view erasing = "\r\033[K";

std::mutex drawing_mutex;
std::atomic<bool> drawn{false};

void write_to_terminal(std::string_view text) noexcept {
    static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()) < 0);
}

/// "1 h 5 min", "2 min 5 s", "12 s".
std::string duration(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::min(seconds, 1e9)));
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::size_t terminal_columns() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : 80;
}

void erase_in_turn() noexcept {
    const std::scoped_lock lock{drawing_mutex};
    erase_progress();
}

}  // namespace

/// Hands on what is written to a stream, after it has erased what is drawn.
class ErasingBuffer : public std::streambuf {
  public:
    explicit ErasingBuffer(std::ostream& stream) : stream_{stream}, below_{stream.rdbuf()} {
        stream.rdbuf(this);
    }
    ~ErasingBuffer() override { stream_.rdbuf(below_); }
    ErasingBuffer(const ErasingBuffer&) = delete;
    ErasingBuffer& operator=(const ErasingBuffer&) = delete;

  protected:
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        erase_in_turn();
        return below_->sputc(traits_type::to_char_type(c));
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        erase_in_turn();
        return below_->sputn(text, size);
    }
    int sync() override {
        erase_in_turn();
        return below_->pubsync();
    }

  private:
    std::ostream& stream_;
    std::streambuf* below_;
};

std::string progress_line(const spectral::JobState& state, double seconds, std::size_t columns) {
    std::string end = " " + duration(seconds);
    if (state.share > 0) {
        const auto percent = static_cast<int>(std::floor(100 * std::min(state.share, 0.99)));
        end = " " + std::to_string(percent) + " %, " + duration(seconds * (1 - state.share) / state.share) +
              " left";
    }
    std::string line = state.step;
    const std::size_t used = line.size() + end.size() + 3;  // a blank and the ends of the bar
    if (state.share > 0 && used + least_bar_columns <= columns) {
        const std::size_t width = std::min(bar_columns, columns - used);
        const auto full = static_cast<std::size_t>(std::lround(state.share * static_cast<double>(width)));
        line += " [" + std::string(full, '#') + std::string(width - full, ' ') + "]";
    }
    line += end;
    return line.substr(0, columns);
}

void erase_progress() noexcept {
    if (drawn.exchange(false)) write_to_terminal(erasing);
}

struct ProgressWatcher::Drawing {
    std::unique_ptr<std::streambuf> out = std::make_unique<ErasingBuffer>(std::cout);
    std::unique_ptr<std::streambuf> errors = std::make_unique<ErasingBuffer>(std::cerr);
    std::mutex mutex;
    std::condition_variable ended;
    bool over = false;
    std::thread thread{[this] { draw_until_over(); }};

    void draw_until_over() {
        std::unique_lock lock{mutex};
        while (!ended.wait_for(lock, between, [this] { return over; })) draw();
    }
    static void draw() {
        const std::scoped_lock lock{drawing_mutex};
        const auto state = spectral::job_state();
        if (!state) return;
        const auto since = [now = Clock::now()](Clock::time_point begun) {
            return std::chrono::duration<double>(now - begun).count();
        };
        if (since(state->first_begun) < first_after) return;
        drawn = true;
        // a letter less than there is place for: some terminals go on to the next line after the last one
        write_to_terminal(std::string{erasing} +
                          progress_line(*state, since(state->begun), terminal_columns() - 1));
    }
};

ProgressWatcher::ProgressWatcher() {
    if (::isatty(STDERR_FILENO) != 1) return;
    spectral::watch_jobs(erase_in_turn);
    drawing_ = std::make_unique<Drawing>();
}

ProgressWatcher::~ProgressWatcher() {
    if (!drawing_) return;
    spectral::watch_jobs(nullptr);
    {
        const std::scoped_lock lock{drawing_->mutex};
        drawing_->over = true;
    }
    drawing_->ended.notify_all();
    drawing_->thread.join();
    erase_in_turn();
}

}  // namespace hts::cli
