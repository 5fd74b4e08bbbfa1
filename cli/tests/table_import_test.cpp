// hts table export and import of the formats in text, and a measured file as a material of the other verbs.

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Result;
using hts::cli::testing::Workplace;

namespace {

const std::string point = " --wavelength 0.55 --theta-i 30 --theta-r 40 --phi 175";

double brdf_at_point(const Workplace& place, const std::string& material) {
    const Result answer = place.hts("eval --material " + material + point);
    INFO(answer.errors);
    REQUIRE(answer.exit_code == 0);
    const auto table = cells(answer.output);
    for (std::size_t i = 0; i < table[0].size(); ++i)
        if (table[0][i] == "brdf") return std::stod(table[1][i]);
    return -1;
}

}  // namespace

TEST_CASE("a file that was exported is imported as a material") {
    const Workplace place;
    const std::string gold = HTS_SOURCE_DIR "/cli/data/rough-gold.json";
    const double exact = brdf_at_point(place, gold);
    for (const std::string format : {"zemax", "klems", "csv"}) {
        INFO(format);
        const std::string file = "gold." + format;
        const Result written =
            place.hts("table export " + gold + " --wavelengths 0.55 --pairs 500 --format " + format +
                      " --output " + file);
        INFO(written.errors);
        REQUIRE(written.exit_code == 0);
        CHECK(written.output.find("worst") != std::string::npos);
        CHECK(place.read(file + ".json").find("wavelengths_um") != std::string::npos);
        const Result read = place.hts("table import " + file + " --output measured.json");
        INFO(read.errors);
        REQUIRE(read.exit_code == 0);
        CHECK(read.errors.find("isotropic") != std::string::npos);
        const auto table = cells(read.output);
        REQUIRE(table.size() == 2);
        CHECK(std::stod(table[1][1]) == Approx(0.75).margin(0.05));  // gold at 0.55 um
        CHECK(brdf_at_point(place, "measured.json") == Approx(exact).epsilon(format == "klems" ? 0.3 : 0.01));
    }
    CHECK(place.hts("polar --material measured.json --wavelength 0.55 --theta-i 30 --output polar.csv")
              .exit_code == 0);
    CHECK(place.hts("sample --material measured.json --wavelength 0.55 --theta-i 30 --count 50").exit_code ==
          0);
}

TEST_CASE("what cannot be imported is refused by name") {
    const Workplace place;
    place.file("scan.csv", "theta_i_deg,theta_r_deg,phi_r_deg,brdf\n10,10,180,1\n10,20,180,0.5\n");
    const Result silent = place.hts("table import scan.csv");
    CHECK(silent.exit_code == 1);
    CHECK(silent.errors.find("scan.csv: does not say its wavelength") != std::string::npos);
    const Result told = place.hts("table import scan.csv --wavelengths 0.633 --output scan.json");
    CHECK(told.exit_code == 0);
    CHECK(place.read("scan.json").find("[0.633]") != std::string::npos);
    CHECK(place.hts("table import none.csv").errors.find("no such file") != std::string::npos);
    CHECK(place.hts("table import scan.csv --format ply").exit_code == 2);
    place.file("broken.bsdf", "Source Measured\nSymmetry Round\n");
    CHECK(place.hts("table import broken.bsdf").errors.find("broken.bsdf:2: Symmetry") != std::string::npos);
    CHECK(place.hts("eval --material scan.json --wavelength 0.5 --theta-i 10 --theta-r 10 --phi 180")
              .errors.find("0.633 um") != std::string::npos);
}

namespace {

/// 0.05 + 2 exp(-(delta/5 deg)^2) about the mirror direction of light from 30 deg, in its plane.
///   mirror   what the file calls the mirror direction's azimuth, 180 or 0 [deg]
std::string in_plane_scan(const std::string& mirror = "180") {
    const std::string light = mirror == "180" ? "0" : "180";
    std::string text = "theta_i_deg,theta_r_deg,phi_r_deg,brdf\n";
    for (int theta = -88; theta <= 88; ++theta) {
        const double delta = (theta - 30) / 5.0;
        text += "30," + std::to_string(std::abs(theta)) + "," + (theta < 0 ? light : mirror) + "," +
                std::to_string(0.05 + 2 * std::exp(-delta * delta)) + "\n";
    }
    return text;
}

double number_in_column(const Result& answer, const std::string& name, std::size_t row = 1) {
    INFO(answer.errors);
    REQUIRE(answer.exit_code == 0);
    const auto table = cells(answer.output);
    for (std::size_t i = 0; i < table[0].size(); ++i)
        if (table[0][i] == name) return std::stod(table.at(row)[i]);
    FAIL("no column " + name);
    return -1;
}

}  // namespace

