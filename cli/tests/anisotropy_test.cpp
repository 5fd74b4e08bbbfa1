// Surfaces of two correlation lengths by the command: files of points, what is said of
// them, and what is refused.
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

const std::string brushed = HTS_SOURCE_DIR "/cli/data/brushed-aluminium.json";

std::string row_value(const Workplace& place, const std::string& arguments) {
    const auto result = place.hts("eval " + arguments);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.output)[0]["directional_diffuse"].dump();
}

}  // namespace

TEST_CASE("columns of points say both lengths and the azimuth") {
    const Workplace place;
    const std::string header =
        "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,n,k,rms_roughness_um,";
    place.file("two.csv", header +
                              "correlation_length_x_um,correlation_length_y_um,azimuth_deg\n"
                              "0.5,30,90,40,270,0.769,6.08,0.2,20,2,0\n"
                              "0.5,30,0,40,180,0.769,6.08,0.2,2,20,0\n"
                              "0.5,30,120,40,300,0.769,6.08,0.2,20,2,30\n"
                              "0.5,30,0,40,180,0.769,6.08,0.2,20,2,0\n");
    const auto result = place.hts("eval --points two.csv --output values.csv");
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const auto values = cells(place.read("values.csv"));
    REQUIRE(values.size() == 5);
    const auto value = [&](std::size_t row) { return std::stod(values[row][11]); };
    CHECK(values[0][11] == "directional_diffuse");
    CHECK(value(2) == Approx(value(1)).epsilon(1e-9));
    CHECK(value(3) == Approx(value(1)).epsilon(1e-9));
    CHECK(value(4) < 0.01 * value(1));

    const auto wrong = [&](const std::string& columns, const std::string& row, const std::string& message) {
        place.file("wrong.csv", header + columns + "\n0.5,30,90,40,270,0.769,6.08,0.2," + row + "\n");
        check_complaint(place.hts("eval --points wrong.csv"), 1, {"wrong.csv:", message});
    };
    wrong("correlation_length_x_um", "20", "column correlation_length_y_um missing");
    wrong("correlation_length_y_um", "20", "column correlation_length_x_um missing");
    wrong("correlation_length_um,correlation_length_x_um,correlation_length_y_um", "1,2,3",
          "column correlation_length_um: must not be in the header beside correlation_length_x_um");
    wrong("correlation_length_um,azimuth_deg", "1,2",
          "column azimuth_deg: must not be in the header beside correlation_length_um");
    wrong("correlation_length_x_um,correlation_length_y_um", "1,0", "correlation length 0 um: must be > 0");
}

TEST_CASE("the azimuth of the light matters over a brushed surface, and turns with it") {
    const Workplace place;
    const std::string at = " --wavelength 0.5 --theta-i 30 --theta-r 40 --json --tolerance 1e-12";
    const std::string material = "--material " + brushed + at;
    CHECK(row_value(place, material + " --phi-i 90 --phi-r 270") !=
          row_value(place, material + " --phi-i 0 --phi-r 180"));
    const auto info = place.hts("info " + brushed + " --wavelengths 0.5 --theta 0,45");
    REQUIRE(info.exit_code == 0);
    CHECK(info.output.find("tau 20 um along the azimuth 0 deg and 2 um across") != std::string::npos);
    CHECK(info.output.find("rms slopes 0.0141 (0.81 deg) along and 0.141 (8.05 deg) across") !=
          std::string::npos);
    const auto json = nlohmann::json::parse(place.hts("info --json " + brushed).output);
    CHECK(json["correlation_length_um"] == nlohmann::json{20.0, 2.0});
    CHECK(json["azimuth_deg"] == 0.0);
    // drawn and integrated alike
    const auto albedo = [&](const std::string& phi) {
        const auto result = place.hts("albedo --material " + brushed +
                                      " --wavelength 0.5 --theta-i 40 --json --phi-i " + phi);
        REQUIRE(result.exit_code == 0);
        return nlohmann::json::parse(result.output)[0]["total"].get<double>();
    };
    for (const std::string phi : {"0", "35", "90"}) {
        const auto drawn = place.hts("sample --material " + brushed +
                                     " --wavelength 0.5 --theta-i 40 --count 20000 --seed 1 --phi-i " + phi);
        REQUIRE(drawn.exit_code == 0);
        const auto draws = cells(drawn.output);
        double sum = 0;
        for (std::size_t i = 1; i < draws.size(); ++i) sum += std::stod(draws[i][4]);
        CHECK(sum / static_cast<double>(draws.size() - 1) == Approx(albedo(phi)).epsilon(0.01));
    }
}

TEST_CASE("what wants an isotropic surface refuses a brushed one by name") {
    const Workplace place;
    const auto refused = [&](const std::string& arguments, const std::string& message) {
        const auto result = place.hts(arguments);
        INFO(arguments << ": " << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(result.errors.find(message) != std::string::npos);
        CHECK(place.names().empty());
    };
    refused("table build --material " + brushed + " --wavelengths 0.5 --output x.htst",
            "must be of an isotropic surface");
    const auto export_to = [](const std::string& format, const std::string& wavelengths) {
        return "table export " + brushed + " --output x --format " + format + " --wavelengths " + wavelengths;
    };
    refused(export_to("merl", "0.45:0.65:3"), "depends on the azimuth of the light, which a MERL file");
    refused(export_to("zemax", "0.5"), "depends on the azimuth of the light, which OpticStudio");
    refused(export_to("pbsdf", "0.45:0.65:5"), "is anisotropic");
    refused("eval --material " + brushed +
                " --wavelength 0.5 --theta-i 30 --theta-r 30 --phi 180 --compensate-energy",
            "energy compensation of a surface of two correlation lengths");
}

TEST_CASE("anisotropic files of other programs come back") {
    const Workplace place;
    const std::string at = " --wavelength 0.55 --theta-i 40 --phi-i 30 --theta-r 45 --phi-r 205 --json";
    const auto value = [&](const std::string& material) {
        const auto result = place.hts("eval --material " + material + at);
        INFO(result.errors);
        REQUIRE(result.exit_code == 0);
        return nlohmann::json::parse(result.output)[0]["brdf"].get<double>();
    };
    const auto exported = place.hts("table export " + brushed +
                                    " --format csv --wavelengths 0.55 --pairs 1000 --output brushed.csv");
    INFO(exported.errors);
    REQUIRE(exported.exit_code == 0);
    const auto imported = place.hts("table import brushed.csv --output measured.json");
    REQUIRE(imported.exit_code == 0);
    CHECK(imported.errors.find("not isotropic") != std::string::npos);
    CHECK(value("measured.json") == Approx(value(brushed)).epsilon(0.5));
}
