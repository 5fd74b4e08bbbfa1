#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

namespace {

const std::string material = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";

const std::string recipe = R"({"format": "csv", "sweep": "outgoing", "kind": "measured", "by": "the test",
  "source": "none", "licence": "CC0-1.0", "quantity": "brdf", "scale": "absolute",
  "columns": {"theta_i": "ti_deg", "theta_r": "tr_deg"}, "values": [{"column": "f", "wavelength_um": 0.5}]})";

}  // namespace

TEST_CASE("hts curves lists the sets that come along and shows one") {
    const Workplace place;
    const auto rows = cells(place.hts("curves list").output);
    CHECK(rows[0] ==
          std::vector<std::string>{"name", "surface", "kind", "by", "licence", "curves", "points"});
    CHECK(rows.size() >= 13);
    const auto shown = place.hts("curves show mwir-brass");
    CHECK(shown.exit_code == 0);
    CHECK(shown.errors.find("brass, measured by MT-MRT") != std::string::npos);
    const auto points = cells(shown.output);
    CHECK(points[0][2] == "theta_i_deg");
    CHECK(points.size() > 400);
    CHECK(nlohmann::json::parse(place.hts("curves show blue-acrylic --json").output).size() == 46);
    const auto wrong = place.hts("curves show marble");
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.errors.find("no curve set \"marble\"") != std::string::npos);
}

TEST_CASE("hts curves import writes a curve set that hts compare reads") {
    const Workplace place;
    place.file("r.json", recipe);
    place.file("f.csv", "ti_deg,tr_deg,f\n30,20,0.3\n30,30,0.4\n30,40,0.3\n30,50,0.2\n");
    const auto result =
        place.hts("curves import f.csv --recipe r.json --surface slate --every 2 --output c.json");
    CHECK(result.exit_code == 0);
    CHECK(result.errors.find("slate: 1 curves, 3 points") != std::string::npos);
    const auto set = nlohmann::json::parse(place.read("c.json"));
    CHECK(set["how"] == "hts curves import f.csv --recipe r.json --surface 'slate' --every 2");
    CHECK(set["curves"][0]["points"].size() == 3);  // the first, the largest, the third

    const auto compared = place.hts("compare c.json --material " + material + " --output out");
    CHECK(compared.exit_code == 0);
    CHECK(cells(compared.output).size() == 3);
    for (const std::string file : {"c-log.svg", "c-polar.svg", "c-residuals.svg"})
        CHECK(place.read("out/" + file).find("</svg>") != std::string::npos);
    CHECK(place.read("out/c-maxima.csv").find("30,30,") != std::string::npos);
    place.file("u.json", R"({"model": "he_unified", "rms_roughness_um": 0.1, "correlation_length_um": 1,
                             "index": {"n": 2.5082937310703843, "k": 0}})");
    CHECK(place.hts("compare c.json --material u.json --output u").exit_code == 0);
    const std::string caption = place.read("u/c-log.gnuplot");
    CHECK(caption.find("(he_unified: ") != std::string::npos);
    CHECK(caption.find("n = 2.50829, k = 0)") != std::string::npos);
    const auto json = nlohmann::json::parse(place.hts("compare c.json --json --material " + material).output);
    CHECK(json[0]["points"] == 3);
}

TEST_CASE("hts compare fails where a criterion fails, and counts the instrument's cones") {
    const Workplace place;
    const std::string command = "compare mwir-aluminium-sandblasted --material " + material;
    const auto result = place.hts(command);
    CHECK(result.exit_code == 1);
    CHECK(result.errors.find("missed: median |ln(model / measured)| at most 0.25") != std::string::npos);
    CHECK(place.hts(command + " --detector-solid-angle 0.05").output != result.output);
}

TEST_CASE("hts curves and hts compare name what is wrong") {
    const Workplace place;
    place.file("r.json", recipe);
    place.file("f.csv", "ti_deg,tr_deg,f\n30,20,-0.3\n");
    const auto check = [&](const std::string& arguments, int code, const std::string& message) {
        const auto result = place.hts(arguments);
        INFO(arguments << ": " << result.errors);
        CHECK(result.exit_code == code);
        CHECK(result.output.empty());
        CHECK(result.errors.find(message) != std::string::npos);
    };
    check("curves", 2, "verb missing: must be one of import, list, show");
    check("curves import f.csv", 2, "--recipe");
    check("curves import f.csv --recipe r.json --surface slate --every 0", 2, "--every");
    check("curves import f.csv --recipe r.json", 1, "r.json: key \"surface\": missing");
    check("curves import f.csv --recipe r.json --surface slate --output c.json", 1,
          "f.csv:2: value -0.3: must be >= 0");
    check("compare mwir-brass", 2, "--material");
    check("compare mwir-brass --source-solid-angle 9 --material " + material, 2,
          "source_solid_angle_sr 9 sr");
    check("compare mwir-brass --band-nodes 0 --material " + material, 2, "--band-nodes");
    check(std::string{"curves show "}.append(300, 'x'), 2, "no curve set \"xxx");
    check(std::string{"curves show ./"}.append(300, 'x'), 1, "curve set");
    check("compare marble --material " + material, 2, "no curve set \"marble\"");
    const auto names = place.names();
    CHECK(std::find(names.begin(), names.end(), "c.json") == names.end());
}
