#include "spectral/text/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t{4} << 20;

/// The path of a partial file, kept where a signal handler may read it.
struct Slot {
    enum State { free, claimed, held };
    std::atomic<int> state;
    std::array<char, 4096> path;
};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int slot_count = 1024;  // as many files as a process commonly may have open
std::array<Slot, slot_count> slots{};

extern "C" void remove_partials(int signal) {
    for (const Slot& slot : slots) {
        if (slot.state == Slot::held) ::unlink(slot.path.data());
    }
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

/// The slot that now holds the path; none if it is longer than the system's longest or all are taken.
int claimed_slot(const std::string& path) {
    if (path.size() >= slots[0].path.size()) return -1;
    for (int i = 0; i < slot_count; ++i) {
        Slot& slot = slots[static_cast<std::size_t>(i)];
        if (int expected = Slot::free; !slot.state.compare_exchange_strong(expected, Slot::claimed)) continue;
        *std::copy(path.begin(), path.end(), slot.path.begin()) = '\0';
        slot.state = Slot::held;
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            static_cast<void>(std::signal(signal, remove_partials));
        return i;
    }
    return -1;
}

std::string followed(const std::string& path) {
    std::error_code ignored;
    return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored).string() : path;
}

bool is_device_or_pipe(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

Output::Output(std::string path) : path_{std::move(path)}, target_{followed(path_)} {
    if (path_ == "-") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    if (std::error_code ignored; fs::is_directory(target_, ignored)) {
        throw Error{path_ + ": is a directory: must be a file that can be written"};
    }
    const bool direct = is_device_or_pipe(target_);
    if (!direct) partial_ = target_ + ".partial-" + std::to_string(::getpid());
    descriptor_ = direct ? ::open(target_.c_str(), O_WRONLY | O_CLOEXEC)
                         : ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail();
    if (!direct) slot_ = claimed_slot(partial_);
}

Output::~Output() {
    discard();
}

void Output::write(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= buffer_size) flush();
}

void Output::commit() {
    flush();
    if (path_ == "-") return;
    if (::close(std::exchange(descriptor_, -1)) != 0) fail();
    if (partial_.empty()) return;
    if (::rename(partial_.c_str(), target_.c_str()) != 0) fail();
    forget_partial();
}

void Output::flush() {
    for (std::string_view rest = buffer_; !rest.empty();) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
}

void Output::discard() noexcept {
    if (path_ != "-" && descriptor_ >= 0) ::close(descriptor_);
    if (partial_.empty()) return;
    ::unlink(partial_.c_str());
    forget_partial();
}

void Output::forget_partial() noexcept {
    partial_.clear();
    if (slot_ >= 0) slots[static_cast<std::size_t>(std::exchange(slot_, -1))].state = Slot::free;
}

void Output::fail() const {
    throw Error{(path_ == "-" ? "standard output" : path_) + ": cannot be written (" + std::strerror(errno) +
                "): must be a file that can be written"};
}

void write_file(const std::string& path, std::string_view text) {
    Output output{path};
    output.write(text);
    output.commit();
}

void write_files(const std::vector<TextFile>& files) {
    std::vector<std::unique_ptr<Output>> outputs;
    for (const TextFile& file : files) {
        outputs.push_back(std::make_unique<Output>(file.path));
        outputs.back()->write(file.text);
        outputs.back()->flush();
    }
    for (const auto& output : outputs) output->commit();
}

}  // namespace hts::spectral
