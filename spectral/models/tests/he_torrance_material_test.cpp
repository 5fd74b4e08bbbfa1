#include "spectral/models/he_torrance_material.hpp"

#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "temporary_folder.hpp"

using hts::Wavelength;
using hts::spectral::DiffuseAlbedo;
using hts::spectral::Material;
using hts::spectral::OutsideRange;
using hts::spectral::PiecewiseLinear;
using hts::spectral::read_material;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;

namespace {

const auto green = Wavelength::from_micrometres(0.55);

// A material file with this index and albedo.
std::string file_with(const std::string& index, const std::string& albedo = "0.0") {
    return R"({"name": "test", "model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, )"
           R"("index": )" +
           index + R"(, "diffuse_albedo": )" + albedo + "}";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto position = text.find(what);
    REQUIRE(position != std::string::npos);
    return text.replace(position, what.size(), by);
}

std::string complaint_about(const TemporaryFolder& folder, const std::string& text) {
    const auto path = folder.write("m.json", text);
    return complaint(folder, [&path] { static_cast<void>(read_material(path)); });
}

}  // namespace

TEST_CASE("the material file of the interface contract is read") {
    const TemporaryFolder folder;
    const auto path = folder.write("aluminium.json", R"({
      "name": "roughened aluminium",
      "model": "he",
      "rms_roughness_um": 0.28,
      "correlation_length_um": 1.77,
      "index": "Al",
      "diffuse_albedo": 0.0
    })");
    const Material material = read_material(path);
    CHECK(material.name() == "roughened aluminium");
    CHECK(material.properties().surface->rms_roughness() == 0.28);
    CHECK(material.properties().surface->correlation_length() == 1.77);
    const auto samples = material.at(green);
    CHECK(samples.samples()[0].index.substrate().k() ==
          hts::spectral::built_in_optical_constants("Al").index(green).k());
    CHECK(samples.samples()[0].uniform_diffuse == 0);
}

TEST_CASE("name and albedo may be left out") {
    const TemporaryFolder folder;
    const auto path = folder.write("my mirror.json", R"({"model": "he", "rms_roughness_um": 0,
        "correlation_length_um": 1, "index": "Ag"})");
    const Material material = read_material(path);
    CHECK(material.name() == "my mirror");
    CHECK(material.properties().surface->rms_roughness() == 0);
    CHECK(material.at(green).uniform_diffuse()[0] == 0);
}

TEST_CASE("every form of index is read") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "nk");
    folder.write("nk/glass.csv", "wavelength_nm,n,k\n500,1.5,0\n600,1.6,0.1\n");
    const auto index = [&folder](const std::string& text, const Wavelength& wavelength = green) {
        return read_material(folder.write("m.json", file_with(text)))
            .at(wavelength)
            .samples()[0]
            .index.substrate();
    };
    CHECK(index(R"("Cu")").n() == hts::spectral::built_in_optical_constants("Cu").index(green).n());
    CHECK(index(R"({"n": 0.77, "k": 6})").n() == 0.77);
    CHECK(index(R"({"n": 0.77, "k": 6})").k() == 6);
    CHECK(index(R"({"file": "nk/glass.csv"})").n() == Approx(1.55).epsilon(1e-14));
    const auto absolute = (folder.path() / "nk" / "glass.csv").string();
    CHECK(index(R"({"file": ")" + absolute + R"("})").k() == Approx(0.05).epsilon(1e-14));
    const std::string table = R"({"table": [[0.6, 1.6, 0.1], [0.5, 1.5, 0]]})";
    CHECK(index(table).n() == Approx(1.55).epsilon(1e-14));
    CHECK(complaint(folder, [&] { static_cast<void>(index(table, Wavelength::from_micrometres(1))); }) ==
          "wavelength 1 um: must be from 0.5 to 0.6 um (range of m.json: key \"index\")");
}

