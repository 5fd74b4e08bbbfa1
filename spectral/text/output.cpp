#include "spectral/text/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
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

/// The slot that now holds the path; none if it is longer than the system's longest or all are taken.
int claimed_slot(const std::string& path) {
    if (path.size() >= slots[0].path.size()) return -1;
    for (int i = 0; i < slot_count; ++i) {
        Slot& slot = slots[static_cast<std::size_t>(i)];
        if (int expected = Slot::free; !slot.state.compare_exchange_strong(expected, Slot::claimed)) continue;
        *std::copy(path.begin(), path.end(), slot.path.begin()) = '\0';
        slot.state = Slot::held;
        return i;
    }
    return -1;
}

/// Where a symbolic link leads.
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

void remove_partial_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == Slot::held) ::unlink(slot.path.data());
    }
}

std::string PartialFile::path_for(const std::string& target) {
    return target + ".partial-" + std::to_string(::getpid());
}

PartialFile::PartialFile(std::string target)
    : target_{std::move(target)}, path_{path_for(target_)}, slot_{claimed_slot(path_)} {}

PartialFile::~PartialFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
    forget();
}

bool PartialFile::finish() noexcept {
    if (::rename(path_.c_str(), target_.c_str()) != 0) return false;
    forget();
    return true;
}

void PartialFile::forget() noexcept {
    path_.clear();
    if (slot_ >= 0) slots[static_cast<std::size_t>(std::exchange(slot_, -1))].state = Slot::free;
}

Output::Output(std::string path) : path_{std::move(path)} {
    if (path_ == "-") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    const std::string target = followed(path_);
    if (std::error_code ignored; fs::is_directory(target, ignored)) {
        throw Error{path_ + ": is a directory: must be a file that can be written"};
    }
    if (is_device_or_pipe(target)) {
        descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        const std::string partial = PartialFile::path_for(target);
        descriptor_ = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) partial_.emplace(target);
    }
    if (descriptor_ < 0) fail();
}

Output::~Output() {
    if (path_ != "-" && descriptor_ >= 0) ::close(descriptor_);
}

void Output::write(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= buffer_size) flush();
}

void Output::commit() {
    flush();
    if (path_ == "-") return;
    if (::close(std::exchange(descriptor_, -1)) != 0) fail();
    if (partial_ && !partial_->finish()) fail();
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
