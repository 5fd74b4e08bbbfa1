// The house rules that a machine can check: which folder may include which.

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

const fs::path root{HTS_SOURCE_DIR};

std::string read(const fs::path& path) {
    std::ifstream in{path};
    INFO(path.string());
    REQUIRE(in);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool is_source(const fs::path& path) {
    return path.extension() == ".hpp" || path.extension() == ".cpp";
}

/// The folders whose headers a file includes as "folder/….hpp".
std::set<std::string> included_folders(const fs::path& file) {
    static const std::regex include{R"re(#include ["<](hts|spectral|tables|validation|bench|cli)/)re"};
    const std::string text = read(file);
    std::set<std::string> folders;
    for (std::sregex_iterator match{text.begin(), text.end(), include}; match != std::sregex_iterator{};
         ++match) {
        folders.insert((*match)[1]);
    }
    return folders;
}

}  // namespace

TEST_CASE("includes point only towards the physics") {
    const std::map<std::string, std::set<std::string>> may_include{
        {"hts", {"hts"}},
        {"spectral", {"hts", "spectral"}},
        {"tables", {"hts", "spectral", "tables"}},
        {"validation", {"hts", "spectral", "tables", "validation"}},
        {"bench", {"hts", "spectral", "tables", "bench"}},
        {"cli", {"hts", "spectral", "tables", "validation", "bench", "cli"}}};
    std::size_t files = 0;
    for (const auto& [folder, allowed] : may_include) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator{root / folder}) {
            if (!is_source(entry.path())) continue;
            ++files;
            for (const std::string& included : included_folders(entry.path())) {
                INFO(entry.path().string() << " includes " << included << "/");
                CHECK(allowed.contains(included));
            }
        }
    }
    CHECK(files > 50);
}