TEST_CASE("a scan of the plane of incidence reflects what a lobe about the mirror direction does") {
    const Workplace place;
    place.file("scan.csv", in_plane_scan());
    const Result read = place.hts("table import scan.csv --wavelengths 0.55 --output scan.json");
    INFO(read.errors);
    REQUIRE(read.exit_code == 0);
    CHECK(read.errors.find("views beside it are assumed") != std::string::npos);
    CHECK(
        read.errors.find("covers 0.55 um, theta_i 30 deg, angle from the mirror direction -58 to 118 deg") !=
        std::string::npos);
    CHECK(cells(read.output)[1][1] == "nan");  // light from the normal was not measured
    // 0.05 pi + 2 pi (5 deg)^2 cos 30 deg, the lobe being narrow
    CHECK(number_in_column(read, "albedo_at_30_deg") == Approx(0.1985).epsilon(0.01));
    const std::string ask = " --material scan.json --wavelengths 0.55 --theta-i ";
    CHECK(number_in_column(place.hts("albedo" + ask + "30"), "total") == Approx(0.1985).epsilon(0.01));
    const std::string eval = "eval --material scan.json --wavelength 0.55 --theta-i 30 --theta-r 30 --phi 90";
    CHECK(number_in_column(place.hts(eval), "brdf") == Approx(0.05).epsilon(1e-3));
    const Result other = place.hts("albedo" + ask + "50");
    CHECK(other.exit_code == 1);
    CHECK(other.errors.find("measured in 0 % of the hemisphere of views from theta_i 50 deg") !=
          std::string::npos);
    CHECK(other.errors.find("--outside hold or zero") != std::string::npos);
    CHECK(number_in_column(place.hts("albedo --outside hold" + ask + "50"), "total") ==
          Approx(0.19).margin(0.02));
    CHECK(number_in_column(place.hts("albedo --clamp" + ask + "50"), "total") == Approx(0.19).margin(0.02));
    CHECK(number_in_column(place.hts("albedo --outside zero" + ask + "50"), "total") == 0);
    CHECK(place.hts("albedo --outside nothing" + ask + "50").exit_code == 2);
    CHECK(place.hts("sample --material scan.json --wavelength 0.55 --theta-i 30 --count 5").exit_code == 1);
    CHECK(place.hts("sample --outside hold --material scan.json --wavelength 0.55 --theta-i 30 --count 5")
              .exit_code == 0);
}

TEST_CASE("data that reflect more than falls in are named") {
    const Workplace place;
    std::string text = "theta_i_deg,theta_r_deg,phi_r_deg,brdf\n";
    for (const int theta_i : {0, 30, 60, 89})
        for (const int theta_r : {0, 30, 60, 89})
            for (const int phi : {0, 90, 180})
                text += std::to_string(theta_i) + "," + std::to_string(theta_r) + "," + std::to_string(phi) +
                        ",1\n";
    place.file("bright.csv", text);
    const Result read = place.hts("table import bright.csv --wavelengths 0.55");
    CHECK(read.exit_code == 0);
    CHECK(read.errors.find("bright.csv: WARNING: reflects 3.14") != std::string::npos);
}

TEST_CASE("a material file leads back to what it was made of, from wherever it stands") {
    namespace fs = std::filesystem;
    const Workplace place;
    place.file("scan.csv", in_plane_scan());
    fs::create_directories((place.folder() / "deep/real"));
    fs::create_directory_symlink((place.folder() / "deep/real"), (place.folder() / "link"));
    const std::string point = " --wavelength 0.55 --theta-i 30 --theta-r 30 --phi 180";
    for (const std::string output : {"m.json", "deep/m.json", "link/m.json", "deep/../deep/real/../m.json"}) {
        INFO(output);
        CHECK(place.hts("table import scan.csv --wavelengths 0.55 --output " + output).exit_code == 0);
        CHECK(number_in_column(place.hts("eval --material " + output + point), "brdf") == Approx(2.05));
    }
    // a link into another folder: the file leads back from there, too
    fs::create_symlink(place.folder() / "deep/real/target.json", place.folder() / "linked.json");
    CHECK(place.hts("table import scan.csv --wavelengths 0.55 --output linked.json").exit_code == 0);
    for (const std::string name : {"linked.json", "deep/real/target.json"})
        CHECK(number_in_column(place.hts("eval --material " + name + point), "brdf") == Approx(2.05));
    const Result redirected =
        place.hts("table import /dev/stdin --wavelengths 0.55 --output s.json < scan.csv");
    INFO(redirected.errors);
    CHECK(redirected.exit_code == 0);
    CHECK(place.hts("table import - --wavelengths 0.55 < scan.csv").output == redirected.output);
    CHECK(number_in_column(place.hts("eval --material s.json" + point), "brdf") == Approx(2.05));
    // a pipe is read, but no file can name it
    CHECK(place.hts("table import /dev/stdin --wavelengths 0.55", "cat scan.csv |").exit_code == 0);
    const Result piped =
        place.hts("table import /dev/stdin --wavelengths 0.55 --output p.json", "cat scan.csv |");
    CHECK(piped.exit_code == 1);
    CHECK(piped.errors.find("/dev/stdin: no file that p.json could name") != std::string::npos);
    CHECK_FALSE(fs::exists(place.folder() / "p.json"));
}

