/// Files that tests write.
#pragma once

#include <filesystem>
#include <string>

#include "temporary_folder.hpp"

namespace hts::validation::testing {

/// A file that is there as long as this is.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text)
        : path_{folder_.write("hts-validation-" + name, text)} {}
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    hts::testing::TemporaryFolder folder_;
    std::filesystem::path path_;
};

/// `text` with the first `part` replaced; the part must be there.
inline std::string with(std::string text, const std::string& part, const std::string& instead) {
    return text.replace(text.find(part), part.size(), instead);
}

}  // namespace hts::validation::testing
