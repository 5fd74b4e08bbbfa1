// Every model on the command line: the verbs take the material files in cli/data and others, and refuse what
// a model lacks.

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"
#include "hts/microfacet/walter.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Result;
using hts::cli::testing::Workplace;

namespace {

const std::string data = HTS_SOURCE_DIR "/cli/data/";
const std::string point = " --wavelength 0.55 --theta-i 30 --theta-r 40 --phi 170";

/// Material files by model; he is what the other tests are about.
std::map<std::string, std::string> materials(const Workplace& place) {
    const auto lobes = [&](const std::string& model, const std::string& lobe) {
        return place.file(model + ".json",
                          R"({"model": ")" + model + R"(", "kd": 0.1, "lobes": [)" + lobe + "]}");
    };
    return {
        {"walter", data + "rough-gold.json"},
        {"kurt", data + "purple-satin.json"},
        {"ashikhmin", place.file("ashikhmin.json", R"({"model": "ashikhmin", "f0": 0.2, "diffuse_albedo": 0.5,
                "normals": {"type": "gaussian", "sigma_x": 0.3, "sigma_y": 0.3}})")},
        {"lambert", place.file("lambert.json", R"({"model": "lambert", "diffuse_albedo": 0.5})")},
        {"oren_nayar",
         place.file("oren_nayar.json",
                    R"({"model": "oren_nayar", "diffuse_albedo": 0.5, "slope_angle_deg": 20})")},
        {"ward", lobes("ward", R"({"ks": 0.5, "mx": 0.2, "my": 0.4})")},
        {"ward_duer", lobes("ward_duer", R"({"ks": 0.5, "mx": 0.2, "my": 0.4})")},
        {"cook_torrance", lobes("cook_torrance", R"({"ks": 0.5, "f0": 0.8, "m": 0.3})")},
        {"blinn_phong", lobes("blinn_phong", R"({"ks": 0.5, "exponent": 30})")},
        {"lafortune", lobes("lafortune", R"({"ks": 0.5, "cx": -1, "cy": -1, "exponent": 30})")},
        {"ashikhmin_shirley",
         place.file("ashikhmin_shirley.json",
                    R"({"model": "ashikhmin_shirley", "rd": 0.5, "f0": 0.1, "nx": 20, "ny": 80})")}};
}

double cell(const std::vector<std::vector<std::string>>& table, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < table.front().size(); ++i) {
        if (table.front()[i] == column) return std::strtod(table.at(row).at(i).c_str(), nullptr);
    }
    FAIL("no column " << column);
    return 0;
}

/// What a command wrote, which must have gone well.
std::string output(const Result& result) {
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    return result.output;
}

}  // namespace

TEST_CASE("every verb takes every model") {
    const Workplace place;
    for (const auto& [model, file] : materials(place)) {
        INFO(model);
        const std::string material = " --material " + file;
        const auto value = cells(output(place.hts("eval" + material + point + " --detail")));
        const double brdf = cell(value, 1, "brdf");
        CHECK(brdf > 0);
        CHECK(cell(value, 1, "specular_reflectance") == 0);
        CHECK(value.front().back() == "specular_reflectance");

        const auto spectrum = cells(output(place.hts(
            "spectrum" + material + " --theta-i 30 --theta-r 40 --phi 170 --wavelengths 0.5,0.55")));
        CHECK(cell(spectrum, 2, "brdf") == Approx(brdf).epsilon(1e-14));

        const auto curve = cells(
            output(place.hts("polar" + material + " --wavelength 0.55 --theta-i 30 --phi-i 20 --absolute")));
        CHECK(curve.size() > 700);

        const auto albedo =
            cells(output(place.hts("albedo" + material + " --wavelengths 0.55 --theta-i 40 --phi-i 20")));
        const double total = cell(albedo, 1, "total");
        CHECK(albedo.front().back() == "total");
        const auto draws = cells(output(place.hts(
            "sample" + material + " --wavelength 0.55 --theta-i 40 --phi-i 20 --count 4000 --seed 3")));
        double sum = 0, squares = 0;
        for (std::size_t i = 1; i < draws.size(); ++i) {
            const double weight = cell(draws, i, "weight");
            sum += weight / 4000;
            squares += weight * weight / 4000;
        }
        const double error = std::sqrt((squares - sum * sum) / 4000);
        CHECK(std::abs(sum - total) < 5 * error + 1e-5);

        const auto info = nlohmann::json::parse(
            output(place.hts("info " + file + " --wavelengths 0.55 --theta 0,60 --json")));
        CHECK(info["model"] == model);
        CHECK(info["points"].size() == 2);
        CHECK(output(place.hts("info " + file + " --wavelengths 0.55 --theta 0")).find(model) !=
              std::string::npos);
    }
}