TEST_CASE("azimuths that seem to be counted from the mirror direction are asked about") {
    const Workplace place;
    place.file("scan.csv", in_plane_scan());
    place.file("turned.csv", in_plane_scan("0"));
    const std::string question = "are azimuths counted from the mirror direction?";
    CHECK(place.hts("table import turned.csv --wavelengths 0.55").errors.find(question) != std::string::npos);
    CHECK(place.hts("table import scan.csv --wavelengths 0.55").errors.find(question) == std::string::npos);
    place.file("r.json",
               R"({"format": "csv", "sweep": "outgoing", "kind": "measured", "surface": "x", "by": "b",
        "source": "s", "licence": "CC0-1.0", "quantity": "brdf", "scale": "absolute",
        "columns": {"theta_i": "theta_i_deg", "theta_r": "theta_r_deg"},
        "values": [{"column": "brdf", "wavelength_um": 0.55}]})");
    const auto noted = [&](int sign) {
        std::string text = "theta_i_deg,theta_r_deg,brdf\n";
        for (int theta = -60; theta <= 60; theta += 5) {
            const double delta = (sign * theta - 30) / 10.0;
            text +=
                "30," + std::to_string(theta) + "," + std::to_string(0.05 + std::exp(-delta * delta)) + "\n";
        }
        place.file("c.csv", text);
        const Result result = place.hts("curves import c.csv --recipe r.json -o c.json");
        CHECK(result.exit_code == 0);
        return result.errors.find("is mirror_sign, or mirror_azimuth_deg, right?") != std::string::npos;
    };
    CHECK_FALSE(noted(1));
    CHECK(noted(-1));
}

TEST_CASE("channels of a colour are no spectrum") {
    const Workplace place;
    const std::string file = HTS_SOURCE_DIR "/tables/formats/tests/odd/matrices/xyz.bsdf";
    const Result read = place.hts("table import " + file + " --output xyz.json");
    const auto table = cells(read.output);
    REQUIRE(table.size() == 4);
    CHECK(table[0].back() == "channel");
    // pi times the file
    CHECK(table[1].back() == "Z");
    CHECK(std::stod(table[1][2]) == Approx(0.05 * 3.14159).epsilon(1e-3));
    CHECK(table[3].back() == "X");
    CHECK(std::stod(table[3][2]) == Approx(0.2 * 3.14159).epsilon(1e-3));
    for (const std::string verb : {"spectrum --theta-i 0 --theta-r 0 --phi 0 --material", "info",
                                   "render sphere --output s.png --material"}) {
        const Result refused = place.hts(verb + " xyz.json");
        INFO(verb);
        CHECK(refused.exit_code == 1);
        CHECK(refused.errors.find("holds the channels Z, Y, X, which are no spectrum") != std::string::npos);
    }
    const std::string point = "eval xyz.json --theta-i 0 --theta-r 0 --phi 0 --wavelength ";
    CHECK(number_in_column(place.hts(point + "0.55"), "brdf") == Approx(0.15));
    for (const std::string& between : {point + "0.5", point + "0.7", std::string{"albedo xyz.json"},
                                       std::string{"polar xyz.json --wavelength 0.5 --theta-i 0 -o p.svg"}}) {
        const Result refused = place.hts(between);
        INFO(between << ": " << refused.errors);
        CHECK(refused.exit_code == 1);
        CHECK(refused.errors.find("um: must be one of 0.46, 0.55, 0.62 um, where the channels Z, Y, X of ") !=
              std::string::npos);
    }
    CHECK(number_in_column(place.hts(point + "0.7 --outside hold"), "brdf") == Approx(0.2));
}

TEST_CASE("points to evaluate may be written by a spreadsheet, and slips in their columns are named") {
    const Workplace place;
    const std::string gold = HTS_SOURCE_DIR "/cli/data/rough-gold.json";
    const auto answer = [&](const std::string& text) {
        place.file("points.csv", text);
        return place.hts("eval --material " + gold + " --points points.csv");
    };
    const double exact = number_in_column(
        answer("wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.55,30,0,40,180\n"), "brdf");
    CHECK(number_in_column(
              answer("wavelength_um;theta_i_deg;phi_i_deg;theta_r_deg;phi_r_deg\n0,55;30;0;40;180\n;;;;\n"),
              "brdf") == exact);
    CHECK(number_in_column(
              answer("wavelength_nm\ttheta_i_deg\tphi_i_deg\ttheta_r_deg\tphi_r_deg\n550\t30\t0\t40\t180\n"),
              "brdf") == exact);
    const Result slip = answer(
        "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,rms_roughness\n0.55,30,0,40,180,0.1\n");
    CHECK(slip.exit_code == 1);
    CHECK(slip.errors.find("column \"rms_roughness\": not known; must be \"rms_roughness_um\"") !=
          std::string::npos);
}
