// hts plan and hts eval --plan, as a user calls them.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Result;
using hts::cli::testing::Workplace;

namespace {

const std::string data = HTS_SOURCE_DIR "/cli/data/";
const std::string quick = " --pairs 400 ";
const std::string point = " --theta-i 30 --theta-r 40 --phi 170 ";

/// Plans an example scene into plan.json; --json spares the reader, not the work.
nlohmann::json planned(const Workplace& place, const std::string& scene, const std::string& options = "") {
    const Result result = place.hts("plan " + data + scene + quick + "--output plan.json " + options);
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(place.read("plan.json"));
}

void check_refusal(const Result& result, int exit_code, const std::vector<std::string>& parts) {
    INFO(result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    for (const std::string& part : parts) CHECK(result.errors.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("hts plan tells choice, error, cost, memory and what was rejected, for each surface of Fig. 14") {
    const Workplace place;
    const Result result = place.hts("plan " + data + "figure-14.json" + quick);
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    for (const char* part :
         {"aluminium cylinder: full Phi at 0.001",
          "copper sphere: ", "plastic cube: no lobe, specular term, 1 wavelength",
          "plastic table: ", "error ", "diffuse ", "mirror ", "memory ", "rejected ", "all together "}) {
        INFO(part);
        CHECK(result.output.find(part) != std::string::npos);
    }
}

TEST_CASE("hts plan --json has the plan and every cost, whose parts add up") {
    const Workplace place;
    const Result result = place.hts("plan " + data + "figure-14.json --json" + quick);
    const auto report = nlohmann::json::parse(result.output);
    REQUIRE(report["costs"].size() == 4);
    for (const auto& cost : report["costs"]) {
        for (const char* which : {"chosen", "full_model"}) {
            const auto& part = cost[which];
            CHECK(part["diffuse_ns"].get<double>() > 0);
            CHECK(part["phi_ns"].get<double>() + part["directions_ns"].get<double>() +
                      part["rest_ns"].get<double>() + part["interpolation_ns"].get<double>() ==
                  Approx(part["diffuse_ns"].get<double>()));
        }
        CHECK(cost["bytes"] > 0);
    }
    CHECK(report["plan"]["materials"].size() == 4);
}

TEST_CASE("a plan of 1e-6 takes finer forms than one of 1e-2, and both pass the check with another seed") {
    for (const auto& [tolerance, finest] : {std::pair{"1e-2", 1e-3}, std::pair{"1e-6", 1e-6}}) {
        const Workplace place;
        const auto plan = planned(place, "figure-14-spectral.json", std::string{"--tolerance "} + tolerance);
        CHECK(plan["tolerance"] == std::stod(tolerance));
        CHECK(plan["materials"][0]["choice"]["lobe"] == "full");
        CHECK(plan["materials"][0]["choice"]["lobe_tolerance"] == finest);
        CHECK(plan["materials"][2]["choice"]["lobe"] == "none");
        for (const std::string seed : {"2", "3"}) {
            const Result check = place.hts("plan --check plan.json --seed " + seed);
            INFO(check.output);
            CHECK(check.exit_code == 0);
            const auto rows = cells(check.output);
            REQUIRE(rows.size() == 5);
            for (std::size_t i = 1; i < rows.size(); ++i) {
                CHECK(rows[i][5] == "met");
                CHECK(std::stod(rows[i][2]) <= std::stod(tolerance));
            }
        }
    }
}

TEST_CASE("the same scene and seed give the same plan file") {
    const Workplace place;
    const auto first = planned(place, "figure-14.json");
    CHECK(planned(place, "figure-14.json") == first);
    CHECK(planned(place, "figure-14.json", "--seed 9") != first);
}

TEST_CASE("hts plan --check fails a plan that is not good enough") {
    const Workplace place;
    auto plan = planned(place, "figure-14-spectral.json");
    plan["materials"][1]["choice"]["lobe"] = "rough_limit";
    place.file("plan.json", plan.dump());
    const Result check = place.hts("plan --check plan.json");
    CHECK(check.exit_code == 1);
    CHECK(check.errors.find("plan.json: copper sphere: error ") != std::string::npos);
    CHECK(check.errors.find("must be <= 0.01") != std::string::npos);
    CHECK(cells(check.output)[2][5] == "missed");
    CHECK(nlohmann::json::accept(place.hts("plan --check plan.json --json").output));
}

TEST_CASE("hts eval --plan gives what hts eval gives, within the tolerance") {
    const Workplace place;
    static_cast<void>(planned(place, "figure-14-spectral.json"));
    const auto rows = cells(place.hts("eval --plan plan.json --material 'copper sphere'" + point).output);
    REQUIRE(rows.size() == 32);
    CHECK(rows[0][4] == "wavelength_um");
    const auto exact = cells(
        place.hts("eval --material " + data + "figure-14/copper-sphere.json --wavelengths 0.4:0.7:31" + point)
            .output);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        CHECK(rows[i][4] == exact[i][4]);
        CHECK(std::stod(rows[i][5]) == Approx(std::stod(exact[i][7])).epsilon(1e-2));
        CHECK(std::stod(rows[i][6]) == Approx(std::stod(exact[i][8])).margin(1e-2));
    }
}

TEST_CASE("hts eval --plan gives colours for an rgb plan") {
    const Workplace place;
    static_cast<void>(planned(place, "figure-14.json"));
    place.file("p.csv", "id,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\na,30,0,40,170\nb,0,0,0,0\n");
    const auto rows =
        cells(place.hts("eval --plan plan.json --material 'plastic cube' --points p.csv").output);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0][5] == "red");
    CHECK(rows[2][0] == "b");
    const double mirror = std::pow(0.54 / 2.54, 2);  // grey: equal components, a and |F|^2 of n = 1.54
    for (const std::size_t channel : {5U, 6U, 7U})
        CHECK(std::stod(rows[2][channel]) == Approx(0.28).epsilon(1e-6));
    for (const std::size_t channel : {8U, 9U, 10U})
        CHECK(std::stod(rows[2][channel]) == Approx(mirror).epsilon(1e-6));
}

TEST_CASE("a polarised scene is planned and evaluated with Mueller matrices") {
    const Workplace place;
    place.file("scene.json", R"({"materials": [")" + data + R"(figure-14/copper-sphere.json"],
        "wavelengths_um": [0.5, 0.6], "output": "spectral", "polarised": true, "largest_theta_i_deg": 60,
        "largest_theta_r_deg": 60, "tolerance": {"relative_brdf_error": 1e-2}})");
    REQUIRE(place.hts("plan scene.json --output plan.json" + quick).exit_code == 0);
    const auto rows = cells(place.hts("eval --plan plan.json --mueller" + point).output);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].back() == "specular_m33");
    CHECK(std::stod(rows[1][6]) == Approx(std::stod(rows[1][23])).margin(1e-300));
    CHECK(rows[1][5] == rows[1][7]);
    const auto exact = cells(place
                                 .hts("eval --material " + data +
                                      "figure-14/copper-sphere.json --wavelengths 0.5,0.6 --mueller" + point)
                                 .output);
    const double scale = std::stod(rows[1][7]);
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(std::abs(std::stod(rows[1][7 + i]) - std::stod(exact[1][9 + i])) < 1e-2 * scale);
}

