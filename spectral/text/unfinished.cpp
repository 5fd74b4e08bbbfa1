#include "spectral/text/unfinished.hpp"

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include "spectral/text/output.hpp"

namespace hts::spectral {
namespace {

/// A path, kept where a signal handler may read it.
struct Slot {
    enum State { free, claimed, file, folder };
    std::atomic<int> state;
    std::array<char, 4096> path;
};
static_assert(std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<pid_t>::is_always_lock_free);

constexpr std::size_t slot_count = 1024;  // as many files as a process commonly may have open
std::array<Slot, slot_count> slots{};
std::atomic<pid_t> helper{0};

/// The slot that now holds the path; -1 if it is longer than the system's longest or all are taken.
int claimed_slot(const std::string& path, Slot::State kind) noexcept {
    if (path.size() >= slots[0].path.size()) return -1;
    for (std::size_t i = 0; i < slot_count; ++i) {
        Slot& slot = slots[i];
        if (int expected = Slot::free; !slot.state.compare_exchange_strong(expected, Slot::claimed)) continue;
        *std::copy(path.begin(), path.end(), slot.path.begin()) = '\0';
        slot.state = kind;
        return static_cast<int>(i);
    }
    return -1;
}

}  // namespace

void remove_partial_files() noexcept {
    if (const pid_t process = helper.exchange(0); process > 0) {
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
    }
    for (const Slot& slot : slots) {
        if (slot.state == Slot::file) ::unlink(slot.path.data());
    }
    for (std::size_t i = slot_count; i-- > 0;) {  // inner folders are younger
        if (slots[i].state == Slot::folder) ::rmdir(slots[i].path.data());
    }
}

void set_helper_process(pid_t process) noexcept {
    helper = process;
}

Unfinished::Unfinished(const std::string& path, Kind kind) noexcept
    : slot_{claimed_slot(path, kind == Kind::file ? Slot::file : Slot::folder)} {}

Unfinished::~Unfinished() {
    if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = Slot::free;
}

}  // namespace hts::spectral
