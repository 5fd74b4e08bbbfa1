#include "spectral/text/run_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "spectral/text/folder_lock.hpp"

namespace hts::spectral {
namespace {

namespace fs = std::filesystem;

RunFiles* process_run = nullptr;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error{path + ": cannot be written (" + reason + "): must be a file that can be written"};
}

[[noreturn]] void fail(const std::string& path, int error) {
    fail(path, std::string{std::strerror(error)});
}

std::optional<struct stat> status_of(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return status;
}

/// The targets that Outputs of this process have open, of all runs.
struct OpenTargets {
    std::mutex mutex;
    std::vector<std::string> all;
};
OpenTargets& open_targets() {
    static OpenTargets targets;
    return targets;
}

void claim_target(const std::string& path, const std::string& target) {
    const std::scoped_lock lock{open_targets().mutex};
    auto& all = open_targets().all;
    if (std::ranges::find(all, target) != all.end())
        throw FileConflict{path + ": is being written already: must be one output alone"};
    all.push_back(target);
}

void release_target(const std::string& target) noexcept {
    const std::scoped_lock lock{open_targets().mutex};
    std::erase(open_targets().all, target);
}

/// Replaces the bytes of a file, which stays the same one, with its owner, mode and other names.
void copy_bytes(const std::string& path, const std::string& from, const std::string& to) {
    std::ifstream in{from, std::ios::binary};
    std::ofstream out{to, std::ios::binary | std::ios::trunc};
    if (in.peek() != std::ifstream::traits_type::eof()) out << in.rdbuf();
    out.close();
    if (!in || !out) fail(path, errno);
}

}  // namespace

std::string resolved(const fs::path& path) {
    constexpr int most_links = 40;  // as the system has it
    std::error_code ignored;
    fs::path place = fs::absolute(path);
    for (int links = 0; fs::is_symlink(fs::symlink_status(place, ignored)); ++links) {
        if (links == most_links) fail(path.string(), ELOOP);
        const fs::path next = fs::read_symlink(place, ignored);
        place = next.is_absolute() ? next : place.parent_path() / next;
    }
    const fs::path folder = fs::weakly_canonical(place.parent_path(), ignored);
    return ((folder.empty() ? place.parent_path() : folder) / place.filename()).string();
}

bool is_written_directly(const std::string& path) {
    // /dev/stdout and its kin lead through /proc to what is open, whose name is of no use
    for (const char* const open : {"/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/"}) {
        if (path.starts_with(open)) return true;
    }
    const auto status = status_of(path);
    return status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode);
}

// ---- the run

RunFiles::RunFiles() = default;

RunFiles::~RunFiles() {
    if (process_run == this) process_run = nullptr;
    clear();
}

void RunFiles::serve_process() noexcept {
    process_run = this;
}

RunFiles* RunFiles::of_process() noexcept {
    return process_run;
}

bool RunFiles::File::is(const File& other) const {
    return target == other.target || (identity && other.identity && *identity == *other.identity);
}

RunFiles::File RunFiles::file(const std::string& path) {
    File result{path, resolved(path), {}};
    if (const auto status = status_of(result.target)) result.identity = {status->st_dev, status->st_ino};
    return result;
}

void RunFiles::will_read(const std::string& path) {
    const auto input = path == "-" ? standard_stream("/dev/stdin", "standard input") : existing(path);
    if (!input) return;
    const std::scoped_lock lock{mutex_};
    if (std::ranges::none_of(inputs_, [&](const File& known) { return known.target == input->target; }))
        inputs_.push_back(*input);
}

std::optional<RunFiles::File> RunFiles::existing(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) ? std::optional{file(path)} : std::nullopt;
}

std::optional<RunFiles::File> RunFiles::standard_stream(const std::string& device, const std::string& name) {
    auto stream = existing(device);
    if (stream) stream->path = name;
    return stream;
}

RunFiles::Target& RunFiles::declare(const std::string& path, bool continued) {
    Target output;
    static_cast<File&>(output) = file(path);
    output.continued = continued;
    outputs_.push_back(std::move(output));
    return outputs_.back();
}

void RunFiles::will_write(const std::string& path) {
    if (path != "-" && !is_written_directly(path)) declare(path, false);
}

void RunFiles::will_continue(const std::string& path) {
    declare(path, true);
}

