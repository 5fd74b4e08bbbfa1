#include "hts/correlation/kept_tables.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ranges>
#include <string>

#include <catch2/catch.hpp>

#include "hts/correlation/table_file.hpp"
#include "temporary_folder.hpp"

namespace hts {
namespace {

namespace fs = std::filesystem;
using correlation_detail::kept_table;
using correlation_detail::LobeTable;
using correlation_detail::matern_shape;
using correlation_detail::table_path;
using testing::TemporaryFolder;

bool same(const LobeTable& a, const LobeTable& b) {
    const auto x = a.numbers(), y = b.numbers();
    for (std::size_t part = 0; part < x.size(); ++part)
        if (!std::ranges::equal(x[part], y[part])) return false;
    return true;
}

std::string text_of(const fs::path& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

}  // namespace

TEST_CASE("Kept tables: read again to the last bit, and made anew where a file is not what it should be") {
    const TemporaryFolder place;
    const fs::path folder = place / "not" / "there yet";
    const auto shape = matern_shape(0.8), other = matern_shape(0.9);
    const auto made = kept_table({}, shape);
    CHECK(place.size() == 0);
    CHECK(same(*kept_table(folder, shape), *made));
    const fs::path path = table_path(folder, *shape);
    const std::string whole = text_of(path);
    CHECK(std::distance(fs::directory_iterator{folder}, {}) == 1);  // no draft is left
    CHECK(path != table_path(folder, *other));
    CHECK(same(*kept_table(folder, shape), *made));

    const auto damaged = [&](const std::string& text) {
        INFO(text.size());
        std::ofstream{path, std::ios::binary} << text;
        CHECK(same(*kept_table(folder, shape), *made));
        CHECK(text_of(path) == whole);
    };
    damaged("");
    damaged(whole.substr(0, whole.size() - 8));
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    damaged(flipped);
    static_cast<void>(kept_table(folder, other));
    damaged(text_of(table_path(folder, *other)));
}

TEST_CASE("Kept tables: a folder that cannot be written is no error, and few are kept") {
    const TemporaryFolder place;
    const auto shape = matern_shape(0.8);
    const fs::path file = place.write("file", "not a folder");
    CHECK(kept_table(file, shape)->bytes() > 0);
    CHECK(kept_table(file / "below", shape)->bytes() > 0);
    CHECK(text_of(file) == "not a folder");
    CHECK(place.size() == 1);

    fs::remove(file);
    using namespace std::chrono_literals;
    const auto now = fs::file_time_type::clock::now();
    for (std::size_t i = 0; i < most_kept_tables + 3; ++i) {
        const auto path = place.write(std::to_string(i) + ".lobe", "");
        fs::last_write_time(path, now - 1h - i * 1min);
    }
    fs::last_write_time(place.write("left.part", ""), now - 2h);
    fs::last_write_time(place.write("begun.part", ""), now);
    static_cast<void>(kept_table(place.path(), shape));
    CHECK(place.size() == most_kept_tables + 1);
    CHECK(fs::exists(table_path(place.path(), *shape)));
    CHECK(fs::exists(place / "begun.part"));
    CHECK(fs::exists(place / "0.lobe"));
    CHECK_FALSE(fs::exists(place / (std::to_string(most_kept_tables) + ".lobe")));
}

TEST_CASE("Kept tables: the environment says where") {
    const auto folder = [](const char* own, const char* cache, const char* home) {
        setenv("HTS_CACHE", own, 1);
        setenv("XDG_CACHE_HOME", cache, 1);
        setenv("HOME", home, 1);
        return user_cache_folder().string();
    };
    const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
    CHECK(folder("/a", "/b", "/c") == "/a");
    CHECK(folder("off", "/b", "/c").empty());
    CHECK(folder("", "/b", "/c") == "/b/hts");
    CHECK(folder("", "relative", "/c") == "/c/.cache/hts");  // as the specification of XDG says
    CHECK(folder("", "", "").empty());
    setenv("HTS_CACHE", "off", 1);
    setenv("HOME", before.c_str(), 1);
    unsetenv("XDG_CACHE_HOME");
}

}  // namespace hts
