#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "comparison.hpp"
#include "hts/terms.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

const std::string aluminium =
    R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al"})";
const std::string header = "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg";

/// The input columns of hts/tests/reference/model.csv.
std::string reference_points() {
    std::ifstream in{HTS_SOURCE_DIR "/hts/tests/reference/model.csv"};
    std::string points;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with('#')) continue;
        std::size_t end = 0;
        for (int comma = 0; comma < 10; ++comma) end = line.find(',', end) + 1;
        points += line.substr(0, end - 1) + "\n";
    }
    return points;
}

}  // namespace

TEST_CASE("hts eval agrees with 80 digits of the printed equations") {
    const Workplace place;
    place.file("points.csv", reference_points());
    const auto result = place.hts("eval --points points.csv --mueller --output values.csv");
    REQUIRE(result.exit_code == 0);
    const auto values = cells(place.read("values.csv"));
    const ReferenceTable table{"tests/reference/model.csv"};
    REQUIRE(values.size() == table.size() + 1);
    WorstCase diffuse{"hts eval: directional_diffuse", 1e-10};
    WorstCase specular{"hts eval: specular_reflectance", 1e-10};
    WorstCase mueller{"hts eval: Mueller elements, of m00", 1e-10};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto where = [row] { return "row " + std::to_string(row); };
        for (std::size_t column = 10; column < values[0].size(); ++column) {
            const std::string& name = values[0][column];
            if (name.starts_with("specular_m")) continue;  // no part of the reference
            const double value = std::strtod(values[row + 1][column].c_str(), nullptr);
            const double expected = table(row, name);
            if (name == "directional_diffuse") diffuse.note(relative_error(value, expected), where);
            if (name == "specular_reflectance" && expected > 1e-280) {
                specular.note(relative_error(value, expected), where);
            }
            if (name.size() == 3 && name[0] == 'm') {
                mueller.note(std::abs(value - expected) / table(row, "m00"), where);
            }
        }
    }
    diffuse.check();
    specular.check();
    mueller.check();
}

TEST_CASE("hts eval repeats the input columns as they stand and adds its own") {
    const Workplace place;
    place.file("al.json", aluminium);
    place.file("points.csv",
               "\xEF\xBB\xBF# a comment\r\nphi_r_deg,note,theta_i_deg,wavelength_um,theta_r_deg,phi_i_deg\r\n"
               "180,\"a, b\",3e1,0.50,40,0\r\n\r\n-180.0,,30,5e-1,40.00,0\r\n");
    const auto result = place.hts("eval --material al.json --points points.csv --detail");
    REQUIRE(result.exit_code == 0);
    std::istringstream lines{result.output};
    std::string first, second, third;
    std::getline(lines, first);
    std::getline(lines, second);
    std::getline(lines, third);
    CHECK(
        first ==
        "phi_r_deg,note,theta_i_deg,wavelength_um,theta_r_deg,phi_i_deg,directional_diffuse,uniform_diffuse,"
        "brdf,specular_reflectance,g,t,effective_roughness_um,shadowing,fresnel,method");
    CHECK(second.starts_with("180,\"a, b\",3e1,0.50,40,0,1.061847933548"));
    CHECK(third.starts_with("-180.0,,30,5e-1,40.00,0,1.061847933548"));
    CHECK(result.errors.find("columns repeated but not used: note") != std::string::npos);
    CHECK(result.errors.find("evaluations/s") != std::string::npos);
}

TEST_CASE("of many columns that hts eval does not use, the first are named and the others counted") {
    const Workplace place;
    place.file("al.json", aluminium);
    std::string names = header, row = "0.5,30,0,40,170";
    for (int i = 0; i < 2000; ++i) {
        names += ",c" + std::to_string(i);
        row += ",1";
    }
    place.file("wide.csv", names + "\n" + row + "\n");
    const auto result = place.hts("eval --material al.json --points wide.csv");
    CHECK(result.exit_code == 0);
    CHECK(result.errors.find("not used: c0, c1, c2, c3, c4, c5, c6, c7, c8, c9 and 1990 more\n") !=
          std::string::npos);
}

