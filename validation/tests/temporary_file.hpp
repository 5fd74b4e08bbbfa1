/// Files that tests write.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace hts::validation::testing {

/// A file that is there as long as this is.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text)
        : path_{std::filesystem::temp_directory_path() / ("hts-validation-" + name)} {
        std::ofstream{path_} << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// `text` with the first `part` replaced; the part must be there.
inline std::string with(std::string text, const std::string& part, const std::string& instead) {
    return text.replace(text.find(part), part.size(), instead);
}

}  // namespace hts::validation::testing
