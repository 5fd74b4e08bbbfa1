#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

namespace {

const std::string sandpaper = HTS_SOURCE_DIR "/cli/data/sandpaper.json";
const std::string aluminium = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
const std::string warning = "outside the model's validity";

nlohmann::json finding(const nlohmann::json& info, const std::string& criterion) {
    for (const auto& one : info["findings"]) {
        if (one["criterion"] == criterion) return one;
    }
    FAIL("no finding of " << criterion);
    return {};
}

}  // namespace

TEST_CASE("hts info says that the paper's sandpaper is outside the model's validity, and why") {
    const Workplace place;
    const auto text = place.hts("info " + sandpaper + " --wavelengths 0.55");
    CHECK(text.exit_code == 0);
    for (const std::string part :
         {"OUTSIDE the model's validity", "sigma0/tau = 4.4", "scattered more than once", "98.7 %",
          "scale and index are chosen", "rough limit", "unknown"}) {
        INFO(part);
        CHECK(text.output.find(part) != std::string::npos);
    }
    const auto json =
        nlohmann::json::parse(place.hts("info " + sandpaper + " --wavelengths 0.55 --json").output);
    CHECK(json["validity"] == "outside");
    CHECK(json["expected_error_db"].is_null());
    CHECK(json["regimes"] == nlohmann::json{"rough limit"});
    const auto slope = finding(json, "slope");
    CHECK(slope["severity"] == "outside");
    CHECK(slope["measured"].get<double>() == Approx(4.4));
    CHECK(slope["measured"] > slope["outside"]);
    CHECK(slope["reason"] != "");
    CHECK(finding(json, "correlation length")["severity"] == "fine");
}

TEST_CASE("hts info agrees with hts eval on g and the mirror, in text, JSON and CSV") {
    const Workplace place;
    const std::string range = " --wavelengths 0.5,2 --theta 0,30";
    CHECK(place.hts("info " + aluminium + range + " --output info.csv").exit_code == 0);
    const auto rows = cells(place.read("info.csv"));
    REQUIRE(rows.size() == 5);
    place.file("points.csv",
               "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,0,0,0,180\n0.5,30,0,30,180\n"
               "2,0,0,0,180\n2,30,0,30,180\n");
    const auto points =
        cells(place.hts("eval --material " + aluminium + " --points points.csv --detail").output);
    const auto column = [](const auto& table, const std::string& name) {
        return static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin());
    };
    for (std::size_t row = 1; row < rows.size(); ++row) {
        CHECK(rows[row][0] == points[row][0]);
        CHECK(rows[row][1] == points[row][1]);
        CHECK(rows[row][column(rows, "g")] == points[row][column(points, "g")]);
        CHECK(std::stod(rows[row][column(rows, "mirror_share")]) ==
              Approx(std::exp(-std::stod(points[row][column(points, "g")]))));
    }
    const auto json = nlohmann::json::parse(place.hts("info " + aluminium + range + " --json").output);
    CHECK(json["phase_variance"][0].get<double>() == std::stod(rows[4][column(rows, "g")]));
    CHECK(json["phase_variance"][1].get<double>() == std::stod(rows[1][column(rows, "g")]));
    CHECK(json["wavelengths_um"] == nlohmann::json{0.5, 2.0});
    CHECK(json["prepared_bytes"] > 0);
    CHECK(place.hts("info " + aluminium + range + " -o info.json").exit_code == 0);
    CHECK(nlohmann::json::parse(place.read("info.json")) == json);
}

TEST_CASE("hts info of a surface inside the model's validity says so and how far it is from exact") {
    const Workplace place;
    const auto info = place.hts("info " + aluminium + " --wavelengths 0.4:0.7:4 --theta 0,45");
    CHECK(info.output.find("Inside the model's validity") != std::string::npos);
    CHECK(info.output.find("0 to 1.1 dB") != std::string::npos);
    CHECK(info.output.find("caution") == std::string::npos);
    place.file("fine.json", R"({"model": "he", "rms_roughness_um": 0.01, "correlation_length_um": 0.1,
                                "index": {"n": 1.5, "k": 0}})");
    CHECK(place.hts("info fine.json").output.find("perturbation theory would do better") !=
          std::string::npos);
}

