#include "validation/report/report_page.hpp"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace hts::validation;

const std::vector<Section> sections{
    {.stem = "mirror",
     .title = "A mirror & its image",
     .text = "First paragraph.\n\nSecond, with 1 < 2.",
     .checks = {{"reflectance <= 1", "0.98", true},
                {"peak within 6 deg", "9 deg", false, "slopes too steep"}},
     .figures = {{"peak", {}, "plot x", "measured by somebody"}},
     .images = {{"view", "a view", std::string{"\x89PNG\r"}}},
     .tables = {{"numbers", "some numbers", {"theta [deg]", "f"}, {{"10", "0.5"}, {"20", "<0.25>"}}}},
     .not_available = {"the paper's curves"}},
    {.stem = "empty",
     .title = "Nothing",
     .text = "",
     .checks = {},
     .figures = {},
     .images = {},
     .tables = {},
     .not_available = {}}};

std::string svg(const Figure& /*figure*/) {
    return "<?xml version=\"1.0\"?>\n<svg><defs><circle id='dot'/></defs><use href='#dot'/></svg>\n";
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("a report counts what passed") {
    CHECK(tally(sections).passed == 1);
    CHECK(tally(sections).all == 2);
    CHECK(tally({}).all == 0);
}

TEST_CASE("the page holds everything, and what was learned comes first") {
    const std::string page = report_page({sections, {}}, "hts 0.1", svg);
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(page.find("1 of 2 criteria are met") != std::string::npos);
    CHECK(page.find("Every result is the one recorded") < page.find("What was learned"));
    CHECK(page.find("What was learned") < page.find("What was missed"));
    CHECK(page.find("What was missed") < page.find("First paragraph"));
    CHECK(count(page, "slopes too steep") == 2);
    CHECK(page.find("A mirror &amp; its image") != std::string::npos);
    CHECK(page.find("<p>Second, with 1 &lt; 2.</p>") != std::string::npos);
    CHECK(page.find("&lt;0.25&gt;") != std::string::npos);
    CHECK(page.find("Not available: the paper's curves") != std::string::npos);
    CHECK(page.find("data:image/png;base64,iVBORw0=") != std::string::npos);
    CHECK(page.find("http") == std::string::npos);
}

TEST_CASE("sections fold, and are linked to and from") {
    const std::string page = report_page({sections, {}}, "hts 0.1", svg);
    CHECK(count(page, "<details id=") == 3);  // and what was missed
    CHECK(count(page, "href=\"#mirror\"") == 3);
    CHECK(count(page, "href=\"#contents\"") == 3);
    CHECK(count(page, "id=\"contents\"") == 1);
}

TEST_CASE("what a section learned stands at the head, else its checks do") {
    auto spoken = sections;
    CHECK(report_page({spoken, {}}, "", svg).find(", not: peak within 6 deg (9 deg).") != std::string::npos);
    spoken[0].learned = "mirrors reflect";
    CHECK(report_page({spoken, {}}, "", svg).find("mirrors reflect</li>") != std::string::npos);
}

TEST_CASE("contradictions are said before all else") {
    const std::string page = report_page({sections, {"mirror: 1 < 2"}}, "hts 0.1", svg);
    CHECK(page.find("1 result contradicts what is recorded") < page.find("What was learned"));
    CHECK(page.find("<li>mirror: 1 &lt; 2</li>") != std::string::npos);
    CHECK(page.find("Every result is the one recorded") == std::string::npos);
}

TEST_CASE("names inside a picture are its own") {
    const std::string page = report_page({sections, {}}, "hts 0.1", svg);
    CHECK(page.find("<circle id='peak-dot'/>") != std::string::npos);
    CHECK(page.find("href='#peak-dot'") != std::string::npos);
    CHECK(page.find("<?xml") == std::string::npos);
}

TEST_CASE("the report as JSON") {
    const auto json = nlohmann::json::parse(report_json({sections, {"a", "b"}}, "hts 0.1"));
    CHECK(json["passed"] == 1);
    CHECK(json["checks"] == 2);
    CHECK(json["contradictions"].size() == 2);
    CHECK(json["sections"][0]["checks"][1]["remark"] == "slopes too steep");
    CHECK(json["sections"][0]["checks"][1]["verdict"] == "missed");
    CHECK(json["sections"][0]["tables"][0]["rows"][1][1] == "<0.25>");
}
