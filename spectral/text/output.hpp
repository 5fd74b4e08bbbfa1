/// Output that appears complete or not at all.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hts::spectral {

class RunFiles;

/// Removes the files that are under construction now, of every thread, and ends a program that is drawing
/// one. Safe to call from a signal handler: it only reads lock-free atomics and calls kill, unlink and rmdir.
/// The library installs no handler; a program that wants a signal to leave nothing behind installs one that
/// calls this and then ends the program, as `hts` does.
void remove_partial_files() noexcept;

/// A file under construction. Text goes to a file in a folder of its own beside the target, and `commit`
/// gives it the target's name; an Output that is never committed leaves nothing behind and an earlier file as
/// it was. A link is written through, the mode of an earlier file is kept, and one that nobody may write is
/// refused. "-" is standard output; devices and pipes are written as they are. In both nothing appears before
/// the first megabytes are full or `commit` is called.
class Output {
  public:
    /// Throws hts::Error if the target is a directory, cannot be written or is being written.
    explicit Output(std::string path);
    /// As part of a run (spectral/text/run_files.hpp), which gives it its name.
    Output(std::string path, RunFiles& run);
    ~Output();
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Throws hts::Error if the medium refuses, as `commit` does.
    void write(std::string_view text);
    /// Replaces what was written first.
    void write_at_start(std::string_view text);
    /// Hands all that was written to the medium.
    void flush();
    void commit();

  private:
    void open(RunFiles& run);
    [[noreturn]] void fail() const;

    std::string path_;
    std::unique_ptr<RunFiles> own_run_;
    RunFiles* run_ = nullptr;  // none if written directly
    std::string buffer_;
    int descriptor_ = -1;
};

/// Writes a whole file, as Output does.
void write_file(const std::string& path, std::string_view text);

/// A path and what the file is to hold.
struct TextFile {
    std::string path, text;
};

/// Writes all of them or none: no file gets its name before the medium holds every one.
void write_files(const std::vector<TextFile>& files);

}  // namespace hts::spectral
