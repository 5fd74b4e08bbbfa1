// hts surface: what it finds in a map, the files it leaves, and what it refuses.

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"

using hts::cli::testing::cells;
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
        CHECK(std::fabs(description["rms_of_fitted_spectrum_um"].get<double>() - rms) <
              description["rms_of_fitted_spectrum_error_um"].get<double>());
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
        if (describe == "gaussian") continue;  // far off: its errors are not
        const auto uncertain =
            cells(place
                      .hts("eval --material out/material.json --wavelength 0.6 --theta-i 30 "
                           "--theta-r 20 --phi 180 --uncertainty")
                      .output);
        REQUIRE(uncertain.size() == 2);
        const auto& row = uncertain[1];
        const double brdf = std::stod(row[7]), deviation = std::stod(row[row.size() - 2]);
        INFO(describe << ": " << brdf << " +- " << deviation);
        CHECK(uncertain[0][7] == "brdf");
        CHECK(deviation > 0.01 * brdf);
        CHECK(deviation < brdf);
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

TEST_CASE("hts surface meets every bad map with one line that names the file and what is wrong") {
    const Workplace place;
    const auto gsf = [](const std::string& head, std::size_t heights, float height = 0) {
        std::string text = "Gwyddion Simple Field 1.0\n" + head;
        text.append(4 - text.size() % 4, '\0');
        for (std::size_t i = 0; i < heights; ++i) {
            const float z = std::isnan(height) ? height : height + static_cast<float>(i % 7) * 1e-7F;
            text.append(reinterpret_cast<const char*>(&z), sizeof(z));
        }
        return text;
    };
    const std::string size = "XRes = 16\nYRes = 16\n", real = "XReal = 1e-5\nYReal = 1e-5\n",
                      units = "XYUnits = m\nZUnits = m\n";
    const auto npy = [](const std::string& shape, std::size_t bytes) {
        std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
        head.append(117 - head.size(), ' ');
        return std::string{"\x93NUMPY\x01"} + std::string(1, '\0') + std::string(1, char(118)) +
               std::string(1, '\0') + head + "\n" + std::string(bytes, '\0');
    };
    std::string matrix, with_nan;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
            matrix += std::to_string((i * j) % 5) + (i < 15 ? " " : "\n");
            with_nan += std::string{"nan"} + (i < 15 ? " " : "\n");
        }
    const std::string step = " --step 0.5", um = " --height-unit um", both = step + um;
    struct Bad {
        std::string name, content, options;
        std::vector<std::string> parts;
    };
    for (const Bad& bad : std::vector<Bad>{
             // not a number, or none at all
             {"nan.gsf", gsf(size + real + units, 256, NAN), "", {"0 of 256 points have a height"}},
             {"nan.txt", with_nan, both, {"0 of 256 points have a height"}},
             {"flat.gsf",
              gsf(size + real + units, 0) + std::string(1024, '\0'),
              "",
              {"all heights are 0 um"}},
             {"inf.csv", "1,2,inf,4\n", both, {"line 1", "\"inf\" is not a number"}},
             // no points
             {"empty.gsf", "", "", {"empty"}},
             {"head.gsf", gsf(size + real + units, 0), "", {"0 bytes of heights: must be 1024"}},
             {"blank.csv", "\n\n# nothing\n", both, {"no heights"}},
             {"none.xyz", "x y z\n", " --length-unit um" + um, {"no points"}},
             // wrong sizes
             {"short.gsf", gsf(size + real + units, 200), "", {"800 bytes of heights: must be 1024"}},
             {"long.gsf", gsf(size + real + units, 300), "", {"1200 bytes of heights: must be 1024"}},
             {"ragged.csv", "1,2,3,4\n1,2,3\n", both, {"line 2: 3 numbers: must be 4"}},
             {"small.npy", npy("(16, 16)", 1000), both, {"1000 bytes of heights: must be 2048"}},
             {"thin.txt", "1 2 3 4\n1 2 3 4\n", both, {"4 by 2 points", "16 to 8192"}},
             {"esri.asc",
              "ncols 20\nnrows 20\ncellsize 1\n1 2 3\n",
              " --length-unit um" + um,
              {"3 heights: must be 20 times 20"}},
             // heads that lie, up to 1e9 points and far beyond what is there
             {"huge.gsf",
              gsf("XRes = 31623\nYRes = 31623\n" + real + units, 256),
              "",
              {"31623 by 31623 points"}},
             {"huge.npy", npy("(1000000000, 1)", 64), both, {"1 by 1e+09 points"}},
             {"huge.asc",
              "ncols 31623\nnrows 31623\ncellsize 1\n1 2 3\n",
              " --length-unit um" + um,
              {"31623 by 31623 points"}},
             {"far.xyz",
              "0 0 1\n1 1 2\n50000 50000 3\n",
              " --length-unit um" + um,
              {"50001 by 50001 points"}},
             {"half.gsf", gsf("XRes = 16.5\nYRes = 16\n" + real + units, 256), "", {"16.5 by 16 points"}},
             {"minus.gsf", gsf("XRes = -16\nYRes = 16\n" + real + units, 256), "", {"-16 by 16 points"}},
             {"zero.gsf", gsf(size + "XReal = 0\nYReal = 1\n" + units, 256), "", {"point spacing 0 um"}},
             {"odd.gsf", gsf(size + real + "XYUnits = m\nZUnits = px\n", 256), "", {"ZUnits", "unit \"px\""}},
             // units missing, or twice
             {"unit.gsf", gsf(size + real + "XYUnits = m\n", 256), "", {"--height-unit"}},
             {"plane.gsf", gsf(size + "ZUnits = m\n", 256), "", {"--step"}},
             {"steps.txt", matrix, um, {"--step"}},
             {"heights.txt", matrix, step, {"--height-unit"}},
             {"twice.gsf", gsf(size + real + units, 256), step, {"--step", "must not be given"}},
             // no map
             {"text.gsf", "Lorem ipsum dolor\n", both, {"line 1: \"Lorem\" is not a number"}},
             {"bytes.bin", std::string("\x01\0\x02\0", 4), both, {"must be a .gsf"}}}) {
        place.file(bad.name, bad.content);
        INFO(bad.name);
        std::vector<std::string> parts = bad.parts;
        parts.insert(parts.begin(), bad.name);
        check_complaint(place.hts("surface " + bad.name + bad.options), 1, parts);
    }
}