TEST_CASE("hts eval of one point, by standard input and of a grid agree") {
    const Workplace place;
    place.file("al.json", aluminium);
    place.file("points.csv", header + "\n0.5,30,0,40,170\n");
    place.file("pairs.csv", "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n30,0,40,170\n");
    const auto single = cells(
        place.hts("eval --material al.json --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 170").output);
    const auto piped = cells(place.hts("eval --material al.json --points - --output - < points.csv").output);
    const auto grid =
        cells(place.hts("eval --material al.json --points pairs.csv --wavelengths 0.5:0.7:3").output);
    REQUIRE(single.size() == 2);
    REQUIRE(grid.size() == 4);
    CHECK(single == piped);
    CHECK(grid[1].back() == single[1].back());
    CHECK(grid[1][5] == single[1][5]);
}

TEST_CASE("material columns override the material, which may be left out") {
    const Workplace place;
    place.file("al.json", aluminium);
    place.file(
        "points.csv",
        header + ",n,k,rms_roughness_um,correlation_length_um,albedo\n0.5,30,0,40,170,1.5,0,0.1,1,0.3\n");
    const auto with = place.hts("eval --material al.json --points points.csv");
    const auto without = place.hts("eval --points points.csv");
    CHECK(with.exit_code == 0);
    CHECK(with.output == without.output);
    CHECK(std::stod(cells(with.output)[1][11]) == Approx(0.3 / 3.14159265358979324).epsilon(1e-15));
}

TEST_CASE("hts eval gives the same bytes for any number of threads") {
    const Workplace place;
    place.file("points.csv", reference_points());
    const auto one = place.hts("eval --points points.csv --mueller", "OMP_NUM_THREADS=1");
    const auto two = place.hts("eval --points points.csv --mueller", "OMP_NUM_THREADS=2");
    const auto five = place.hts("eval --points points.csv --mueller", "OMP_NUM_THREADS=5");
    CHECK(one.exit_code == 0);
    CHECK(one.output == two.output);
    CHECK(one.output == five.output);
}

TEST_CASE("random pairs have the same mean for any number of threads and of chunks") {
    const Workplace place;
    place.file("al.json", aluminium);
    const std::string command = "eval --material al.json --wavelengths 0.5 --tolerance 1e-3 --random-pairs ";
    for (const std::string count : {"1", "8191", "8193", "1048577"}) {
        INFO(count);
        const auto one = place.hts(command + count, "OMP_NUM_THREADS=1");
        REQUIRE(one.exit_code == 0);
        CHECK(place.hts(command + count, "OMP_NUM_THREADS=3").output == one.output);
    }
}

