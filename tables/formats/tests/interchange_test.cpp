// OpenMATERIAL 3D, BiRD and LightTools: what is written holds to the schemas, what is read is what was
// written, and what is wrong is named.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include <catch2/catch.hpp>

#include "bird_schema.hpp"
#include "damaged_files.hpp"
#include "materials.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/points/bird.hpp"
#include "tables/formats/points/lighttools.hpp"
#include "tables/formats/points/open_material.hpp"
#include "tables/formats/round_trip.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;
using hts::tables::testing::check_bird;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;
using nlohmann::json;

const auto two_wavelengths = spectral::WavelengthGrid::from_micrometres({0.45, 0.65});

/// What of the schemas of OpenMATERIAL 3D a "metadata" must be.
void check_metadata(const json& metadata, bool of_table) {
    for (const char* key : {"name", "uuid", "materialVersion", "openMaterial3dVersion", "license"}) {
        INFO(key);
        REQUIRE(metadata.contains(key));
        CHECK(metadata[key].is_string());
    }
    for (const char* key : {"copyrights", "authors"}) {
        INFO(key);
        REQUIRE(metadata.contains(key));
        REQUIRE(metadata[key].is_array());
        CHECK_FALSE(metadata[key].empty());
        for (const json& each : metadata[key]) CHECK(each.is_string());
    }
    if (of_table) CHECK(metadata.at("sources").is_string());
    const auto matches = [&](const char* key, const char* pattern) {
        INFO(key);
        CHECK(std::regex_match(metadata[key].get<std::string>(), std::regex{pattern}));
    };
    matches("uuid", "[0-9a-fA-F]{8}-[0-9a-fA-F]{4}-[0-9a-fA-F]{4}-[0-9a-fA-F]{4}-[0-9a-fA-F]{12}");
    matches("materialVersion", R"(\d+\.\d+\.\d+)");
    matches("openMaterial3dVersion", R"(\d+\.\d+\.\d+)");
}

void check_material(const json& file) {
    check_metadata(file.at("metadata"), false);
    const json& properties = file.at("materialProperties");
    if (properties.contains("surfaceRoughness")) {
        const json& roughness = properties["surfaceRoughness"];
        CHECK(roughness.at("surfaceHeightRms").get<double>() >= 0);
        CHECK(roughness.at("surfaceCorrelationLength").get<double>() >= 0);
        CHECK(roughness.at("sources").is_string());
        CHECK(roughness.size() == 3);
    }
    if (properties.contains("opticalPropertiesUri"))
        CHECK(properties["opticalPropertiesUri"].get<std::string>().ends_with("_optical.xompt"));
    for (const json& uri : properties.at("brdfUris")) CHECK(uri.get<std::string>().ends_with("_brdf.xompt"));
}

void check_optical(const json& file) {
    check_metadata(file.at("metadata"), true);
    REQUIRE(!file.at("opticalProperties").empty());
    for (const json& row : file["opticalProperties"]) {
        REQUIRE(row.size() == 4);
        CHECK(row[0].get<double>() < 1e-3);  // metres
        CHECK(row[0].get<double>() > 1e-8);
        for (std::size_t i : {1U, 2U, 3U}) CHECK(row[i].get<double>() >= 0);
    }
}

void check_brdf(const json& file) {
    check_metadata(file.at("metadata"), true);
    const json& brdf = file.at("brdf");
    std::set<double> wavelengths;
    for (const json& each : brdf.at("wavelengths")) wavelengths.insert(each.get<double>());
    CHECK_FALSE(brdf.contains("receiverSolidAngles"));  // optional, > 0, of a detector
    CHECK(*wavelengths.begin() >= 1e-9);
    CHECK(*wavelengths.rbegin() <= 17.16e-3);
    std::vector<double> before;
    double last_turn = 0;
    bool sorted = true, in_range = true;
    for (const json& row : brdf.at("lookupTable")) {
        const auto v = row.get<std::vector<double>>();
        REQUIRE(v.size() == 5);
        // the schema's own digits
        in_range = in_range && wavelengths.contains(v[0]) && v[1] >= 0 && v[1] <= 1.570796 && v[2] >= 0 &&
                   v[2] <= 1.570796 && v[3] >= 0 && v[3] <= 6.283185 && v[4] >= 0;
        const std::vector<double> key{v.begin(), v.end() - 1};
        sorted = sorted && (before.empty() || before < key);
        before = key;
        last_turn = std::max(last_turn, v[3]);
    }
    CHECK(sorted);
    CHECK(in_range);
    CHECK(last_turn == 6.283185);
}