TEST_CASE("a scene of several models is planned, checked and evaluated") {
    const Workplace place;
    place.file("scene.json", R"({"materials": [")" + data + R"(rough-gold.json", ")" + data +
                                 R"(purple-satin.json", "sandpaper.json"],
        "wavelengths_um": "0.46:0.62:9", "output": "spectral", "largest_theta_i_deg": 60,
        "largest_theta_r_deg": 60, "tolerance": {"relative_brdf_error": 1e-2}})");
    const std::string sandpaper = place.file("sandpaper.json", R"({"model": "he", "rms_roughness_um": 44,
        "correlation_length_um": 10, "index": "Al2O3"})");
    const Result plan = place.hts("plan scene.json --output plan.json" + quick);
    INFO(plan.errors);
    REQUIRE(plan.exit_code == 0);
    for (const char* part : {"all of walter", "all of kurt", "values ", "Fresnel and the rest"})
        CHECK(plan.output.find(part) != std::string::npos);
    CHECK(place.hts("plan --check plan.json").exit_code == 0);

    const auto planned = nlohmann::json::parse(place.read("plan.json"));
    const std::vector<std::string> files{data + "rough-gold.json", data + "purple-satin.json", sandpaper};
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Result answer = place.hts("eval --plan plan.json --material '" +
                                        planned["materials"][i]["name"].get<std::string>() + "'" + point);
        INFO(answer.errors);
        const auto rows = cells(answer.output);
        REQUIRE(rows.size() == 10);
        const auto exact =
            cells(place.hts("eval --material " + files[i] + " --wavelengths 0.46:0.62:9" + point).output);
        REQUIRE(exact.size() == 10);
        for (std::size_t j = 1; j < rows.size(); ++j)
            CHECK(std::stod(rows[j][5]) == Approx(std::stod(exact[j][7])).epsilon(1e-2));
        const bool warned = answer.errors.find("outside the model's validity") != std::string::npos;
        CHECK(warned == (i == 2));
        CHECK(std::count(answer.errors.begin(), answer.errors.end(), '\n') == (warned ? 1 : 0));
    }
}