TEST_CASE("hts eval of points with any model gives the same bytes for any number of threads") {
    const Workplace place;
    std::string points = "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n";
    for (int i = 0; i < 200; ++i)
        points += "0.5," + std::to_string(i % 90) + ",10,40," + std::to_string(i) + "\n";
    place.file("points.csv", points);
    for (const auto& [model, file] : materials(place)) {
        const std::string command = "eval --points points.csv --material " + file;
        const auto one = place.hts(command, "OMP_NUM_THREADS=1");
        CHECK(cells(one.output).size() == 201);
        CHECK(one.output == place.hts(command, "OMP_NUM_THREADS=3").output);
    }
    const auto rate =
        place.hts("eval --wavelengths 0.5,0.6 --random-pairs 1000 --material " + data + "rough-gold.json");
    CHECK(output(rate).find("1000,2,1,") != std::string::npos);
}

TEST_CASE("what only the He-Torrance model has is refused with others") {
    const Workplace place;
    place.file("lambert.json", R"({"name": "paper", "model": "lambert", "diffuse_albedo": 0.5})");
    const std::string header = "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,n\n";
    place.file("n.csv", header + "0.5,30,0,40,170,1.5\n");
    const auto refuses = [&](const std::string& command, int exit_code, const std::string& named) {
        const Result result = place.hts(command);
        INFO(command << "\n" << result.errors);
        CHECK(result.exit_code == exit_code);
        CHECK(result.output.empty());
        CHECK(result.errors.find(named) != std::string::npos);
        CHECK(result.errors.find("he") != std::string::npos);
    };
    refuses("eval --material lambert.json --mueller" + point, 2, "--mueller");
    refuses("eval --material lambert.json --polarisation s" + point, 2, "--polarisation");
    refuses("albedo --material lambert.json --wavelengths 0.5 --theta-i 0 --measured 0.5", 2, "--measured");
    refuses("albedo --material lambert.json --compensate-energy", 2, "--compensate-energy");
    refuses("eval --material lambert.json --compensate-energy" + point, 2, "--compensate-energy");
    refuses("spectrum --material lambert.json --compensate-energy --theta-i 0 --theta-r 0 --phi 0", 2,
            "--compensate-energy");
    refuses("eval --material lambert.json --points n.csv", 1, "column n");
}

TEST_CASE("a material file's warning reaches the user") {
    const Workplace place;
    place.file("velvet.json", R"({"model": "ashikhmin", "f0": 1,
        "normals": {"type": "slanted_fibres", "sigma": 0.5, "slant_deg": 40}})");
    const auto result = place.hts("eval --material velvet.json" + point);
    CHECK(result.exit_code == 0);
    CHECK(result.errors.find("velvet.json: mean normal") != std::string::npos);
    CHECK(output(place.hts("info velvet.json --wavelengths 0.5 --theta 60")).find("Warning: mean normal") !=
          std::string::npos);
}

