#include "spectral/text/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/text/run_files.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t buffer_size = std::size_t{4} << 20;

}  // namespace

Output::Output(std::string path) : path_{std::move(path)} {
    if (RunFiles* const run = RunFiles::of_process()) {
        open(*run);
    } else {
        own_run_ = std::make_unique<RunFiles>();
        open(*own_run_);
    }
}

Output::Output(std::string path, RunFiles& run) : path_{std::move(path)} {
    open(run);
}

void Output::open(RunFiles& run) {
    if (path_ == "-") {
        descriptor_ = STDOUT_FILENO;
    } else if (is_written_directly(path_)) {
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        descriptor_ = ::open(run.open(path_).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        run_ = &run;
    }
    if (descriptor_ < 0) fail();
}

Output::~Output() {
    if (path_ == "-" || descriptor_ < 0) return;
    ::close(descriptor_);
    if (run_ != nullptr) run_->drop(path_);
}

void Output::write(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= buffer_size) flush();
}

void Output::commit() {
    flush();
    if (path_ == "-") return;
    if (::close(std::exchange(descriptor_, -1)) != 0) fail();
    if (run_ != nullptr) run_->complete(path_);
    if (own_run_) own_run_->commit();
}

void Output::flush() {
    if (descriptor_ == STDOUT_FILENO) clear_progress();
    for (std::string_view rest = buffer_; !rest.empty();) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
}

void Output::write_at_start(std::string_view text) {
    flush();
    if (::pwrite(descriptor_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) fail();
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
    std::optional<RunFiles> own;
    RunFiles* run = RunFiles::of_process();
    if (run == nullptr) run = &own.emplace();
    for (const TextFile& file : files) {
        Output output{file.path, *run};
        output.write(file.text);
        output.commit();
    }
    if (own) own->commit();
}

}  // namespace hts::spectral