constexpr const char* metadata_text = R"("metadata": {"name": "a", "uuid": "b", "materialVersion": "1.0.0",
  "openMaterial3dVersion": "1.0.0", "copyrights": [], "license": "MIT", "authors": ["c"]})";

std::string brdf_table(const std::string& rows) {
    return std::string{"{"} + metadata_text +
           R"(, "brdf": {"wavelengths": [5.5e-7], "receiverSolidAngles": [],
  "lookupTable": [)" +
           rows + "]}}";
}

std::string bird(const std::string& variables) {
    return R"({"metadata": {}, "data": {)" + variables + "}}";
}
const std::string bird_good =
    R"("theta_i": {"unit": "deg", "values": [10, 10, 50, 50]},
    "phi_i": {"unit": "deg", "values": [0, 0, 0, 0]},
    "theta_r": {"unit": "deg", "values": [20, 60, 20, 60]},
    "phi_r": {"unit": "deg", "values": [180, 180, 180, 180]},
    "wavelength": {"unit": "nm", "values": [550, 550, 550, 550]},
    "BRDF": {"unit": "sr-1", "values": [0.1, 0.2, 0.3, 0.4],
    "uncertainty": {"value": [0, 0, 0, 0], "unit": "sr-1"}})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("OpenMATERIAL files hold to the schema and come back as the material they are") {
    const auto brdf = brdf_of("rough-aluminium.json", two_wavelengths);
    const TemporaryFolder folder;
    for (const double mirror : {180., 0.}) {
        const Exported exported = exported_open_material(brdf, folder.path() / "a.xomp", mirror);
        REQUIRE(exported.files.size() == 3);
        check_material(json::parse(exported.files[0].text));
        check_optical(json::parse(exported.files[1].text));
        check_brdf(json::parse(exported.files[2].text));
        for (const auto& file : exported.files)
            folder.write(std::filesystem::path{file.path}.filename(), file.text);
        // the table, by its points
        const auto table = read_brdf(folder.path() / "a_brdf.xompt", {.mirror_azimuth = mirror});
        const RoundTrip trip = round_trip(brdf, table.brdf, {2000, 3});
        std::cout << "OpenMATERIAL, mirror at " << mirror << ": worst " << trip.worst.error << ", 99 % "
                  << trip.percentile_99 << '\n';
        CHECK(trip.percentile_99 < 0.03);
    }
    // the material, by its model: exactly
    const auto found = read_brdf(folder.path() / "a.xomp");
    CHECK(found.format == "openmaterial");
    const auto material = spectral::material_from_text(found.material, "a.json");
    CHECK(material.model_name() == "he");
    const auto read = material.at(two_wavelengths, {.tolerance = tables::testing::exactly});
    const DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
    for (std::size_t i : {0U, 1U}) {
        CHECK(read.brdf(pair)[i] == Approx(brdf.brdf(pair)[i]).epsilon(1e-9));
        CHECK(read.specular_reflectance(pair.in)[i].value() ==
              Approx(brdf.specular_reflectance(pair.in)[i].value()).epsilon(1e-9));
    }
    // and as "measured" in a material file
    folder.write("m.json", R"({"model": "measured", "file": "a.xomp"})");
    const auto named = spectral::read_material(folder.path() / "m.json", models_with_files());
    CHECK(named.at(two_wavelengths).brdf(pair)[0] == Approx(brdf.brdf(pair)[0]).epsilon(1e-6));
}