TEST_CASE("hts surface reads files of instruments by a Python package, or says which to install") {
    const Workplace place;
    // a package as surfalize is one, whose file holds a slope
    place.file("surfalize.py", R"(
class Surface:
    step_x, step_y = 0.5, 0.25
    @staticmethod
    def load(path):
        if b'broken' in open(path, 'rb').read(): raise ValueError('no surface\nin it')
        surface = Surface()
        surface.data = [[3 + 0.01 * i + 0.001 * ((7 * i * j) % 13) for i in range(48)] for j in range(40)]
        surface.data[4][5] = float('nan')
        return surface
)");
    place.file("a.x3p", "PK");
    place.file("broken.sdf", "broken");
    const std::string here = "PYTHONPATH=" + place.folder().string();
    const auto found = place.hts("surface a.x3p --json --outliers 0", here);
    INFO(found.errors);
    REQUIRE(found.exit_code == 0);
    const auto map = nlohmann::json::parse(found.output)["maps"][0];
    CHECK(map["name"] == "a");
    CHECK(map["columns"] == 48);
    CHECK(map["rows"] == 40);
    CHECK(map["step_um"][0].get<double>() == Approx(0.5));
    CHECK(map["step_um"][1].get<double>() == Approx(0.25));
    CHECK(map["gaps"] == 1);
    CHECK(map["tilt"][0].get<double>() == Approx(0.02).epsilon(0.05));
    check_complaint(place.hts("surface broken.sdf", here), 1,
                    {"broken.sdf", "by Python: surfalize: no surface in it"});
    check_complaint(place.hts("surface a.x3p --step 1", here), 1, {"a.x3p", "--step", "must not be given"});
    // the current folder is not searched, and a Python without packages is told
    check_complaint(place.hts("surface a.x3p", "PYTHONNOUSERSITE=1"), 1, {"a.x3p", "surfalize"});
    check_complaint(place.hts("surface a.x3p", "PATH=/nowhere"), 1, {"a.x3p", "pip install surfalize"});
    check_complaint(place.hts("surface none.x3p"), 1, {"none.x3p", "no such file"});
}