TEST_CASE("one line warns of values outside the model's validity, and only of those") {
    const Workplace place;
    const std::string pair = " --theta-i 30 --theta-r 40 --phi 170";
    for (const std::string& command : {"eval --wavelength 0.55" + pair, "spectrum" + pair,
                                       std::string{"polar --wavelength 0.55 --theta-i 30,45"},
                                       std::string{"eval --wavelengths 0.5,0.6 --random-pairs 10"}}) {
        INFO(command);
        const auto bad = place.hts(command + " --material " + sandpaper);
        CHECK(bad.exit_code == 0);
        const auto first = bad.errors.find(warning);
        REQUIRE(first != std::string::npos);
        CHECK(bad.errors.find(warning, first + 1) == std::string::npos);
        CHECK(bad.errors.find("slope") != std::string::npos);
        CHECK(bad.errors.find("hts info") != std::string::npos);
        const auto good = place.hts(command + " --material " + aluminium);
        CHECK(good.exit_code == 0);
        CHECK(good.errors.find(warning) == std::string::npos);
    }
    place.file("points.csv",
               "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,rms_roughness_um\n"
               "0.5,0,0,0,180,0.28\n0.5,0,0,0,180,7.8\n0.5,80,0,80,180,0.28\n");
    const auto some = place.hts("eval --points points.csv --material " + aluminium);
    CHECK(some.errors.find("2 of 3 values are " + warning) != std::string::npos);
}

TEST_CASE("hts info says how far he and he_unified are to be expected from exact scattering") {
    const Workplace place;
    place.file(
        "m.json",
        R"({"model": "he_unified", "rms_roughness_um": 0.14, "correlation_length_um": 1.1, "index": "Al"})");
    const auto text = place.hts("info m.json --wavelengths 0.55 --theta 30,85");
    CHECK(text.exit_code == 0);
    for (const std::string part :
         {"Expected distance from exact scattering [dB]", "1 of 1", "unknown", "0 of 1",
          "A case that is left out is met within a factor of", "of what is outside nothing is known",
          "its mirror is not shadowed", "OUTSIDE the model's validity at 1 of 2 points",
          "nothing like it was solved"}) {
        INFO(part);
        CHECK(text.output.find(part) != std::string::npos);
    }
    CHECK(text.output.find("not measured yet") == std::string::npos);
    CHECK(text.output.find("curvature: k R") == std::string::npos);  // the criteria are those of he
    const auto inside = place.hts("info m.json --wavelengths 0.55 --theta 30");
    CHECK(inside.output.find("Inside the model's validity: at most 0.5 dB from exact scattering") !=
          std::string::npos);
    CHECK(inside.output.find("fine      0.") != std::string::npos);
    const auto json =
        nlohmann::json::parse(place.hts("info m.json --wavelengths 0.55 --theta 30,85 --json").output);
    const auto& near = json["expected_distance_db"]["by_angle"][0];
    CHECK(json["limits_of_model"] == "he_unified");
    CHECK(json["validity"] == "outside");
    CHECK(json["findings"].empty());
    CHECK(json["expected_error_db"].is_null());  // one angle is not studied
    CHECK(near["he_unified"]["tm"].get<double>() < near["he"]["tm"].get<double>());
    CHECK(json["expected_distance_db"]["by_angle"][1]["he"].is_null());
    CHECK(json["expected_distance_db"]["cases"].get<int>() > 100);
    CHECK(place.hts("info m.json --wavelengths 0.55 --theta 30,85 --output t.csv").exit_code == 0);
    const auto rows = cells(place.read("t.csv"));
    CHECK(rows[0].back() == "he_unified_db");
    CHECK(rows[1][rows[1].size() - 7] == "yes");
    CHECK(rows[2][rows[2].size() - 7] == "no");
    CHECK(rows[2].back() == "nan");
}

TEST_CASE("hts info names the correlation of a surface") {
    const Workplace place;
    place.file("m.json", R"({"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 1,
                             "correlation": {"type": "matern", "nu": 1.5}, "index": "Al"})");
    const auto text = place.hts("info m.json --wavelengths 0.55");
    CHECK(text.output.find("sigma0 0.1 um, correlation matern, nu 1.5, its length 1 um") !=
          std::string::npos);
    const auto json = nlohmann::json::parse(place.hts("info m.json --wavelengths 0.55 --json").output);
    CHECK(json["correlation"] == "matern, nu 1.5");
}

