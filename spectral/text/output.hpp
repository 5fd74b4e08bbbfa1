/// Output that appears complete or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hts::spectral {

/// Removes the files that are under construction now, of every thread. Safe to call from a signal handler: it
/// only reads lock-free atomics and calls unlink. The library installs no handler; a program that wants a
/// signal to leave nothing behind installs one that calls this and then ends the program, as `hts` does.
void remove_partial_files() noexcept;

/// A file under construction beside its target, whoever writes it. The destructor removes it, and
/// remove_partial_files, unless it was given its target's name before.
class PartialFile {
  public:
    /// TARGET.partial-PROCESS.
    [[nodiscard]] static std::string path_for(const std::string& target);
    /// Takes charge of the file at path_for(target), which need not be there yet.
    explicit PartialFile(std::string target);
    ~PartialFile();
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Renames it to its target; false, and errno, if the system refuses.
    [[nodiscard]] bool finish() noexcept;

  private:
    void forget() noexcept;

    std::string target_, path_;
    int slot_;  // where remove_partial_files finds the path, -1 if nowhere
};

/// A file under construction. Text goes to a PartialFile, which `commit` renames to the target; an Output
/// that is never committed leaves nothing behind and an earlier file as it was. "-" is standard output;
/// devices and pipes are written as they are. In both nothing appears before the first megabytes are full or
/// `commit` is called.
class Output {
  public:
    /// Throws hts::Error if the target is a directory or cannot be written.
    explicit Output(std::string path);
    ~Output();
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Throws hts::Error if the medium refuses, as `commit` does.
    void write(std::string_view text);
    /// Hands all that was written to the medium.
    void flush();
    void commit();

  private:
    [[noreturn]] void fail() const;

    std::string path_;
    std::optional<PartialFile> partial_;  // none if written directly
    std::string buffer_;
    int descriptor_ = -1;
};

/// Writes a whole file, as Output does.
void write_file(const std::string& path, std::string_view text);

/// A path and what the file is to hold.
struct TextFile {
    std::string path, text;
};

/// Writes all of them or none: no file gets its name before the medium holds every one. Should the medium then refuse a
/// renaming, files renamed before it stay.
void write_files(const std::vector<TextFile>& files);

}  // namespace hts::spectral
