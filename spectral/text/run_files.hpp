/// The files of one run of a program: those that it reads, and those that it writes, which appear together or
/// not at all. Not installed.
///
/// An output is written in a folder of its own beside its target, .hts-XXXXXX, under its final name, and gets
/// its place when the run commits. So any name that the system takes can be written, what another process
/// left behind is never in the way, and pictures are drawn from numbers that are not published yet.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hts/error.hpp"
#include "spectral/text/unfinished.hpp"

namespace hts::spectral {

/// An output that is an input or another output.
class FileConflict : public Error {
  public:
    using Error::Error;
};

/// Where writing to a path ends: absolute, links followed, also one that leads to no file yet.
[[nodiscard]] std::string resolved(const std::filesystem::path& path);

/// Whether a path is written as it is, without a file under construction: a device, a pipe, an open
/// descriptor of a process.
[[nodiscard]] bool is_written_directly(const std::string& path);

class RunFiles {
  public:
    RunFiles();
    /// Removes what was not committed, and folders that were made for it.
    ~RunFiles();
    RunFiles(const RunFiles&) = delete;
    RunFiles& operator=(const RunFiles&) = delete;

    /// From here on to its end, all Outputs and readers of the process belong to this run.
    void serve_process() noexcept;
    /// That run, none in a program that has not made one.
    [[nodiscard]] static RunFiles* of_process() noexcept;

    // What the run is going to do; devices are passed over. "-" and where standard output leads are files too
    // where a shell has made them so.
    void will_read(const std::string& path);
    void will_write(const std::string& path);
    /// A file that it reads and writes, to go on where an earlier run ended.
    void will_continue(const std::string& path);
    /// A folder that is made with those above it as needed.
    void will_fill(const std::string& folder);
    /// Before the work starts: FileConflict if an output is an input or another output, also by another name
    /// or through links; hts::Error if one cannot be written. Makes the folders.
    void check();

    /// A new path to write to in place of `path`. Throws as `check` does, and FileConflict if that is written
    /// already.
    [[nodiscard]] std::string open(const std::string& path);
    /// The file at `open(path)` holds all that it is to hold.
    void complete(const std::string& path);
    /// Whether it does.
    [[nodiscard]] bool is_complete(const std::string& path);
    /// It is not going to.
    void drop(const std::string& path);
    /// After a successful end this file goes.
    void remove_at_end(const std::filesystem::path& path);

    /// Puts all complete files in place, with the mode of those that they replace; on an error none, and
    /// hts::Error.
    void commit();

    /// Whether a FileConflict was thrown, whatever has become of it on its way.
    [[nodiscard]] bool conflicted() const noexcept { return conflicted_; }

    /// See path_to_read.
    [[nodiscard]] std::filesystem::path to_read(const std::filesystem::path& path);

  private:
    struct Identity {
        dev_t device;
        ino_t inode;
        friend bool operator==(const Identity&, const Identity&) = default;
    };
    /// A file by its place and, where it exists, by what it is.
    struct File {
        std::string path, target;
        std::optional<Identity> identity;
        [[nodiscard]] bool is(const File& other) const;
    };
    enum class State { declared, open, complete };
    struct Target : File {
        State state = State::declared;
        bool in_place = false;  // its bytes are replaced, not the file
        bool continued = false;
        bool replaced = false;  // `staged` holds the file of before
        bool created = false;   // there was none
        std::string staged{};
        std::unique_ptr<Unfinished> unfinished{};
    };
    /// The folder beside some targets. A lock says that this run lives: one without is
    /// left from a killed process.
    struct Stage {
        Stage() = default;
        ~Stage();
        Stage(const Stage&) = delete;
        Stage& operator=(const Stage&) = delete;
        std::string folder{};
        std::unique_ptr<Unfinished> unfinished{};
        int lock = -1;
    };

    [[nodiscard]] static File file(const std::string& path);
    /// None of what is no regular file; where a stream leads, under a name for people.
    [[nodiscard]] static std::optional<File> existing(const std::string& path);
    [[nodiscard]] static std::optional<File> standard_stream(const std::string& device,
                                                             const std::string& name);
    Target& declare(const std::string& path, bool continued);
    Target* find(const File& file);
    [[noreturn]] void refuse(const std::string& message);
    void require_no_input(const File& output);
    void require_writable(Target& output);
    const std::string& stage(const std::string& folder, const std::string& path);
    void make_folder(const std::string& folder);
    static void publish(Target& output);
    static void restore(Target& output) noexcept;
    void clear() noexcept;

    std::mutex mutex_;
    bool conflicted_ = false;
    std::vector<File> inputs_;
    std::list<Target> outputs_;
    std::vector<std::string> folders_;
    std::map<std::string, Stage> stages_;                                    // by the folder they are in
    std::vector<std::pair<std::string, std::unique_ptr<Unfinished>>> made_;  // folders, outer ones first
    std::vector<std::filesystem::path> to_remove_;
};

/// Where the bytes of `path` are now: the file itself, or what this run has written in its place. It counts
/// as an input from here on; FileConflict if the run is going to write it.
[[nodiscard]] std::filesystem::path path_to_read(const std::filesystem::path& path);

}  // namespace hts::spectral
