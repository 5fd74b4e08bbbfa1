#include "spectral/output/svg.hpp"

#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "spectral/output/gnuplot.hpp"
#include "spectral/output/script.hpp"
#include "spectral/text/text.hpp"
#include "temporary_folder.hpp"

using namespace hts::output;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

std::string text_of(const std::string& words, int size) {
    return "<g transform=\"translate(1,2)\" stroke=\"none\" font-family=\"Helvetica\" font-size=\"" +
           std::to_string(size) + ".00\">\n<text><tspan font-family=\"Helvetica\" >" + words +
           "</tspan></text>\n</g>\n";
}

const std::string drawn =
    "<?xml version=\"1.0\"?>\n<svg width=\"900\">\n<title>Gnuplot</title>\n"
    "<desc>Produced by GNUPLOT 5.4 patchlevel 4 </desc>\n"
    "<defs>\n<path id='gpPt5' d='M0,-1.33'/>\n<use xlink:href='#gpPt5' id='gpPt6'/>\n<path id='gpPt7' "
    "d='M1'/>\n"
    "<use xlink:href='#gpPt5' id='gpPt8'/>\n<filter id='box'>\n<feFlood/>\n</filter>\n</defs>\n" +
    text_of("0.25", 12) + text_of("Light &amp; mirrors", 19) +
    "<g id=\"gnuplot_plot_1\" ><title>gnuplot_plot_1</title>\n"
    "<g fill=\"none\" color=\"black\" stroke=\"red\">\n</g>\n"
    "<g fill=\"none\" color=\"black\" stroke=\"currentColor\">\n"
    "\t<use xlink:href='#gpPt6' transform='translate(10.25,20.5) scale(1.91)' color='red'/>\n"
    "\t<use xlink:href='#gpPt6' transform='translate(11,21) scale(1.91)' color='red'/>\n"
    "\t<use xlink:href='#gpPt6' transform='translate(12,22) scale(1.91)' color='blue'/>\n"
    "\t<use xlink:href='#gpPt8' color='red'/>\n"
    "</g>\n</g>\n"
    "<g id=\"gnuplot_plot_2\" ><title>exact</title>\n"
    "<path stroke='red' fill='rgb(  0, 114, 178)'  d='M1.26,-2.04 L3,4.5\n\t\tL4,4.46 Z  '/></g>\n</svg>\n";

}  // namespace

TEST_CASE("a picture has its largest text as title, and a pointer over lines shows names alone") {
    const std::string svg = finished_svg(drawn);
    CHECK(svg.find("<title>Light &amp; mirrors</title>") < svg.find("<title>exact</title>"));
    CHECK(count(svg, "<title>") == 2);
    CHECK(svg.find("Gnuplot") == std::string::npos);
    CHECK(svg.find("GNUPLOT") == std::string::npos);
    CHECK(svg.ends_with("</svg>\n"));
}

TEST_CASE("a picture has a dark form") {
    CHECK(count(finished_svg(drawn), "@media (prefers-color-scheme: dark)") == 1);
}

TEST_CASE("a picture is the same in fewer bytes") {
    const std::string svg = finished_svg(drawn);
    CHECK(svg.find("stroke='red' stroke-width='3.82' d='M10.3,20.5h0 M11,21h0 '/>") != std::string::npos);
    CHECK(svg.find("stroke='blue' stroke-width='3.82' d='M12,22h0 '/>") != std::string::npos);
    CHECK(svg.find("d='M1.3-2l1.7,6.5 1,0Z'") != std::string::npos);
    CHECK(svg.find("d='M0,-1.33'") != std::string::npos);  // a shape, which is scaled
    CHECK(svg.find("stroke=\"red\">") == std::string::npos);
    CHECK(svg.find("fill='#0072b2'") != std::string::npos);
    CHECK(svg.find("font-family=\"Helvetica\"") == std::string::npos);
    CHECK(count(svg, "<g ") + count(svg, "<g>") == count(svg, "</g>"));
    CHECK(count(svg, "currentColor") == 0);  // without a canvas that says it
    CHECK(finished_svg("") == "");
    CHECK(finished_svg("no picture") == "no picture\n");
}

TEST_CASE("a picture keeps the shapes that it uses, and the groups that say something") {
    const std::string svg = finished_svg(drawn);
    CHECK(
        svg.find("<defs>\n<path id='gpPt5' d='M0,-1.33'/>\n<use xlink:href='#gpPt5' id='gpPt8'/>\n</defs>") !=
        std::string::npos);
    CHECK(svg.find("<g><title>exact</title>") != std::string::npos);
    CHECK(svg.find("gnuplot_plot") == std::string::npos);
}

TEST_CASE("steps of a path are as short as they can be said") {
    const std::string svg =
        finished_svg("<defs></defs>\n<path d='M0.04,-0.5 L0.5,0.2 L-0.3,10.2 L-0.3,10.2 M-3,0 L-2.5,0 Z'/>");
    CHECK(svg.find("<path d='M0-.5l.5,.7-.8,10 0,0M-3,0l.5,0Z'/>") != std::string::npos);
}

TEST_CASE("what gnuplot draws now is finished so") {
    const hts::testing::TemporaryFolder folder;
    const auto path = (folder.path() / "a.svg").string();
    draw(path,
         Script{}.set("title", "Gold").data("spectrum", Rows{{0.4, 1, 2}, {0.5, 2, 3}}).with("spectrum"));
    const std::string svg = hts::spectral::read_text_file(path);
    CHECK(svg.find("<title>Gold</title>") != std::string::npos);
    CHECK(svg.find("gnuplot_plot_1</title>") == std::string::npos);
    CHECK(svg.find("<title>diffuse terms (left)</title>") != std::string::npos);
    CHECK(svg.find("prefers-color-scheme: dark") != std::string::npos);
    CHECK(count(svg, " fill=\"none\" color=\"black\" stroke=\"currentColor\"") == 1);
    CHECK(count(svg, "gnuplot_") == 0);
    CHECK(count(svg, "<g ") + count(svg, "<g>") == count(svg, "</g>"));
}
