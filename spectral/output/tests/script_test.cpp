#include "spectral/output/script.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "spectral/output/gnuplot.hpp"
#include "spectral/output/html.hpp"
#include "spectral/output/map_cells.hpp"
#include "temporary_folder.hpp"

using namespace hts::output;
using hts::testing::TemporaryFolder;

TEST_CASE("a text is a gnuplot string, whatever stands in it") {
    CHECK(gnuplot_string("Young's\nfringes") == "'Young''s fringes'");
}

TEST_CASE("a script has its variables, arrays and data in front of the file") {
    const Rows first{{1, 0.1}, {}, {2, std::nan("")}}, second{{3, 4}};
    Script script;
    script.set("title", "a 'b'").set("count", 3).set("share", 0.25);
    script.set("name", std::vector<std::string>{"x", "y"}).set("angle", std::vector{0.5, 30.0});
    const std::string text = script.data("points", {first, second}).with("style");
    CHECK(text ==
          "title = 'a ''b'''\ncount = 3\nshare = 0.25\n"
          "array name[2] = ['x','y']\narray angle[2] = [0.5,30]\n"
          "$points << EOD\n1,0.1\n\n2,nan\n\n\n3,4\nEOD\n" +
              std::string{script_file("style")});
    CHECK(Script{}.data("d", second).with("style").starts_with("$d << EOD\n3,4\nEOD\n"));
    CHECK_THROWS_WITH(script_file("none"), "no embedded file none");
}

TEST_CASE("cells of one colour beside each other are one") {
    const char* const red = "#ff0000";
    const char* const blue = "#0000ff";
    const char* const colours[2][3] = {{red, red, blue}, {blue, red, red}};
    const Rows cells = map_cells({0, 1, 2, 4}, {10, 20, 30},
                                 [&](std::size_t row, std::size_t column) { return colours[row][column]; });
    CHECK(cells == Rows{{0, 2, 10, 20, 0xff0000},
                        {2, 4, 10, 20, 0x0000ff},
                        {0, 1, 20, 30, 0x0000ff},
                        {1, 4, 20, 30, 0xff0000}});
}

TEST_CASE("gnuplot draws a script, and says why if it cannot") {
    const TemporaryFolder folder;
    const auto svg = (folder.path() / "a.svg").string();
    draw(svg, Script{}.set("title", "a").data("spectrum", Rows{{0.4, 1, 2}, {0.5, 2, 3}}).with("spectrum"));
    CHECK(std::filesystem::file_size(svg) > 1000);
    CHECK(std::filesystem::exists(folder.path() / "a.gnuplot"));
    const auto bad = (folder.path() / "b.svg").string();
    CHECK_THROWS_AS(draw(bad, "plot nothing\n"), hts::Error);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator{folder.path()}) {
        CHECK(entry.path().filename().string().find("partial") == std::string::npos);
        ++files;
    }
    CHECK(files == 3);  // the picture and both scripts
}

TEST_CASE("a page has the common style and its own, and text is escaped") {
    CHECK(html_escaped("<a> & \"b\"") == "&lt;a&gt; &amp; &quot;b&quot;");
    const std::string head = html_head("A & B", "<h>", "report");
    CHECK(head.starts_with("<!DOCTYPE html>"));
    CHECK(head.find("color-scheme: light dark") < head.find("figcaption"));
    CHECK(head.find("<title>A &amp; B</title>") != std::string::npos);
    CHECK(head.ends_with("<h1>&lt;h&gt;</h1>\n"));
    CHECK_THROWS_AS(html_head("a", "b", "none"), hts::Error);
}