TEST_CASE("of two faults hts eval tells the one of the earlier line") {
    const Workplace place;
    place.file("al.json", aluminium);
    std::string points = header + "\n";
    for (int i = 0; i < 20'000; ++i) points += "0.5,30,0,30,180\n";
    place.file("a.csv", points + "0.5,91,0,30,180\n0.5,\xFF,0,30,180\n");
    const std::string command = "eval --material al.json --output values.csv --points ";
    check_complaint(place.hts(command + "a.csv"), 1, {"a.csv:20002: ", "91"});
    place.file("b.csv", points + "0.5,\xFF,0,30,180\n0.5,91,0,30,180\n");
    check_complaint(place.hts(command + "b.csv"), 1, {"b.csv:20002: not UTF-8 text"});
    place.file("c.csv", "\xFF\n");
    check_complaint(place.hts(command + "c.csv"), 1, {"c.csv:1: not UTF-8 text"});
    CHECK(place.names() == std::vector<std::string>{"a.csv", "al.json", "b.csv", "c.csv"});
}

TEST_CASE("hts eval reads and writes structured arrays of NumPy") {
    const Workplace place;
    place.file("al.json", aluminium);
    place.file("points.csv", header + "\n0.5,30,0,30,180\n0.6,10.1,20,70.3,3e2\n");
    const auto csv = cells(place.hts("eval --material al.json --points points.csv").output);
    REQUIRE(place.hts("eval --material al.json --points points.csv --output a.npy").exit_code == 0);
    const auto again = place.hts("eval --material al.json --points a.npy");
    CHECK(again.errors.find("columns repeated but not used: directional_diffuse") != std::string::npos);
    const auto npy = cells(again.output);
    REQUIRE(npy.size() == csv.size());
    for (std::size_t row = 1; row < csv.size(); ++row) {
        for (std::size_t i = 0; i < csv[0].size(); ++i)
            CHECK(std::stod(npy[row][i]) == std::stod(csv[row][i]));  // what the array holds
        for (std::size_t i = 5; i < csv[0].size(); ++i) CHECK(npy[row][i + 4] == csv[row][i]);
    }
    const auto words = place.hts("eval --material al.json --points points.csv --detail --output b.npy");
    check_complaint(words, 1, {"column method: ", "must be written to a .csv or .json file"});
    place.file("c.npy", "theta_i_deg\n3\n");
    check_complaint(place.hts("eval --material al.json --points c.npy"), 1,
                    {"c.npy: not a .npy file of NumPy"});
    CHECK(place.names() == std::vector<std::string>{"a.npy", "al.json", "c.npy", "points.csv"});
}

TEST_CASE("hts eval writes JSON when asked or by the file's ending") {
    const Workplace place;
    place.file("al.json", aluminium);
    const std::string point =
        "eval --material al.json --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 170 --detail ";
    const auto json = nlohmann::json::parse(place.hts(point + "--json").output);
    CHECK(place.hts(point + "--output answer.json").exit_code == 0);
    CHECK(nlohmann::json::parse(place.read("answer.json")) == json);
    REQUIRE(json.size() == 1);
    CHECK(json[0]["brdf"].is_number());
    CHECK(json[0]["method"] == "table");
}

TEST_CASE("hts eval of polarised light") {
    const Workplace place;
    place.file("al.json", aluminium);
    const std::string point = "eval --material al.json --wavelength 0.5 --theta-i 60 --theta-r 60 --phi 180 ";
    const auto lit = cells(place.hts(point + "--polarisation s").output);
    const std::size_t s0 = 9;
    REQUIRE(lit[0][s0] == "s0");
    CHECK(lit[0][s0 + 4] == "degree_of_polarisation");
    CHECK(std::stod(lit[1][s0 + 4]) == Approx(1));
    CHECK(std::stod(lit[1][s0 + 5]) == Approx(0).margin(1e-9));
    CHECK(place.hts(point + "--polarisation 1,0,0,2").exit_code == 2);
}

TEST_CASE("hts eval gives the mirror's Mueller matrix and what it makes of polarised light") {
    const Workplace place;
    place.file("glass.json", R"({"model": "he", "rms_roughness_um": 0.02, "correlation_length_um": 2,
                                 "index": {"n": 1.5, "k": 0}})");
    const std::string point =
        "eval --material glass.json --wavelength 0.5 --theta-r 40 --phi 180 --json --theta-i ";
    const auto at = [&](const std::string& theta, const std::string& more) {
        return nlohmann::json::parse(place.hts(point + theta + more).output)[0];
    };
    const auto matrix = at("30", " --mueller");
    CHECK(matrix["specular_m00"].get<double>() == Approx(matrix["specular_reflectance"].get<double>()));
    // Fresnel's formulas: (R_s - R_p)/(R_s + R_p) of glass at 30 degrees
    const double c = std::cos(0.5235987755982988), r = std::sqrt(1 - 0.25 / 2.25);
    const double s = std::pow((c - 1.5 * r) / (c + 1.5 * r), 2),
                 p = std::pow((1.5 * c - r) / (1.5 * c + r), 2);
    CHECK(matrix["specular_m01"].get<double>() / matrix["specular_m00"].get<double>() ==
          Approx((s - p) / (s + p)));
    CHECK(matrix["specular_m10"] == matrix["specular_m01"]);
    for (const std::string state : {"s", "p", "unpolarised"}) {
        const auto lit = at("30", " --polarisation " + state);
        const double factor = state == "s" ? s : state == "p" ? p : (s + p) / 2;
        CHECK(lit["specular_s0"].get<double>() ==
              Approx(lit["specular_reflectance"].get<double>() * factor / ((s + p) / 2)));
        CHECK(lit["specular_degree_of_polarisation"].get<double>() ==
              Approx(state == "unpolarised" ? (s - p) / (s + p) : 1));
    }
    // at Brewster's angle the mirror returns no p light
    const auto dark = at("56.309932474020215", " --polarisation p");
    CHECK(dark["specular_s0"].get<double>() < 1e-15);
    CHECK(dark["specular_reflectance"].get<double>() > 0.01);
}