TEST_CASE("OpenMATERIAL: same material, same bytes, and what the format cannot say is left out or refused") {
    const auto optic = brdf_of("polished-optic.json", two_wavelengths);
    const Exported first = exported_open_material(optic, "a.xomp"),
                   second = exported_open_material(optic, "a.xomp");
    for (std::size_t i = 0; i < first.files.size(); ++i) CHECK(first.files[i].text == second.files[i].text);
    CHECK_FALSE(json::parse(first.files[0].text)["materialProperties"].contains("surfaceRoughness"));
    const auto gold = brdf_of("rough-gold.json", two_wavelengths);
    CHECK(exported_open_material(gold, "a.xomp").files.size() == 2);
    CHECK_THROWS_WITH(exported_open_material(gold, "a.json"), Catch::Contains("a.json: must end in .xomp"));
    CHECK_THROWS_WITH(exported_open_material(brdf_of("brushed-aluminium.json", two_wavelengths), "a.xomp"),
                      Catch::Contains("depends on the azimuth of the light"));
}

TEST_CASE("OpenMATERIAL: what is wrong is named with its key") {
    const TemporaryFolder folder;
    folder.write("a_optical.xompt",
                 std::string{"{"} + metadata_text +
                     R"(, "opticalProperties": [[5e-7, 293, 1.5, 0], [6e-7, 293, 1.4, 0]]})");
    const auto message = [&](const std::string& name, const std::string& text, const BrdfReading& how = {}) {
        const auto path = folder.write(name, text);
        return complaint(folder, [&] { static_cast<void>(read_brdf(path, how)); });
    };
    const auto material = [&](const std::string& properties) {
        return message("a.xomp",
                       std::string{"{"} + metadata_text + R"(, "materialProperties": {)" + properties + "}}");
    };
    const std::string roughness =
        R"("surfaceRoughness": {"surfaceHeightRms": 1e-7, "surfaceCorrelationLength": 1e-6, "sources": "s"})";
    CHECK(material(roughness + R"(, "opticalPropertiesUri": "a_optical.xompt")").empty());
    CHECK(material(roughness) ==
          "a.xomp: key \"materialProperties\": holds neither surfaceRoughness with opticalPropertiesUri nor "
          "brdfUris: must hold one of them");
    CHECK(material(roughness + R"(, "opticalPropertiesUri": "none_optical.xompt")")
              .find("none_optical.xompt") == 0);
    CHECK(material(roughness + R"(, "opticalPropertiesUri": "/etc/passwd")") ==
          "a.xomp: key \"materialProperties.opticalPropertiesUri\": must be a relative path");
    CHECK(material(replaced(roughness, "1e-7", "-1e-7") + R"(, "opticalPropertiesUri": "a_optical.xompt")") ==
          "a.xomp: key \"materialProperties.surfaceRoughness.surfaceHeightRms\": -1e-07: must be a height in "
          "m, from 0 to 1");
    CHECK(
        message("b.xomp", R"({"metadata": {"openMaterial3dVersion": "1.0.0"}, "materialProperties": {}})") ==
        "b.xomp: key \"metadata.name\": missing");
    folder.write("a_optical.xompt",
                 std::string{"{"} + metadata_text + R"(, "opticalProperties": [[550, 293, 1.5, 0]]})");
    CHECK(material(roughness + R"(, "opticalPropertiesUri": "a_optical.xompt")") ==
          "a_optical.xompt: key \"opticalProperties\": row 1: wavelength 550 m: must be from 1e-9 to 1");

    const auto table = [&](const std::string& rows, const BrdfReading& how = {}) {
        return message("a_brdf.xompt", brdf_table(rows), how);
    };
    const std::string good = "[5.5e-7, 0.1, 0.2, 3.14159, 0.5], [5.5e-7, 0.1, 0.9, 3.14159, 0.4]";
    CHECK(table(good).empty());
    CHECK(table("").find("key \"brdf.lookupTable\": must have a row at least") != std::string::npos);
    CHECK(table("[5.5e-7, 0.1, 0.2]").find("brdf.lookupTable[1]\": must be [wavelength m") !=
          std::string::npos);
    CHECK(table(replaced(good, "0.2", "20")).find("[3]\": 20: must be an angle from 0 to pi/2 rad") !=
          std::string::npos);
    CHECK(table(replaced(good, "5.5e-7", "550")).find("550: must be a wavelength in m") != std::string::npos);
    CHECK(table(replaced(good, "0.2", "null")).find("must be a number, not null") != std::string::npos);
    CHECK(table(good + ", [5.5e-7, 0.1, 0.2, 3.14159, 0.6]").find("again: must have one value") !=
          std::string::npos);
    CHECK(table(replaced(good, "5.5e-7", "null")).find("must all be numbers, or all null") !=
          std::string::npos);
    const std::string unnamed = "[null, 0.1, 0.2, 3.14159, 0.5], [null, 0.1, 0.9, 3.14159, 0.4]";
    CHECK(table(unnamed) == "a_brdf.xompt: does not say its wavelength, which must be given");
    CHECK(table(unnamed, {.wavelengths = spectral::WavelengthGrid::from_micrometres({0.5})}).empty());
}