void RunFiles::will_fill(const std::string& folder) {
    folders_.push_back(folder);
}

RunFiles::Target* RunFiles::find(const File& file) {
    const auto found = std::ranges::find_if(outputs_, [&](const Target& each) { return each.is(file); });
    return found == outputs_.end() ? nullptr : &*found;
}

void RunFiles::refuse(const std::string& message) {
    conflicted_ = true;
    throw FileConflict{message};
}

void RunFiles::require_no_input(const File& output) {
    for (const File& input : inputs_) {
        if (!output.is(input)) continue;
        const std::string same = output.path == input.path ? "is an input of this run"
                                                           : "is the same file as the input " + input.path;
        refuse(output.path + ": " + same + ": an output must be another file");
    }
}

void RunFiles::require_writable(Target& output) {
    const auto status = status_of(output.target);
    if (fs::path{output.target}.filename().empty() || (status && S_ISDIR(status->st_mode)))
        throw Error{output.path + ": is a directory: must be a file that can be written"};
    // the owner of the machine may write any file, but one without a bit for it is protected on purpose
    constexpr mode_t anybody = S_IWUSR | S_IWGRP | S_IWOTH;
    if (status && ((status->st_mode & anybody) == 0 || ::access(output.target.c_str(), W_OK) != 0))
        fail(output.path, EACCES);
    output.in_place = status && status->st_nlink > 1;
    const fs::path target{output.target};
    const fs::path folder = target.parent_path();
    // a file that may be written in a folder that may not
    const bool elsewhere = status && ::access(folder.c_str(), W_OK | X_OK) != 0;
    output.in_place = output.in_place || elsewhere;
    output.staged = (fs::path{stage((elsewhere ? fs::temp_directory_path() : folder).string(), output.path)} /
                     target.filename())
                        .string();
}

RunFiles::Stage::~Stage() {
    if (lock >= 0) ::close(lock);
}

const std::string& RunFiles::stage(const std::string& folder, const std::string& path) {
    Stage& stage = stages_[folder];
    if (stage.folder.empty()) {
        remove_abandoned(folder);
        std::string name;
        while (stage.lock < 0) {
            name = (fs::path{folder} / ".hts-XXXXXX").string();
            if (::mkdtemp(name.data()) == nullptr) {
                const int error = errno;
                stages_.erase(folder);
                fail(path, error);
            }
            stage.lock = locked(name, false);
        }
        stage.unfinished = std::make_unique<Unfinished>(name, Unfinished::Kind::folder);
        stage.folder = std::move(name);
    }
    return stage.folder;
}

void RunFiles::make_folder(const std::string& folder) {
    const auto impossible = [&] {
        throw Error{folder + ": cannot be made: must be a folder that can be written"};
    };
    fs::path made;
    for (const fs::path& part : fs::path{folder}) {
        made /= part;
        std::error_code failure;
        const bool is_new = !made.filename().empty() && fs::create_directory(made, failure);
        if (failure || !fs::is_directory(made, failure)) impossible();
        if (is_new)
            made_.emplace_back(made.string(),
                               std::make_unique<Unfinished>(made.string(), Unfinished::Kind::folder));
    }
    try {
        stage(fs::canonical(folder).string(), folder);
    } catch (const Error&) {
        impossible();
    }
}

void RunFiles::check() {
    const std::scoped_lock lock{mutex_};
    for (const std::string& folder : folders_) make_folder(folder);
    if (const auto output = standard_stream("/dev/stdout", "standard output")) require_no_input(*output);
    for (auto output = outputs_.begin(); output != outputs_.end(); ++output) {
        // a folder that was not there has a place now
        static_cast<File&>(*output) = file(output->path);
        require_no_input(*output);
        for (auto other = outputs_.begin(); other != output; ++other) {
            if (!other->is(*output)) continue;
            const std::string names =
                other->path == output->path ? "" : ", " + other->path + " and " + output->path;
            refuse(output->path + ": two outputs go to this file" + names + ": must be different files");
        }
    }
    for (Target& output : outputs_) require_writable(output);
}

