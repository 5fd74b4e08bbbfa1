// Errors of what is predicted, and scatter parameters: hts eval --uncertainty, hts fit --cross-validate, hts
// scatter.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

const std::string data = std::string{HTS_SOURCE_DIR} + "/cli/data/";
const std::string at = " --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 180 ";

}  // namespace

TEST_CASE("hts eval --uncertainty adds two columns, from the file or from the option") {
    const Workplace place;
    const std::string file = place.file("m.json", R"({"model": "he", "rms_roughness_um": 0.28,
        "correlation_length_um": 1.77, "index": "Al", "uncertainty": {"rms_roughness_um": 0.01}})");
    const auto from_file = cells(place.hts("eval --material " + file + at + "--uncertainty").output);
    const auto given = cells(place
                                 .hts("eval --material " + data + "rough-aluminium.json" + at +
                                      "--uncertainty rms_roughness_um=0.01")
                                 .output);
    REQUIRE(from_file.size() == 2);
    CHECK(from_file == given);
    const auto& names = from_file[0];
    CHECK(names[names.size() - 2] == "brdf_uncertainty");
    CHECK(names.back() == "specular_reflectance_uncertainty");
    CHECK(std::stod(from_file[1][names.size() - 2]) > 0);
    CHECK(cells(place.hts("eval --material -" + at + "--uncertainty < m.json").output) == from_file);
    CHECK(place.hts("table build - --wavelengths 0.5 --tolerance 0.1 -o m.table < m.json").exit_code == 0);
    check_complaint(place.hts("eval --material " + data + "rough-aluminium.json" + at + "--uncertainty"), 1,
                    {"key \"uncertainty\": missing"});
    check_complaint(
        place.hts("eval --material " + data + "rough-aluminium.json" + at + "--uncertainty tau=1"), 2,
        {"--uncertainty: tau: must name a number of the material file"});
    check_complaint(
        place.hts("eval --material " + data + "rough-aluminium.json" + at + "--uncertainty rms_roughness_um"),
        2, {"must be name=value"});
}

TEST_CASE("hts fit --cross-validate says what each angle left out was predicted to") {
    const Workplace place;
    const auto result =
        place.hts("fit anodised-ec1 --model lambert --most-points 20 --cross-validate --json");
    REQUIRE(result.exit_code == 0);
    const auto report = nlohmann::json::parse(result.output);
    const auto& left_out = report["cross_validation"]["left_out"];
    CHECK(left_out.size() == 4);
    std::size_t count = 0;
    for (const auto& part : left_out) count += part["values"].get<std::size_t>();
    CHECK(count == report["statistics"]["values"].get<std::size_t>());
    CHECK(report["cross_validation"]["all"]["rms_log"].get<double>() > 0);
}

TEST_CASE("hts scatter prints the parameters of three forms") {
    const Workplace place;
    const auto rows =
        cells(place.hts("scatter --material " + data + "polished-optic.json --wavelength 0.6328").output);
    REQUIRE(rows.size() == 1 + 3 + 3 + 5);
    CHECK(rows[1][2] == "abg");
    CHECK(rows[4][2] == "harvey_shack");
    CHECK(rows[7][3] == "rms_roughness");
    CHECK(std::stod(rows[7][4]) == Approx(0.003).epsilon(0.1));
    check_complaint(
        place.hts("scatter --material " + data + "polished-optic.json --wavelength 0.6 --theta-i 85"), 2,
        {"--theta-i: 85 deg: must be from 0 to 80"});
}