TEST_CASE("BiRD: lists are equally long, units and pairs come back, what is wrong is named") {
    for (const char* file : {"rough-aluminium.json", "brushed-aluminium.json"}) {
        const auto brdf = brdf_of(file, two_wavelengths);
        const bool isotropic = brdf.properties().isotropic;
        AngularGrid grid = csv_grid(isotropic);
        if (!isotropic) {  // few nodes, of which one is asked for below
            grid.phi_i = {0, 60, 120, 180, 240, 300};
            grid.theta_i = grid.polar = {0, 30, 60, 85};
            grid.azimuth = {0, 90, 180};
        }
        const std::string text = bird_text(brdf, grid);
        check_bird(json::parse(text));
        const auto read = brdf_from("b", points_of_bird(text, "b", std::nullopt));
        const DirectionPair node{Direction::from_degrees(30, 60), Direction::from_degrees(30, 240)};
        for (std::size_t i : {0U, 1U})
            CHECK(read.brdf.brdf(node)[i] == Approx(brdf.brdf(node)[i]).epsilon(isotropic ? 0.05 : 1e-5));
        if (!isotropic) continue;
        const RoundTrip trip = round_trip(brdf, read.brdf, {2000, 3});
        std::cout << "BiRD, " << file << ": worst " << trip.worst.error << ", 99 % " << trip.percentile_99
                  << '\n';
        CHECK(trip.percentile_99 < 0.03);
    }
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text, const BrdfReading& how = {}) {
        const auto path = folder.write("b.json", bird(text));
        return complaint(folder, [&] { static_cast<void>(read_brdf(path, how)); });
    };
    CHECK(message(bird_good).empty());
    CHECK(read_brdf(folder.path() / "b.json").format == "bird");
    CHECK(message(replaced(bird_good, "[20, 60, 20, 60]", "[20, 60]")) ==
          "b.json: key \"data.theta_r.values\": 2 values: must be as many as BRDF has, 4");
    CHECK(
        message(replaced(bird_good, "\"deg\"", "\"degrees\"")).find("\"degrees\": must be one of deg, rad") !=
        std::string::npos);
    CHECK(message(replaced(bird_good, "\"nm\"", "\"Angstrom\"")).find("data.wavelength.unit") !=
          std::string::npos);
    // as the schema has them: wavelengths of the light and of what is seen, in its spelling of micrometres
    const std::string in_um =
        replaced(bird_good, "\"wavelength\": {\"unit\": \"nm\", \"values\": [550, 550, 550, 550]",
                 "\"wavelength_r\": {\"unit\": \"\u03bcm\", \"values\": [0.55, 0.55, 0.55, 0.55]");
    CHECK(message(replaced(in_um, "\"deg\"", "\"\u00b0\"")).empty());
    CHECK(message(in_um + R"(, "wavelength_i": {"unit": "nm", "values": [550, 550, 550, 600]})")
              .find("differs from the wavelengths before it") != std::string::npos);
    CHECK(message(replaced(bird_good, "[10, 10,", "[100, 10,")) ==
          "b.json: theta_i, value 1: polar angle 100 deg: must be from 0 to 90");
    CHECK(message(replaced(bird_good, "0.1,", "\"x\",")).find("must be a number, not a string") !=
          std::string::npos);
    CHECK(message(replaced(bird_good, "\"phi_r\"", "\"phi_s\"")) == "b.json: key \"data.phi_r\": missing");
    CHECK(message(bird_good + R"(, "polarisation": {"values": ["s", "p", "s", "p"]})")
              .find("several kinds, p, s: must be one") != std::string::npos);
    CHECK(message(replaced(bird_good, "[550, 550, 550, 550]", "[550, 550, 550, 600]"))
              .find("1 of 2 wavelengths") != std::string::npos);
    CHECK(message(bird_good, {.wavelengths = two_wavelengths}) ==
          "b.json: says its wavelengths, which must not be given");
}