std::string RunFiles::open(const std::string& path) {
    const std::scoped_lock lock{mutex_};
    const File wanted = file(path);
    Target* output = find(wanted);
    if (output != nullptr && output->state != State::declared)
        refuse(path + ": is written already: must be one output alone");
    claim_target(path, wanted.target);
    try {
        if (output == nullptr) output = &declare(path, false);
        require_no_input(*output);
        require_writable(*output);
    } catch (...) {
        release_target(wanted.target);
        throw;
    }
    output->unfinished = std::make_unique<Unfinished>(output->staged, Unfinished::Kind::file);
    output->state = State::open;
    return output->staged;
}

void RunFiles::complete(const std::string& path) {
    const std::scoped_lock lock{mutex_};
    if (Target* output = find(file(path))) output->state = State::complete;
}

bool RunFiles::is_complete(const std::string& path) {
    const std::scoped_lock lock{mutex_};
    const Target* output = find(file(path));
    return output != nullptr && output->state == State::complete;
}

void RunFiles::drop(const std::string& path) {
    const std::scoped_lock lock{mutex_};
    Target* output = find(file(path));
    if (output == nullptr || output->state != State::open) return;
    ::unlink(output->staged.c_str());
    output->unfinished.reset();
    output->state = State::declared;
    release_target(output->target);
}

void RunFiles::remove_at_end(const fs::path& path) {
    to_remove_.push_back(path);
}

void RunFiles::publish(Target& output) {
    if (output.in_place) return copy_bytes(output.path, output.staged, output.target);
    const auto before = status_of(output.target);
    output.created = !before;
    if (before) {
        // who owns it can be kept by few; its mode by all
        if (::chown(output.staged.c_str(), before->st_uid, before->st_gid) != 0) errno = 0;
        ::chmod(output.staged.c_str(), before->st_mode & 07777);
        // where the medium cannot exchange two files, it can put one in place of the other
        if (::renameat2(AT_FDCWD, output.staged.c_str(), AT_FDCWD, output.target.c_str(), RENAME_EXCHANGE) ==
            0) {
            output.replaced = true;
            return;
        }
        if (errno == EBUSY) return copy_bytes(output.path, output.staged, output.target);
    }
    if (::rename(output.staged.c_str(), output.target.c_str()) != 0) fail(output.path, errno);
}

void RunFiles::restore(Target& output) noexcept {
    if (output.in_place) return;
    if (output.replaced) {
        ::renameat2(AT_FDCWD, output.staged.c_str(), AT_FDCWD, output.target.c_str(), RENAME_EXCHANGE);
        output.replaced = false;
    } else if (output.created) {
        static_cast<void>(::rename(output.target.c_str(), output.staged.c_str()));
    }
}

void RunFiles::commit() {
    const std::scoped_lock lock{mutex_};
    std::vector<Target*> done;
    // those that are written in place cannot be taken back, so they come last
    for (const bool in_place : {false, true}) {
        for (Target& output : outputs_) {
            if (output.state != State::complete || output.in_place != in_place) continue;
            try {
                publish(output);
            } catch (...) {
                std::ranges::for_each(done, [](Target* each) { restore(*each); });
                throw;
            }
            done.push_back(&output);
        }
    }
    made_.clear();
    std::error_code ignored;
    for (const fs::path& path : to_remove_) fs::remove(path, ignored);
    to_remove_.clear();
    clear();
}

void RunFiles::clear() noexcept {
    for (Target& output : outputs_) {
        if (output.state == State::declared) continue;
        ::unlink(output.staged.c_str());
        release_target(output.target);
    }
    outputs_.clear();
    for (const auto& [folder, stage] : stages_) ::rmdir(stage.folder.c_str());
    stages_.clear();
    // NOLINTNEXTLINE(modernize-loop-convert): clang 14 does not take the library's views
    for (auto made = made_.rbegin(); made != made_.rend(); ++made) ::rmdir(made->first.c_str());
    made_.clear();
}

fs::path RunFiles::to_read(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored) && fs::exists(path, ignored)) return path;
    const File wanted = file(path.string());
    {
        const std::scoped_lock lock{mutex_};
        if (Target* output = find(wanted)) {
            if (output->continued) return path;
            if (output->state == State::complete) return output->staged;
            refuse(output->path + ": is the input " + path.string() + ": an output must be another file");
        }
        if (!wanted.identity) return path;
    }
    will_read(path.string());
    return path;
}

fs::path path_to_read(const fs::path& path) {
    return process_run == nullptr ? path : process_run->to_read(path);
}

}  // namespace hts::spectral