TEST_CASE("hts eval of random pairs prints its rate") {
    const Workplace place;
    place.file("al.json", aluminium);
    const auto result =
        place.hts("eval --material al.json --wavelengths 0.4:0.7:31 --random-pairs 1000 --detail");
    CHECK(result.exit_code == 0);
    CHECK(result.errors.find("1000 pairs x 31 wavelengths") != std::string::npos);
    CHECK(result.errors.find("evaluations/s") != std::string::npos);
}

TEST_CASE("energy compensation scales the lobe and the specular term alike wherever it is asked for") {
    const Workplace place;
    place.file("al.json", R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 0.7,
                              "index": "Al", "diffuse_albedo": 0.1})");
    const std::string point = " --material al.json --theta-i 60 --theta-r 60 --phi 180 --wavelengths 0.5,2";
    const auto plain = cells(place.hts("eval --mueller" + point).output);
    const auto result = place.hts("eval --mueller --compensate-energy" + point);
    const auto compensated = cells(result.output);
    const auto spectrum = cells(place.hts("spectrum --compensate-energy" + point).output);
    REQUIRE(compensated.size() == 3);
    const auto number = [](const auto& rows, std::size_t row, std::size_t column) {
        return std::strtod(rows[row][column].c_str(), nullptr);
    };
    for (const std::size_t row : {1U, 2U}) {  // columns: 4 angles, wavelength, the terms, m00 ...
        const double factor = number(compensated, row, 5) / number(plain, row, 5);
        CHECK(factor > 1.02);
        CHECK(compensated[row][6] == plain[row][6]);
        CHECK(number(compensated, row, 8) == Approx(factor * number(plain, row, 8)).epsilon(1e-12));
        CHECK(number(compensated, row, 9) == Approx(factor * number(plain, row, 9)).epsilon(1e-12));
        CHECK(number(spectrum, row, 1) == Approx(number(compensated, row, 5)).epsilon(1e-10));
        CHECK(number(spectrum, row, 4) == Approx(number(compensated, row, 8)).epsilon(1e-10));
    }
    place.file("points.csv", header + ",rms_roughness_um\n0.5,60,0,60,180,0.28\n0.5,60,0,60,180,0.1\n");
    const auto rows =
        cells(place.hts("eval --compensate-energy --material al.json --points points.csv").output);
    CHECK(rows[1][6] == compensated[1][5]);
    CHECK(rows[2][6] != rows[1][6]);
    const std::string random = "eval --material al.json --wavelengths 0.5 --random-pairs 500";
    CHECK(number(cells(place.hts(random + " --compensate-energy").output), 1, 3) >
          1.02 * number(cells(place.hts(random).output), 1, 3));
}

TEST_CASE("hts eval and hts spectrum keep the tolerance that is asked for") {
    const Workplace place;
    place.file("al.json", aluminium);
    place.file("pairs.csv",
               "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n30,0,40,170\n70,0,65,150\n5,0,80,20\n");
    const std::string of = "eval --material al.json --points pairs.csv --wavelengths 0.4:0.7:7";
    const auto exact = cells(place.hts(of).output);
    CHECK(exact == cells(place.hts(of + " --tolerance 1e-12").output));
    for (const double tolerance : {1e-6, 1e-3}) {
        const auto coarse = cells(place.hts(of + " --tolerance " + std::to_string(tolerance)).output);
        REQUIRE(coarse.size() == exact.size());
        bool differs = false;
        for (std::size_t row = 1; row < exact.size(); ++row) {
            for (const std::size_t column : {5U, 7U, 8U}) {
                CHECK(std::stod(coarse[row][column]) ==
                      Approx(std::stod(exact[row][column])).epsilon(tolerance).margin(1e-280));
                differs = differs || coarse[row][column] != exact[row][column];
            }
        }
        CHECK(differs);
    }
    const std::string spectrum =
        "spectrum --material al.json --theta-i 30 --theta-r 40 --phi 170 --wavelengths 0.4:0.7:7";
    const auto fine = cells(place.hts(spectrum).output);
    const auto coarse = cells(place.hts(spectrum + " --tolerance 1e-6").output);
    CHECK(std::stod(coarse[1][3]) == Approx(std::stod(fine[1][3])).epsilon(1e-6));
    CHECK(coarse[1][3] == cells(place.hts(of + " --tolerance 1e-6").output)[1][7]);
}