TEST_CASE("LightTools' blocks come back") {
    const auto brdf = brdf_of("rough-aluminium.json", two_wavelengths);
    const std::string text = lighttools_text(brdf, csv_grid());
    CHECK(is_lighttools_file(text));
    CHECK(text.find("ScatterAzimuth 23\n90 ") != std::string::npos);
    const auto read = brdf_from("l", points_of_lighttools(text, "l", std::nullopt));
    const RoundTrip trip = round_trip(brdf, read.brdf, {2000, 3});
    std::cout << "LightTools: worst " << trip.worst.error << ", 99 % " << trip.percentile_99 << '\n';
    CHECK(trip.percentile_99 < 0.03);
    // TIS of light along the normal is the reflectance of the diffuse terms
    const auto at = text.find("TIS ");
    const double tis = spectral::number_in(text.substr(at + 4, text.find('\n', at) - at - 4));
    const auto albedo = brdf.albedo(Direction::from_degrees(0, 0), 0);
    CHECK(tis == Approx(albedo.directional_diffuse + albedo.uniform_diffuse).epsilon(1e-5));
    CHECK_THROWS_WITH(lighttools_text(brdf_of("brushed-aluminium.json", two_wavelengths), csv_grid(false)),
                      Catch::Contains("must be isotropic in a LightTools file"));
}

TEST_CASE("damaged JSON of other programs gives a named error or something sound") {
    const std::vector<std::string> nasty{"nan",
                                         "-1",
                                         "1e308",
                                         "1e999",
                                         "null",
                                         "[",
                                         "]",
                                         "{",
                                         "}",
                                         "\"",
                                         ",",
                                         "\n",
                                         std::string(1, '\0'),
                                         "\xff",
                                         "[[[[[[[[",
                                         "\"deg\"",
                                         "true"};
    const std::string rows =
        "[5.5e-7, 0.1, 0.2, 3.14, 0.5], [5.5e-7, 0.1, 0.9, 3.14, 0.4], [5.5e-7, 0.8, 0.2, 0, 0.1]";
    const auto sound = [](const spectral::Reflectance& brdf) {
        std::vector<double> values(brdf.size());
        for (const double theta : {0., 25., 60., 89.}) {
            brdf.evaluator().brdf({Direction::from_degrees(theta, 0), Direction::from_degrees(40, 170)},
                                  values);
            for (const double value : values)
                tables::testing::require_sound(value >= 0 && std::isfinite(value));
        }
    };
    tables::testing::check_damaged(
        {"OpenMATERIAL", brdf_table(rows), 600, nasty, [&](const std::string& text) {
             sound(brdf_from("o", points_of_open_material(text, "o", std::nullopt)).brdf);
         }});
    tables::testing::check_damaged({"BiRD", bird(bird_good), 600, nasty, [&](const std::string& text) {
                                        sound(brdf_from("b", points_of_bird(text, "b", std::nullopt)).brdf);
                                    }});
}
