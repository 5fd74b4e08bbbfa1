#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"

using hts::cli::testing::Result;
using hts::cli::testing::Workplace;

namespace {

const std::string aluminium = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";

}  // namespace

TEST_CASE("hts table export writes a file, what stands in it, and how well it reads back") {
    const Workplace place;
    const auto rgl = place.hts("table export " + aluminium +
                               " --format rgl --wavelengths 0.55 --pairs 2000 --json --output al.bsdf");
    INFO(rgl.errors);
    REQUIRE(rgl.exit_code == 0);
    const auto report = nlohmann::json::parse(rgl.output);
    CHECK(report["worst"]["error_of_peak"] < 0.02);
    for (const auto& each : report["density"]) CHECK(each["integral"] == Approx(1).margin(0.02));
    CHECK(place.names() == std::vector<std::string>{"al.bsdf", "al.bsdf.json"});
    const auto beside = nlohmann::json::parse(place.read("al.bsdf.json"));
    CHECK(beside["value"].get<std::string>().starts_with("f cos(theta_o)"));
    CHECK(beside["specular"]["treatment"] == "left out of the file");
    CHECK(beside["specular"]["reflectance"].size() == 37);

    const auto pbsdf =
        place.hts("table export " + aluminium + " --format pbsdf --pairs 2000 --output al.pbsdf");
    CHECK(pbsdf.exit_code == 0);
    CHECK(pbsdf.output.find("Mueller") != std::string::npos);
    CHECK(nlohmann::json::parse(place.read("al.pbsdf.json"))["suggested_alpha"] > 0.1);
}

TEST_CASE("hts table export spreads the specular term where a file can hold it, and refuses where not") {
    const Workplace place;
    const std::string fine = HTS_SOURCE_DIR "/cli/data/fine-aluminium.json";
    const std::string box = " --wavelengths 0.55 --specular box --pairs 1000 --json --output ";
    const auto refused = place.hts("table export " + fine + " --format csv" + box + "al.csv");
    CHECK(refused.exit_code == 1);
    CHECK(refused.errors.find("would reflect ") != std::string::npos);
    CHECK(refused.errors.find("does not hold a box of 0.001 sr") != std::string::npos);
    CHECK(place.names().empty());
    for (const std::string format : {"rgl", "zemax", "klems"}) {
        const auto result = place.hts("table export " + fine + " --format " + format + box + "al." + format);
        INFO(format << ": " << result.errors);
        REQUIRE(result.exit_code == 0);
        const auto report = nlohmann::json::parse(result.output);
        // the mirror returns a quarter of the light along the normal
        CHECK(report["albedo"][0]["original"].get<double>() == Approx(0.9155).margin(0.003));
        CHECK(report["albedo"][0]["read_back"].get<double>() == Approx(0.9155).margin(0.006));
        CHECK(nlohmann::json::parse(place.read("al." + format + ".json"))["specular"]["treatment"]
                  .get<std::string>()
                  .starts_with("in the file"));
    }
}

TEST_CASE("a measured material of three channels is exported as channels") {
    const Workplace place;
    place.file("lambert.json",
               R"({"model": "lambert", "diffuse_albedo": {"table": [[0.46, 0.2], [0.62, 0.5]]}})");
    REQUIRE(place
                .hts("table export lambert.json --format zemax --colour --wavelengths 0.46,0.55,0.62 "
                     "--pairs 500 --output three.bsdf")
                .exit_code == 0);
    REQUIRE(place.hts("table import three.bsdf --output m.json").exit_code == 0);
    const Result refused = place.hts("table export m.json --format rgl --output m.bsdf");
    CHECK(refused.exit_code == 1);
    CHECK(refused.errors.find("must be written with --colour") != std::string::npos);
    for (const std::string format : {"zemax", "astm"}) {
        const Result result = place.hts("table export m.json --format " + format +
                                        " --colour --pairs 500 --json --output again");
        INFO(format << ": " << result.errors);
        REQUIRE(result.exit_code == 0);
        CHECK(nlohmann::json::parse(result.output)["worst"]["error_of_peak"] < 0.02);
    }
}