TEST_CASE("hts info expects of K-correlated metals what exact scattering by such ones says") {
    const Workplace place;
    const auto info = [&](const std::string& correlation, const std::string& index = "\"Al\"") {
        place.file("m.json", R"({"model": "he_unified", "rms_roughness_um": 0.07, "index": )" + index +
                                 R"(, "correlation": )" + correlation + "}");
        return nlohmann::json::parse(
            place.hts("info m.json --wavelengths 0.5 --theta 30,85 --json").output)["expected_distance_db"];
    };
    const auto shape = [](double c, double length) {
        return R"({"type": "k_correlation", "B_um": )" + std::to_string(2 * 3.14159265 * length) +
               R"(, "C": )" + std::to_string(c) + R"(, "psd": "2d"})";
    };
    const auto exponential = info(shape(3, 0.35)), smooth = info(shape(5, 0.8));
    CHECK(exponential["cases"] == 24);
    CHECK(exponential["substance"] == "perfect conductors, K-correlated");
    CHECK(exponential["by_angle"][0]["studied"] == 1);
    CHECK(exponential["by_angle"][1]["studied"] == 0);  // 85 deg
    const auto tm = [](const auto& of) {
        return of["by_angle"][0]["he_unified"]["tm"].template get<double>();
    };
    CHECK(tm(exponential) > 0.5);
    CHECK(tm(smooth) < 0.4);
    CHECK(info(shape(7, 0.8))["by_angle"][0]["studied"] == 0);  // nu 5/2
    CHECK(info(shape(5, 0.8), R"({"n": 1.5, "k": 0})")["by_angle"][0]["studied"] == 0);
}

TEST_CASE("values of he_unified are judged by their distance from exact scattering, whoever is asked") {
    const Workplace place;
    const std::string unified = R"({"model": "he_unified", "rms_roughness_um": )";
    place.file("near.json", unified + R"(0.14, "correlation_length_um": 1.1, "index": "Al"})");
    place.file("far.json", unified + R"(0.055, "correlation_length_um": 0.1925, "index": "Al"})");
    place.file("smooth.json", unified + R"(0.002, "correlation_length_um": 0.1925, "index": "Al"})");
    const auto said = [&](const std::string& command, const std::string& file) {
        const auto answer = place.hts(command + " --material " + file);
        CHECK(answer.exit_code == 0);
        return answer.errors;
    };
    const std::string pair = " --theta-i 30 --theta-r 40 --phi 170";
    for (const std::string& command :
         {"eval --wavelength 0.55" + pair, "spectrum --wavelengths 0.5:0.6:3" + pair,
          std::string{"polar --wavelength 0.55 --theta-i 15,30"}}) {
        INFO(command);
        CHECK(said(command, "near.json").find(warning) == std::string::npos);
        CHECK(said(command, "smooth.json").find("nothing like it was solved exactly") != std::string::npos);
    }
    // at the horizon nothing was solved; the assumptions of he say "shadowing" there
    const std::string grazing = "eval --wavelength 0.55 --theta-i 80 --theta-r 40 --phi 170";
    const std::string unknown = said(grazing, "near.json");
    CHECK(unknown.find(warning + " (nothing like it was solved exactly): see hts info") != std::string::npos);
    CHECK(unknown.find("shadowing") == std::string::npos);
    // the same verdict in hts info and in eval, angle by angle
    std::string points = "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n";
    for (int theta = 0; theta <= 85; theta += 5) {
        points.append("0.55,").append(std::to_string(theta)).append(",0,20,180\n");
        place.file("one.csv", points.substr(0, points.find('\n') + 1) + points.substr(points.rfind("0.55,")));
        for (const std::string file : {"near.json", "far.json", "smooth.json"}) {
            INFO(file << ' ' << theta);
            const auto info = nlohmann::json::parse(
                place.hts("info " + file + " --wavelengths 0.55 --theta " + std::to_string(theta) + " --json")
                    .output);
            const auto warned = said("eval --points one.csv", file).find(warning) != std::string::npos;
            CHECK(warned == (info["validity"] == "outside"));
        }
    }
}
