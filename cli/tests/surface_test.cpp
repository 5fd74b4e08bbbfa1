// hts surface: what it finds in a map, the files it leaves, and what it refuses.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

const std::string map = std::string{HTS_SOURCE_DIR} + "/cli/data/rough-surface.gsf";

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("hts surface finds the roughness that a computed map was made with") {
    const Workplace place;
    const auto result = place.hts("surface " + map + " --json");
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.errors.empty());
    const auto found = nlohmann::json::parse(result.output);
    CHECK(found["maps"][0]["gaps"] == 48);
    CHECK(found["maps"][0]["outliers"].get<int>() >= 10);
    const double rms = found["heights"]["rms_um"];
    CHECK(found["rms_of_spectra_um"].get<double>() == Approx(rms).epsilon(1e-9));
    for (const auto& description : found["descriptions"]) {
        if (description["description"] != "k_correlation") continue;
        CHECK(description["rms_of_fitted_spectrum_um"].get<double>() == Approx(rms).epsilon(0.05));
        for (const auto& value : description["values"]) {
            const double v = value["value"], error = value["standard_error"];
            const std::string name = value["name"];
            INFO(name << " " << v << " +- " << error);
            if (name == "B_um") CHECK(std::fabs(v - 6) < 3 * error);
            if (name == "C") CHECK(std::fabs(v - 4) < 3 * error);
            if (name == "rms_um") CHECK(std::fabs(v - 0.3) < 3 * error);
            if (name == "noise_rms_um") CHECK(std::fabs(v - 0.003) < 3 * error);
        }
    }
    const auto text = place.hts("surface " + map);
    CHECK(text.exit_code == 0);
    for (const std::string part : {"known periods", "rms", "heights", "K-correlation", "<- best"})
        CHECK(contains(text.output, part));
}

TEST_CASE("hts surface fills a folder with tables, a picture and a material that other verbs take") {
    const Workplace place;
    for (const std::string describe : {"best", "gaussian", "measured"}) {
        const auto result =
            place.hts("surface " + map + " --index Al --describe " + describe + " --output out");
        INFO(describe << ": " << result.errors);
        REQUIRE(result.exit_code == 0);
        for (const std::string name :
             {"surface.json", "radial-spectrum.csv", "profile-spectrum-x.csv", "profile-spectrum-y.csv",
              "autocorrelation.csv", "surface.svg", "surface.gnuplot"})
            CHECK_FALSE(place.read("out/" + name).empty());
        const auto material = nlohmann::json::parse(place.read("out/material.json"));
        if (describe != "measured") CHECK(material["rms_band_um"][0].get<double>() == Approx(0.5));
        CHECK(contains(material["name"], "known for periods"));
        const auto value = place.hts(
            "eval --material out/material.json --wavelength 0.6 --theta-i 30 --theta-r 20 --phi 180");
        INFO(value.errors);
        CHECK(value.exit_code == 0);
    }
}

TEST_CASE("hts surface refuses what it cannot know, in a line each") {
    const Workplace place;
    place.file("a.csv", "1 2 3 4\n5 6 7 8\n");
    place.file("none.gsf", "Gwyddion Simple Field 1.0\nXRes = 100000\nYRes = 10000\n" + std::string(2, '\0'));
    check_complaint(place.hts("surface none.gsf"), 1, {"none.gsf", "1e+05 by 10000 points"});
    check_complaint(place.hts("surface a.csv --step 1 --height-unit um"), 1,
                    {"a.csv", "4 by 2 points", "16 to 8192"});
    check_complaint(place.hts("surface missing.gsf"), 1, {"missing.gsf", "no such file"});
    check_complaint(place.hts("surface " + map + " --height-unit furlong"), 2,
                    {"--height-unit", "furlong", "nm, um, mm, m"});
    check_complaint(place.hts("surface " + map + " --height-unit um"), 1,
                    {"--height-unit", "must not be given"});
    check_complaint(place.hts("surface " + map + " --band 5,1"), 2, {"--band"});
    check_complaint(place.hts("surface " + map + " --index Al"), 2, {"--index", "--output"});
    check_complaint(place.hts("surface " + map + " --level cubic"), 2, {"--level", "plane"});
    check_complaint(place.hts("surface " + map + " --band 4,5"), 1, {"rings of frequencies"});
}
