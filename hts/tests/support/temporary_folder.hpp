/// A folder for files that a test writes and reads, gone at the end of the test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "hts/error.hpp"

namespace hts::testing {

class TemporaryFolder {
  public:
    TemporaryFolder() : path_{std::filesystem::temp_directory_path() / ("hts-" + std::to_string(unique()))} {
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// How many files and folders are in it.
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator{path_}, {}));
    }
    /// Writes a file and returns its path.
    std::filesystem::path write(const std::string& name, std::string_view text) const {
        std::ofstream{path_ / name, std::ios::binary} << text;
        return path_ / name;
    }

  private:
    static std::uint64_t unique() {
        std::random_device device;
        return (std::uint64_t{device()} << 32) | device();
    }
    std::filesystem::path path_;
};

/// What hts::Error an action throws, without the folder in paths: "m.json: key "n": missing"; "" if none.
template <class Action>
std::string complaint(const TemporaryFolder& folder, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        std::string text = error.what();
        const std::string prefix = folder.path().string() + "/";
        for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
            text.erase(at, prefix.size());
        }
        return text;
    }
    return "";
}

}  // namespace hts::testing
