/// Lines, or bytes, of a file, of standard input or of a text, one after the other. Not installed.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace hts::spectral {

class LineSource {
  public:
    explicit LineSource(std::string text);
    /// A file, or standard input for "-"; hts::Error "path: …" if it is missing, a directory or unreadable.
    [[nodiscard]] static std::shared_ptr<LineSource> of_file(const std::string& path);
    ~LineSource();
    LineSource(const LineSource&) = delete;
    LineSource& operator=(const LineSource&) = delete;

    /// Whether it is a file, not standard input or a text, in which nothing stands.
    [[nodiscard]] bool is_empty_file();
    /// Whether reading ended with a failure.
    [[nodiscard]] bool failed() const noexcept { return failed_; }
    /// The next line without its end, or up to a NUL; of what has no lines, such as a device, no more than
    /// the beginning is read. False at the end.
    bool take_line(std::string& line);
    /// So many bytes; false if there are fewer.
    bool take_bytes(std::size_t count, std::string& bytes);

  private:
    [[nodiscard]] bool at_end();
    bool refill();

    std::string buffer_;
    std::size_t place_ = 0;  ///< in the buffer
    int descriptor_ = -1;
    bool failed_ = false;
};

}  // namespace hts::spectral