TEST_CASE("every form of albedo is read") {
    const TemporaryFolder folder;
    const auto albedo = [&folder](const std::string& text, const Wavelength& wavelength = green,
                                  OutsideRange outside = OutsideRange::error) {
        const auto at = read_material(folder.write("m.json", file_with(R"("Al")", text)))
                            .at(wavelength, {.outside = outside});
        return at.samples()[0].uniform_diffuse * std::numbers::pi;
    };
    CHECK(albedo("0.25") == Approx(0.25).epsilon(1e-15));
    CHECK(albedo("1") == Approx(1).epsilon(1e-15));
    const std::string table = R"({"table": [[0.6, 0.5], [0.5, 0.1]]})";
    CHECK(albedo(table) == Approx(0.3).epsilon(1e-14));
    CHECK_THROWS_WITH(albedo(table, Wavelength::from_micrometres(1)),
                      "wavelength 1 um: must be from 0.5 to 0.6 um (range of diffuse albedo)");
    CHECK(albedo(table, Wavelength::from_micrometres(1), OutsideRange::hold) == Approx(0.5).epsilon(1e-15));
}

TEST_CASE("albedos that cannot be are refused") {
    CHECK_THROWS_WITH(DiffuseAlbedo{1.2}, "diffuse albedo 1.2: must be from 0 to 1");
    CHECK_THROWS_WITH(DiffuseAlbedo{-0.1}, "diffuse albedo -0.1: must be from 0 to 1");
    CHECK_THROWS_AS(DiffuseAlbedo{std::numeric_limits<double>::quiet_NaN()}, hts::Error);
    CHECK_THROWS_WITH((DiffuseAlbedo{PiecewiseLinear{{{0.5, 0.5}, {0.6, 1.5}}}}),
                      "diffuse albedo 1.5: must be from 0 to 1");
}

TEST_CASE("an index that cannot be is refused with its key") {
    const TemporaryFolder folder;
    folder.write("bad.csv", "wavelength_um,n\n0.5,abc\n");
    const std::pair<std::string, std::string> cases[] = {
        {"3", "\"index\": must be a built-in name, {\"n\", \"k\"}, {\"file\"} or {\"table\"}"},
        {"{}", "\"index\": must have \"n\" and \"k\", or \"file\", or \"table\""},
        {R"({"N": 1})", "\"index\": must have \"n\" and \"k\", or \"file\", or \"table\""},
        {R"({"n": 1.5})", "\"index.k\": missing"},
        {R"({"k": 1.5})", "\"index.n\": missing"},
        {R"({"n": 1.5, "k": 0, "x": 1})", "\"index.x\": not known; must be one of n, k"},
        {R"({"n": "1.5", "k": 0})", "\"index.n\": must be a number, not a string"},
        {R"({"n": 1.5, "k": null})", "\"index.k\": must be a number, not null"},
        {R"({"n": 0, "k": 0})", "\"index.n\": refractive index n 0: must be > 0 and at most 1e+24"},
        {R"({"n": 1.5, "k": -1})",
         "\"index.k\": extinction coefficient k -1: must be >= 0 and at most 1e+24"},
        {R"({"file": 3})", "\"index.file\": must be a string, not a number"},
        {R"({"file": "none.yml"})", "\"index.file\": none.yml: no such file"},
        {R"({"file": "bad.csv"})", "\"index.file\": bad.csv:2: column \"n\": \"abc\" is not a number"},
        {R"({"file": "bad.csv", "n": 1})", "\"index.n\": not known; must be one of file"},
        {R"({"table": 3})", "\"index.table\": must be an array of rows [um, n, k], not a number"},
        {R"({"table": []})", "\"index.table\": must have at least one row [um, n, k]"},
        {R"({"table": [[0.5, 1, 0], [0.6, 1]]})", "\"index.table\": row 2: must be 3 numbers, [um, n, k]"},
        {R"({"table": [[0.5, 1, "0"]]})", "\"index.table\": row 1: must be 3 numbers, [um, n, k]"},
        {R"({"table": [0.5, 1, 0]})", "\"index.table\": row 1: must be 3 numbers, [um, n, k]"},
        {R"({"table": [[0.5, 1, -1]]})",
         "\"index.table\": row 1: extinction coefficient k -1: must be >= 0 and at most 1e+24"},
        {R"({"table": [[-0.5, 1, 1]]})",
         "\"index.table\": row 1: wavelength -0.5 um: must be > 0 (from 1e-24 to 1e+24 um)"},
    };
    for (const auto& [index, message] : cases) {
        CHECK(complaint_about(folder, file_with(index)) == "m.json: key " + message);
    }
    CHECK_THAT(complaint_about(folder, file_with("\"Unobtainium\"")),
               Catch::StartsWith(
                   "m.json: key \"index\": no built-in material \"Unobtainium\": must be one of Ag, Al"));
}

