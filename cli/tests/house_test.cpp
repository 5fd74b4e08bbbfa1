// The house rules that a machine can check: which folder may include which, and what the README shows.

#include <algorithm>
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

/// The fenced blocks of a Markdown text in a given language.
std::vector<std::string> blocks(const std::string& markdown, const std::string& language) {
    std::vector<std::string> found;
    const std::string opening = "```" + language + "\n";
    for (std::size_t at = markdown.find(opening); at != std::string::npos;
         at = markdown.find(opening, at + 1)) {
        const std::size_t begin = at + opening.size();
        found.push_back(markdown.substr(begin, markdown.find("```", begin) - begin));
    }
    return found;
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

TEST_CASE("the README's first code block is the example that is compiled and run") {
    const auto code = blocks(read(root / "README.md"), "cpp");
    REQUIRE_FALSE(code.empty());
    CHECK(code.front() == read(root / "spectral/examples/spectral_brdf.cpp"));
    CHECK(std::count(code.front().begin(), code.front().end(), '\n') < 20);
}

TEST_CASE("every command of the README runs") {
    const fs::path folder = fs::temp_directory_path() / "hts-readme";
    fs::remove_all(folder);
    fs::create_directories(folder / "cli");
    fs::copy(root / "cli/data", folder / "cli/data", fs::copy_options::recursive);
    std::size_t commands = 0;
    for (const std::string& block : blocks(read(root / "README.md"), "sh")) {
        std::istringstream lines{block};
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("hts ")) continue;
            const std::string command =
                "cd '" + folder.string() + "' && '" HTS_COMMAND "' " + line.substr(4) + " >/dev/null";
            INFO(line);
            CHECK(std::system(command.c_str()) == 0);
            ++commands;
        }
    }
    CHECK(commands > 0);
    fs::remove_all(folder);
}

TEST_CASE("every file the README links to exists") {
    static const std::regex link{R"(\]\(([^)#:]+)\))"};
    const std::string text = read(root / "README.md");
    for (std::sregex_iterator match{text.begin(), text.end(), link}; match != std::sregex_iterator{};
         ++match) {
        INFO((*match)[1]);
        CHECK(fs::exists(root / (*match)[1].str()));
    }
}