TEST_CASE("hts table export writes colour, other bases and finer trees where a format has them") {
    const Workplace place;
    const auto written = [&](const std::string& format, const std::string& more) {
        const auto result = place.hts("table export " + aluminium + " --format " + format +
                                      " --wavelengths 0.40:0.70:7 --pairs 500 --output al.x" + more);
        INFO(format << more << ": " << result.errors);
        REQUIRE(result.exit_code == 0);
        return place.read("al.x");
    };
    const std::string klems = written("klems", " --colour --basis quarter");
    CHECK(klems.find(">CIE-X<") != std::string::npos);
    CHECK(klems.find("<AngleBasisName>Klems Quarter 41</AngleBasisName>") != std::string::npos);
    CHECK(written("zemax", " --colour").find("TristimulusZ") != std::string::npos);
    CHECK(written("radiance", " --colour --depth 4").find(">CIE-v<") != std::string::npos);
    CHECK(written("radiance", " --depth 5").size() > written("radiance", " --depth 4").size());
    CHECK(written("astm", "").find("\nVARS theta_i,phi_i,theta_s,phi_s,400nm,450nm,") != std::string::npos);
    const auto wrong = place.hts("table export " + aluminium + " --format rgl --basis half --output y");
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.errors.find("--basis: must not come with --format rgl") != std::string::npos);
}

TEST_CASE("a polarised file comes back as a material with its Mueller matrices") {
    const Workplace place;
    REQUIRE(
        place.hts("table export " + aluminium + " --format pbsdf --pairs 500 --output al.pbsdf").exit_code ==
        0);
    const auto imported = place.hts("table import al.pbsdf --output measured.json");
    INFO(imported.errors);
    REQUIRE(imported.exit_code == 0);
    CHECK(imported.errors.find("pbsdf, 5 wavelengths, isotropic") != std::string::npos);
    const std::string point = " --wavelength 0.5 --theta-i 40 --theta-r 45 --phi 170 --mueller --json";
    const auto here = nlohmann::json::parse(place.hts("eval --material measured.json" + point).output)[0];
    const auto there = nlohmann::json::parse(place.hts("eval --material " + aluminium + point).output)[0];
    for (const char* element : {"m00", "m01", "m10", "m22", "m23", "m32", "m33"})
        CHECK(here[element].get<double>() ==
              Approx(there[element].get<double>()).margin(0.01 * there["m00"].get<double>()));
}

TEST_CASE("hts table export names what is wrong and leaves nothing behind") {
    const Workplace place;
    const auto wrong = [&](const std::string& arguments, int code, const std::string& message) {
        const auto result = place.hts("table export " + arguments);
        INFO(arguments << ": " << result.errors);
        CHECK(result.exit_code == code);
        CHECK(result.output.empty());
        CHECK(result.errors.find(message) != std::string::npos);
        CHECK(place.names().empty());
    };
    const std::string satin = HTS_SOURCE_DIR "/cli/data/purple-satin.json";
    wrong(aluminium + " --format exr --output x", 2, "--format");
    wrong(aluminium + " --format rgl", 2, "--output");
    wrong(aluminium + " --format rgl --output x --wavelengths 0.5:0.4:3", 2, "--wavelengths");
    wrong(aluminium + " --format rgl --output x --wavelengths 900", 1, "--wavelengths: ");
    wrong(aluminium + " --format rgl --output x --specular box --solid-angle 7", 2,
          "--solid-angle: solid angle");
    wrong(aluminium + " --format pbsdf --output x --wavelengths 0.5,0.6", 1, "must be 5");
    wrong(aluminium + " --format pbsdf --output x --specular box", 1, "has no Mueller matrix");
    wrong(satin + " --format pbsdf --output x --wavelengths 0.45:0.65:5", 1, "is anisotropic");
    wrong("missing.json --format rgl --output x", 1, "missing.json");
}

TEST_CASE("hts table export writes shaders, and refuses what a shader cannot hold") {
    const Workplace place;
    const auto shader =
        place.hts("table export " + aluminium + " --format glsl --pairs 2000 --json --output al.glsl");
    INFO(shader.errors);
    REQUIRE(shader.exit_code == 0);
    CHECK(nlohmann::json::parse(shader.output)["worst"]["error_of_peak"] < 1e-3);
    CHECK(place.read("al.glsl").find("vec3 hts_brdf_rgb(vec3 wi, vec3 wo)") != std::string::npos);
    const auto refused = place.hts("table export " HTS_SOURCE_DIR
                                   "/cli/data/rough-gold.json --format glsl --output gold.glsl");
    CHECK(refused.exit_code == 1);
    CHECK(refused.errors.find("format glsl: must be a material of model \"he\"") != std::string::npos);
    const auto boxed =
        place.hts("table export " + aluminium + " --format glsl --specular box --output box.glsl");
    CHECK(boxed.exit_code == 2);
    CHECK(boxed.errors.find("--specular box: must not come with --format glsl") != std::string::npos);
    CHECK(place.names() == std::vector<std::string>{"al.glsl", "al.glsl.json"});
}