TEST_CASE("scenes and plans that do not fit are refused, and leave nothing behind") {
    const Workplace place;
    const auto plan = planned(place, "figure-14-spectral.json");
    auto other = plan;
    other["library_version"] = "0.0.1";
    place.file("old.json", other.dump());
    other = plan;
    other["scene_fingerprint"] = "0123456789abcdef";
    place.file("changed.json", other.dump());
    const std::string scene =
        R"({"materials": [")" + data + R"(figure-14/copper-sphere.json"], "wavelengths_um": [0.5],
        "output": "spectral", "largest_theta_i_deg": 60, "largest_theta_r_deg": 60,)";
    place.file("small.json",
               scene + R"("tolerance": {"relative_brdf_error": 1e-2}, "memory_budget_bytes": 1000})");
    place.file("empty.json", scene + R"("tolerance": {}})");
    const std::string spectral = data + "figure-14-spectral.json";
    check_refusal(place.hts("plan --check old.json"), 1,
                  {"old.json", "library_version", "0.0.1", "another version"});
    check_refusal(place.hts("eval --plan changed.json --material 'copper sphere'" + point), 1,
                  {"changed.json", "scene_fingerprint", "0123456789abcdef", "another scene"});
    check_refusal(place.hts("plan small.json --output new.json" + quick), 1,
                  {"small.json", "memory_budget_bytes", "1000", "must be >= "});
    check_refusal(place.hts("plan empty.json"), 1,
                  {"empty.json", "tolerance", "relative_brdf_error, delta_e_2000 or true_db"});
    check_refusal(place.hts("plan"), 2, {"scene file or --check"});
    check_refusal(place.hts("plan " + spectral + " --check plan.json"), 2, {"one of them"});
    check_refusal(place.hts("plan --check plan.json --tolerance 1"), 2, {"--tolerance"});
    check_refusal(place.hts("plan " + spectral + " --tolerance 0"), 2,
                  {"--tolerance", "0", "from 1e-12 to 1"});
    check_refusal(place.hts("plan " + spectral + " --seed -1"), 2, {"--seed"});
    check_refusal(place.hts("plan " + spectral + " --pairs 0"), 2, {"--pairs: \"0\"", "from 1 to 10000000"});
    check_refusal(place.hts("eval --plan plan.json" + point), 2, {"--material missing", "copper sphere"});
    check_refusal(place.hts("eval --plan plan.json --material gold" + point), 2, {"gold", "plastic table"});
    const std::string copper = "eval --plan plan.json --material 'copper sphere'";
    check_refusal(place.hts(copper), 2, {"points missing"});
    check_refusal(place.hts(copper + " --mueller" + point), 2, {"--mueller", "polarised"});
    check_refusal(place.hts(copper + " --wavelength 0.5" + point), 2, {"--plan", "--wavelength"});
    check_refusal(place.hts(copper + " --theta-i 30 --theta-r 85 --phi 0"), 1,
                  {"view", "85 deg", "<= 80 deg"});
    CHECK(place.names() ==
          std::vector<std::string>{"changed.json", "empty.json", "old.json", "plan.json", "small.json"});
}
