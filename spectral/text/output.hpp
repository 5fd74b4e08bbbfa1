/// Output that appears complete or not at all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hts::spectral {

/// A file under construction. Text goes to a temporary file beside the target, which `commit` renames to it;
/// an Output that is never committed, or a signal that ends the program, leaves nothing behind and an earlier
/// file as it was. "-" is standard output; devices and pipes are written as they are. In both nothing
/// appears before the first megabytes are full or `commit` is called.
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
    void discard() noexcept;
    void forget_partial() noexcept;
    [[noreturn]] void fail() const;

    std::string path_;
    std::string target_;   // where a symbolic link leads
    std::string partial_;  // empty if written directly
    std::string buffer_;
    int descriptor_ = -1;
    int slot_ = -1;  // where a signal's handler finds partial_
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
