#include "spectral/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
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

std::array<char, 4096> partial_of_signal{};  // what the handler removes; only one Output writes at a time

extern "C" void remove_partial(int signal) {
    if (partial_of_signal[0] != '\0') ::unlink(partial_of_signal.data());
    static_cast<void>(std::signal(signal, SIG_DFL));
    static_cast<void>(std::raise(signal));
}

void remove_on_signal(const std::string& path) {
    partial_of_signal[0] = '\0';
    if (path.empty() || path.size() >= partial_of_signal.size()) return;
    std::copy(path.begin() + 1, path.end(), partial_of_signal.begin() + 1);
    partial_of_signal[path.size()] = '\0';
    partial_of_signal[0] = path[0];
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) static_cast<void>(std::signal(signal, remove_partial));
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
    remove_on_signal(partial_);
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
    partial_.clear();
    remove_on_signal("");
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
    partial_of_signal[0] = '\0';
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