TEST_CASE("lengths, albedo, model and keys that cannot be are refused with their key") {
    const TemporaryFolder folder;
    const std::string good = file_with("\"Al\"");
    CHECK(complaint_about(folder, good).empty());
    const std::string keys =
        "name, model, rms_roughness_um, correlation_length_um, azimuth_deg, correlation, rms_band_um, index, "
        "films, diffuse_albedo";
    struct Case {
        std::string what, by, message;
    };
    const Case cases[] = {
        {"\"he\"", "1", "\"model\": must be a string, not a number"},
        {"\"model\": \"he\",", "", "\"model\": missing"},
        {"\"test\"", "{}", "\"name\": must be a string, not an object"},
        {"\"name\"", "\"Name\"", "\"Name\": not known; must be one of " + keys + "; did you mean \"name\"?"},
        {"\"name\"", "\"model\"", "\"model\": stands twice"},
        {"\"name\"", "\"na\\nme\"",
         "\"na?me\": not known; must be one of " + keys + "; did you mean \"name\"?"},
        {"\"rms_roughness_um\": 0.28,", "", "\"rms_roughness_um\": missing"},
        {"0.28", "\"0.28\"", "\"rms_roughness_um\": must be a number, not a string"},
        {"0.28", "true", "\"rms_roughness_um\": must be a number, not a boolean"},
        {"0.28", "-0.1",
         "\"rms_roughness_um\": rms roughness -0.1 um: must be >= 0 (0, or from 1e-24 to 1e+24 um)"},
        {"\"correlation_length_um\": 1.77,", "", "\"correlation_length_um\": missing"},
        {"1.77", "[1.77]", "\"correlation_length_um\": must be a number or a list of two, [along, across]"},
        {"1.77", "0",
         "\"correlation_length_um\": correlation length 0 um: must be > 0 (from 1e-24 to 1e+24 um)"},
        {"\"index\": \"Al\",", "", "\"index\": missing"},
        {"0.0", "1.5", "\"diffuse_albedo\": diffuse albedo 1.5: must be from 0 to 1"},
        {"0.0", "\"0\"", "\"diffuse_albedo\": must be a number, not a string"},
        {"0.0", "{}", "\"diffuse_albedo.table\": missing"},
        {"0.0", "{\"table\": [], \"x\": 1}", "\"diffuse_albedo.x\": not known; must be one of table"},
        {"0.0", "{\"table\": [[0.5, 0.1, 0.2]]}",
         "\"diffuse_albedo.table\": row 1: must be 2 numbers, [um, a]"},
        {"0.0", "{\"table\": [[0.5, 0.1], [0.6, -0.2]]}",
         "\"diffuse_albedo.table\": row 2: diffuse albedo -0.2: must be from 0 to 1"},
    };
    for (const auto& [what, by, message] : cases) {
        CHECK(complaint_about(folder, replaced(good, what, by)) == "m.json: key " + message);
    }
}

