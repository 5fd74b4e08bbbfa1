// The house rules that a machine can check: which folder and room may include which,
// and how large they may be.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

const fs::path root{HTS_SOURCE_DIR};
constexpr std::size_t most_files = 30, most_lines = 400, most_columns = 110;

/// Folders from the physics up, and the rooms of each in the same order; "" are the folder's own files. A
/// file may include headers of its own room, of rooms before it, and of folders before its own.
struct Folder {
    std::string name;
    std::vector<std::string> rooms;
};
const std::vector<Folder> folders{
    {"hts",
     {"angles", "phi/tables", "lanes", "correlation", "phi", "films", "evaluation", "microfacet", "sampling",
      "rendering", "unified"}},
    {"spectral", {"jobs", "text", "", "output", "colour", "materials", "energy", "models", "plans"}},
    {"tables", {"formats", "table", "sharing", "plans"}},
    {"validation",
     {"report", "curves", "fit", "topography", "scattering", "scattering/vector", "papers", "pictures"}},
    {"bench", {"", "rivals", "phi", "stability", "charts", "micro"}},
    {"cli", {"io", "answers", "verbs", ""}},
};
/// Which folders a folder may include besides its own.
const std::map<std::string, std::vector<std::string>> below{
    {"hts", {}},
    {"spectral", {"hts"}},
    {"tables", {"hts", "spectral"}},
    {"validation", {"hts", "spectral", "tables"}},
    {"bench", {"hts", "spectral", "tables"}},
    {"cli", {"hts", "spectral", "tables", "validation", "bench"}}};

std::string read(const fs::path& path) {
    std::ifstream in{path};
    INFO(path.string());
    REQUIRE(in);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool is_source(const fs::path& path) {
    const fs::path extension = path.extension();
    return extension == ".hpp" || extension == ".cpp" || extension == ".py" || extension == ".ts";
}

bool is_test(const fs::path& path) {
    return std::ranges::any_of(path,
                               [](const fs::path& part) { return part == "tests" || part == "examples"; });
}

bool is_generated(const fs::path& path) {
    const auto folder = path.parent_path().string();
    const auto name = path.stem().string();
    return (folder.ends_with("hts/phi/tables") || folder.ends_with("hts/unified/lanes")) &&
           (name.ends_with("high") || name.ends_with("medium") || name.ends_with("low"));
}

/// The headers that a file includes as "folder/….hpp".
std::vector<fs::path> included(const fs::path& file) {
    static const std::regex include{
        R"re(#include ["<]((hts|spectral|tables|validation|bench|cli)/[^">]+)[">])re"};
    const std::string text = read(file);
    std::vector<fs::path> result;
    for (std::sregex_iterator match{text.begin(), text.end(), include}; match != std::sregex_iterator{};
         ++match)
        result.emplace_back((*match)[1].str());
    return result;
}

/// Place of a file's room in the order, the longest name that fits. The pages of hts itself, which stand
/// before and behind their rooms, and umbrella headers have none.
std::size_t room_of(const Folder& folder, const fs::path& file) {
    const std::string inside = file.parent_path().lexically_relative(folder.name).string();
    const std::string place = inside == "." ? "" : inside;
    std::size_t best = folder.rooms.size(), length = 0;
    for (std::size_t i = 0; i < folder.rooms.size(); ++i) {
        const std::string& room = folder.rooms[i];
        const bool fits = room.empty() ? place.empty() : place == room || place.starts_with(room + "/");
        if (fits && (best == folder.rooms.size() || room.size() > length)) {
            best = i;
            length = room.size();
        }
    }
    return best;
}

template <class Visit>
void for_each_source(const Folder& folder, const Visit& visit) {
    for (const auto& entry : fs::recursive_directory_iterator{root / folder.name})
        if (is_source(entry.path())) visit(entry.path().lexically_relative(root));
}

}  // namespace

TEST_CASE("includes point only towards the physics") {
    std::size_t files = 0;
    for (const Folder& folder : folders) {
        for_each_source(folder, [&](const fs::path& file) {
            ++files;
            for (const fs::path& header : included(root / file)) {
                const std::string other = header.begin()->string();
                INFO(file.string() << " includes " << header.string());
                CHECK((other == folder.name || std::ranges::count(below.at(folder.name), other) == 1));
            }
        });
    }
    CHECK(files > 400);
}

TEST_CASE("includes between the rooms of a folder point only one way") {
    for (const Folder& folder : folders) {
        for_each_source(folder, [&](const fs::path& file) {
            const bool page_of_hts = folder.name == "hts" && file.parent_path() == "hts";
            const bool umbrella = file == fs::path{folder.name} / (folder.name + ".hpp");
            if (is_test(file) || page_of_hts || umbrella || file.filename().string().starts_with("generate_"))
                return;
            const std::size_t own = room_of(folder, file);
            INFO(file.string() << " stands in no room of the list");
            REQUIRE(own < folder.rooms.size());
            for (const fs::path& header : included(root / file)) {
                if (*header.begin() != folder.name || (folder.name == "hts" && header.parent_path() == "hts"))
                    continue;
                INFO(file.string() << " includes " << header.string());
                CHECK(room_of(folder, header) <= own);
            }
        });
    }
}

/// The longest line of a text, in characters of UTF-8.
std::size_t columns(const std::string& text) {
    std::size_t longest = 0, length = 0;
    for (const char c : text) {
        if (c == '\n')
            length = 0;
        else if ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U)
            longest = std::max(longest, ++length);
    }
    return longest;
}

TEST_CASE("the README has at most 150 lines") {
    CHECK(std::ranges::count(read(root / "README.md"), '\n') <= 150);
}

TEST_CASE("no folder has more than 30 files, no file more than 400 lines, no line more than 110 columns") {
    auto all = folders;
    for (const char* name : {"python", "web/src", "web/tests"}) all.push_back({name, {}});
    for (const Folder& folder : all) {
        std::map<std::string, std::size_t> count;
        for (const auto& entry : fs::recursive_directory_iterator{root / folder.name})
            if (entry.is_regular_file()) ++count[entry.path().parent_path().string()];
        for (const auto& [path, files] : count) {
            INFO(path);
            CHECK(files <= most_files);
        }
        for_each_source(folder, [&](const fs::path& file) {
            if (is_generated(file)) return;
            INFO(file.string());
            const std::string text = read(root / file);
            CHECK(static_cast<std::size_t>(std::ranges::count(text, '\n')) <= most_lines);
            if (file.extension() != ".py" && file.extension() != ".ts") CHECK(columns(text) <= most_columns);
        });
    }
}

TEST_CASE("the faults that the tests are to catch still have their text in the sources") {
    std::ifstream list{root / "hts/tests/faults.txt"};
    std::size_t faults = 0;
    for (std::string line; std::getline(list, line);) {
        if (line.empty() || line.front() == '#') continue;
        ++faults;
        INFO(line);
        const std::size_t text = line.find('|') + 1;
        CHECK_THAT(read(root / line.substr(0, text - 1)),
                   Catch::Contains(line.substr(text, line.find('|', text) - text)));
    }
    CHECK(faults > 80);
}