TEST_CASE("hts eval --transmission is what ground glass lets through") {
    const Workplace place;
    place.file("glass.json",
               R"({"model": "walter", "distribution": "ggx", "alpha": 0.394, "index": {"n": 1.51, "k": 0}})");
    const std::string at = " --wavelength 0.55 --theta-i 30 --theta-r 20 --phi 180 --transmission";
    const auto through = place.hts("eval --material glass.json" + at);
    REQUIRE(through.exit_code == 0);
    const auto table = cells(through.output);
    CHECK(table.front().back() == "btdf");
    const hts::WalterBsdf glass{hts::FacetDistribution::ggx(0.394), 1.0, 1.51};
    CHECK(cell(table, 1, "btdf") == glass.bsdf({hts::Side::front, hts::Direction::from_degrees(30, 0)},
                                               {hts::Side::back, hts::Direction::from_degrees(20, 180)}));

    const auto metal =
        place.hts("eval --material " + std::string{HTS_SOURCE_DIR} + "/cli/data/rough-gold.json" + at);
    CHECK(metal.exit_code == 1);
    CHECK(metal.output.empty());
    CHECK(metal.errors.find("0.55 um: the surface is opaque") != std::string::npos);
    CHECK(place.hts("eval --material glass.json --mueller" + at).exit_code == 2);
}

TEST_CASE("a material that reflects more than falls in is named") {
    const Workplace place;
    place.file("bright.json", R"({"model": "ward", "kd": 0.1, "lobes": [{"ks": 5, "mx": 0.2, "my": 0.2}]})");
    const auto named = [](const Result& result) {
        INFO(result.errors);
        CHECK(result.exit_code == 0);
        CHECK(result.errors.find("bright.json: WARNING: reflects ") != std::string::npos);
    };
    named(place.hts("albedo -m bright.json --wavelengths 0.5 --theta-i 30"));
    named(place.hts("eval -m bright.json --wavelength 0.5 --theta-i 30 --theta-r 10 --phi 0"));
    named(place.hts("eval -m bright.json --wavelengths 0.4,0.5 --random-pairs 100"));
    named(place.hts(
        "spectrum -m bright.json --wavelengths 0.4,0.5 --theta-i 30 --theta-r 10 --phi 0 -o s.csv"));
    place.file("points.csv",
               "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,85,0,3,0\n0.4,5,0,3,0\n");
    named(place.hts("eval -m bright.json --points points.csv"));
    CHECK(place.hts("eval -m bright.json --points points.csv").errors ==
          place.hts("eval -m bright.json --points points.csv", "OMP_NUM_THREADS=1").errors);
    named(place.hts("sample -m bright.json --wavelength 0.5 --theta-i 30 --count 20000 -o a.csv"));
    named(place.hts("render sphere -m bright.json --size 16 --samples 1 -o a.png"));
    named(place.hts("scatter bright.json --wavelength 0.5"));
    named(place.hts("table export bright.json --format csv --wavelengths 0.5 --pairs 10 -o b.csv"));
    named(place.hts("table build bright.json --wavelengths 0.5 --tolerance 0.3 -o b.htst"));
    CHECK(place.hts("compare mwir-brass bright.json").errors.find("bright.json: WARNING: reflects ") !=
          std::string::npos);
    place.file("white.json",
               R"({"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 2, "index": "Al",
                                "diffuse_albedo": 1})");
    const Result white = place.hts("eval -m white.json --wavelength 0.5 --theta-i 30 --theta-r 10 --phi 0");
    CHECK(white.errors.find("white.json: WARNING: reflects 1.") != std::string::npos);
    place.file("red.json",
               R"({"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 2, "index": "Al",
                   "diffuse_albedo": {"table": [[0.4, 0], [0.7, 1]]}})");
    const Result red =
        place.hts("table export red.json --format csv --wavelengths 0.4,0.7 --pairs 10 -o r.csv");
    CHECK(red.errors.find("red.json: WARNING: reflects 1.") != std::string::npos);
    for (const std::string verb : {"albedo", "eval --wavelength 0.5 --theta-i 30 --theta-r 10 --phi 0"}) {
        const Result honest = place.hts(verb + " -m '" HTS_SOURCE_DIR "/cli/data/rough-aluminium.json'");
        CHECK(honest.errors.find("WARNING") == std::string::npos);
    }
}