TEST_CASE("files that are no JSON object are refused with path and line") {
    const TemporaryFolder folder;
    const std::string good = file_with("\"Al\"");
    CHECK(complaint_about(folder, "") == "m.json: file is empty");
    CHECK(complaint_about(folder, " \n\n") == "m.json: file is empty");
    CHECK(complaint_about(folder, "[1, 2]") == "m.json: must be an object, not an array");
    CHECK(complaint_about(folder, "\"he\"") == "m.json: must be an object, not a string");
    CHECK(complaint_about(folder, "{\n\"model\": \"\xB5\"}") == "m.json:2: not UTF-8 text");
    CHECK_THAT(complaint_about(folder, "{\n\"model\": \"he\",\n\"name\": \"x"),
               Catch::StartsWith("m.json:3: not valid JSON: syntax error"));
    CHECK_THAT(complaint_about(folder, "{\n\"model\": \"he\",\n\n\n"),
               Catch::StartsWith("m.json:2: not valid JSON: syntax error"));
    CHECK_THAT(complaint_about(folder, "{\n\"model\": \"he\"\n\"name\": \"x\"}"),
               Catch::StartsWith("m.json:3: not valid JSON: syntax error"));
    CHECK_THAT(complaint_about(folder, good + "\n}"),
               Catch::StartsWith("m.json:2: not valid JSON: syntax error"));
    CHECK_THAT(complaint_about(folder, replaced(good, "0.28", "NaN")),
               Catch::StartsWith("m.json:1: not valid JSON: syntax error"));
    CHECK_THAT(complaint_about(folder, replaced(good, "0.28", "0.28 /* um */")),
               Catch::StartsWith("m.json:1: not valid JSON: syntax error"));
    CHECK(complaint_about(folder, replaced(good, "0.28", "1e999")) ==
          "m.json: not valid JSON: number overflow parsing '1e999'");
    for (std::size_t length = 0; length < good.size(); ++length) {
        const auto message = complaint_about(folder, good.substr(0, length));
        CHECK_THAT(message, Catch::StartsWith("m.json"));
        CHECK(message.find('\n') == std::string::npos);
    }
    std::filesystem::create_directory(folder.path() / "d.json");
    CHECK_THROWS_WITH(read_material(folder.path() / "d.json"), Catch::EndsWith("is a directory, not a file"));
    CHECK_THROWS_WITH(read_material(folder.path() / "none.json"), Catch::EndsWith("none.json: no such file"));
}

TEST_CASE("values that a caller gives go before the material's") {
    const TemporaryFolder folder;
    const auto written = [&folder](double roughness, double length, const std::string& index, double albedo) {
        return read_material(folder.write(
            "m.json", R"({"model": "he", "rms_roughness_um": )" + std::to_string(roughness) +
                          R"(, "correlation_length_um": )" + std::to_string(length) + R"(, "index": )" +
                          index + R"(, "diffuse_albedo": )" + std::to_string(albedo) + "}"));
    };
    const Material own = written(0.28, 1.77, R"({"table": [[0.5, 1.5, 1], [0.6, 1.6, 2]]})", 0.1);
    const Material wanted = written(0.5, 2.5, R"({"n": 2, "k": 3})", 0.25);
    const hts::DirectionPair pair{hts::Direction::from_degrees(30, 0), hts::Direction::from_degrees(40, 170)};
    const hts::spectral::RoughSurfaceValues all{
        .n = 2, .k = 3, .rms_roughness = 0.5, .correlation_length = 2.5, .diffuse_albedo = 0.25};
    CHECK(own.at(green, {.instead = all}).brdf(pair) == wanted.at(green).brdf(pair));
    const auto one = own.at(green, {.instead = {.n = 2}});
    CHECK(one.samples()[0].index.substrate().n() == 2);
    CHECK(one.samples()[0].index.substrate().k() == own.at(green).samples()[0].index.substrate().k());

    const auto infrared = Wavelength::from_micrometres(10);
    CHECK(own.at(infrared, {.instead = all}).brdf(pair) == wanted.at(infrared).brdf(pair));
    CHECK_THROWS_WITH(own.at(infrared, {.instead = {.n = 2}}), Catch::Contains("must be from 0.5 to 0.6 um"));
    CHECK_THROWS_WITH(own.at(green, {.instead = {.diffuse_albedo = 1.5}}), Catch::Contains("albedo 1.5"));
    CHECK_THROWS_WITH(own.at(green, {.instead = {.rms_roughness = -1}}), Catch::Contains("rms roughness -1"));
}
