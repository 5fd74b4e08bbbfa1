// Films, band means and the names of other fields, as a user meets them.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

const std::string surface = R"("rms_roughness_um": 0.1, "correlation_length_um": 1, "index": "Al")";
const std::string oxide = R"([{"index": "Al2O3", "thickness_um": 0.05}])";

std::string material(const std::string& model, const std::string& films) {
    return R"({"model": ")" + model + R"(", )" + surface + R"(, "films": )" + films + "}";
}
double number(const std::string& text) {
    return std::stod(text);
}
/// The number of a named column in a row.
double value(const std::vector<std::vector<std::string>>& table, std::size_t row, const std::string& column) {
    for (std::size_t i = 0; i < table[0].size(); ++i)
        if (table[0][i] == column) return number(table[row + 1][i]);
    FAIL("no column " << column);
    return 0;
}

}  // namespace

TEST_CASE("films of no thickness give the bytes of the bare surface, and oxide others") {
    const Workplace place;
    for (const std::string model : {"he", "he_unified"}) {
        place.file("bare.json", R"({"model": ")" + model + R"(", )" + surface + "}");
        place.file("none.json", material(model, "[]"));
        place.file("thin.json", material(model, R"([{"index": "Au", "thickness_um": 0}])"));
        place.file("oxide.json", material(model, oxide));
        for (const std::string asked :
             {"eval --wavelengths 0.4:0.7:5 --theta-i 30 --theta-r 40 --phi 170 --mueller --tolerance 1e-6 ",
              "eval --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 170 --mueller --detail ",
              "sample --wavelength 0.5 --theta-i 45 --count 20 --seed 1 "}) {
            INFO(model << ": " << asked);
            const auto bare = place.hts(asked + "--material bare.json").output;
            CHECK(!bare.empty());
            CHECK(place.hts(asked + "--material none.json").output == bare);
            CHECK(place.hts(asked + "--material thin.json").output == bare);
            CHECK(place.hts(asked + "--material oxide.json").output != bare);
        }
    }
    const auto info = place.hts("info oxide.json --wavelengths 0.5");
    CHECK_THAT(info.output, Catch::Contains("Al under Al2O3 0.05 um"));
    const auto json = nlohmann::json::parse(place.hts("info oxide.json --wavelengths 0.5 --json").output);
    CHECK(json.at("index") == "Al under Al2O3 0.05 um");
}

TEST_CASE("n and k of a points file are those of the substrate under films") {
    const Workplace place;
    place.file("al.json", material("he", oxide));
    place.file("other.json", R"({"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 1,
        "index": {"n": 2, "k": 3}, "films": )" +
                                 oxide + "}");
    const std::string row = "0.5,30,0,40,170";
    place.file("own.csv", "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,n,k\n" + row + ",2,3\n");
    place.file("plain.csv", "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n" + row + "\n");
    const auto own = cells(place.hts("eval --material al.json --points own.csv").output);
    const auto plain = cells(place.hts("eval --material other.json --points plain.csv").output);
    CHECK(value(own, 0, "brdf") == value(plain, 0, "brdf"));
}

TEST_CASE("hts eval --columns gives the BRDF the names of other fields") {
    const Workplace place;
    place.file("m.json", R"({"model": "he", "diffuse_albedo": 0.1, )" + surface + "}");
    const auto table = cells(place
                                 .hts("eval --material m.json --wavelength 0.5 --theta-i 30 --theta-r 60 "
                                      "--phi 150 --columns ars,sigma0 --columns brf")
                                 .output);
    const double f = value(table, 0, "brdf"), c_i = std::sqrt(3) / 2, c_r = 0.5;
    CHECK(value(table, 0, "brf") == Approx(std::numbers::pi * f).epsilon(1e-14));
    const auto two = cells(place
                               .hts("eval --material m.json --wavelength 0.5 --theta-i 30 --theta-r 60 "
                                    "--phi 150 --columns ars,sigma0")
                               .output);
    CHECK(value(two, 0, "ars") == Approx(f * c_r).epsilon(1e-14));
    CHECK(value(two, 0, "sigma0") == Approx(4 * std::numbers::pi * f * c_i * c_r).epsilon(1e-14));
    const std::string asked = "eval --material m.json --wavelength 0.5 --theta-i 30 --theta-r 60 --phi 150 ";
    check_complaint(place.hts(asked + "--columns brd"), 2, {"--columns", "\"brd\"", "brf, sigma0, ars"});
    check_complaint(place.hts(asked + "--columns brf,brf"), 2, {"--columns", "once"});
}

TEST_CASE("hts albedo: total integrated scatter and the hemisphere") {
    const Workplace place;
    place.file("smooth.json",
               R"({"model": "he", "rms_roughness_um": 0.003, "correlation_length_um": 2, "index": "Al"})");
    const auto table =
        cells(place
                  .hts("albedo --material smooth.json --wavelengths 0.5,0.6 --theta-i 0,45 --emissivity "
                       "--columns tis,hemispherical,hemispherical_emissivity")
                  .output);
    // smooth and gentle: 1 - exp(-g) of the mirror direction
    const double g = std::pow(4 * std::numbers::pi * 0.003 / 0.5, 2);
    CHECK(value(table, 0, "tis") == Approx(1 - std::exp(-g)).epsilon(2e-3));
    CHECK(value(table, 0, "tis") ==
          Approx(1 - value(table, 0, "specular") / value(table, 0, "total")).epsilon(1e-9));
    CHECK(value(table, 0, "hemispherical") == value(table, 1, "hemispherical"));
    CHECK(value(table, 0, "hemispherical") + value(table, 0, "hemispherical_emissivity") == Approx(1));
    CHECK(value(table, 0, "hemispherical_emissivity") > value(table, 0, "emissivity"));  // metals glow aslant
}

TEST_CASE("hts albedo: means over a band") {
    const Workplace place;
    place.file("m.json", R"({"model": "lambert", "diffuse_albedo": {"table": [[2, 0.1], [12, 0.6]]}})");
    place.file("r.csv", "response,wavelength_um\n0,3\n2,4\n0,6\n");
    const std::string asked = "albedo --material m.json --wavelengths 2:12:11 --theta-i 0,60 --emissivity ";
    const auto by_response = cells(place.hts(asked + "--response r.csv").output);
    CHECK(by_response.size() == 3);
    CHECK(value(by_response, 0, "total") == Approx(0.1 + 0.05 * (13. / 3 - 2)).epsilon(1e-6));
    CHECK(value(by_response, 0, "emissivity") == Approx(1 - value(by_response, 0, "total")));
    CHECK(value(by_response, 0, "covered") == Approx(1));
    const auto cold = cells(place.hts(asked + "--temperature 300").output);
    const auto hot = cells(place.hts(asked + "--temperature 2000").output);
    CHECK(value(cold, 1, "emissivity") < value(hot, 1, "emissivity"));
    CHECK(value(cold, 0, "covered") > 0.3);
    CHECK(value(cold, 0, "covered") < 0.5);
    check_complaint(place.hts(asked + "--temperature 0"), 2, {"--temperature"});
    check_complaint(place.hts("albedo --material m.json --wavelengths 5 --theta-i 0 --temperature 300"), 2,
                    {"--temperature", "two wavelengths"});
    place.file("negative.csv", "wavelength_um,response\n3,1\n4,-1\n");
    check_complaint(place.hts(asked + "--response negative.csv"), 1, {"negative.csv:3", "response", ">= 0"});
    place.file("beyond.csv", "wavelength_um,response\n30,1\n40,1\n");
    check_complaint(place.hts(asked + "--response beyond.csv"), 1, {"nothing of it lies at the wavelengths"});
}

TEST_CASE("hts albedo refuses the emissivity of what lets light through") {
    const Workplace place;
    place.file("glass.json",
               R"({"model": "walter", "distribution": "ggx", "alpha": 0.2, "index": {"n": 1.5, "k": 0}})");
    const std::string asked = "albedo --material glass.json --wavelengths 0.5 --theta-i 0 ";
    CHECK(place.hts(asked).exit_code == 0);
    check_complaint(place.hts(asked + "--emissivity"), 1,
                    {"glass.json", "emissivity", "lets no light through", "0.5 um"});
}

TEST_CASE("hts polar --log-beta: both sides of the mirror direction over the difference of sines") {
    const Workplace place;
    place.file("m.json", R"({"model": "he", )" + surface + "}");
    const auto table = cells(
        place.hts("polar --material m.json --wavelength 0.5 --theta-i 30,90 --log-beta --output -").output);
    std::size_t beyond = 0, within = 0;
    for (std::size_t i = 1; i < table.size(); ++i) {
        const bool is_beyond = table[i][1] == "beyond";
        (is_beyond ? beyond : within) += 1;
        const double beta = number(table[i][2]), difference = number(table[i][3]);
        const double mirror = std::sin(number(table[i][0]) * std::numbers::pi / 180);
        CHECK(beta == Approx(mirror + (is_beyond ? difference : -difference)).margin(1e-12));
        CHECK(std::abs(beta) <= 1);
    }
    CHECK(beyond > 100);
    CHECK(within > 200);
    // a row is what eval says there
    const auto& row = table[150];
    std::ostringstream angle;
    angle.precision(17);
    angle << std::asin(number(row[2])) * 180 / std::numbers::pi;
    const auto eval = cells(
        place.hts("eval --material m.json --wavelength 0.5 --theta-i 30 --phi 180 --theta-r " + angle.str())
            .output);
    CHECK(number(row[6]) == Approx(value(eval, 0, "brdf")).epsilon(1e-9));
    for (const std::string of : {"30", "0,89"}) {
        const auto drawn = place.hts("polar --material m.json --wavelength 0.5 --theta-i " + of +
                                     " --log-beta --output p.svg");
        INFO(drawn.errors);
        CHECK(drawn.exit_code == 0);
        CHECK(place.read("p.svg").find("</svg>") != std::string::npos);
    }
    check_complaint(
        place.hts("polar --material m.json --wavelength 0.5 --theta-i 30,90 --log-beta --output q.svg"), 1,
        {"theta_i 90 deg", "nothing to draw"});
    check_complaint(place.hts("polar --material m.json --wavelength 0.5 --theta-i 30 --log-beta --log"), 2,
                    {"--log-beta", "--log"});
}

TEST_CASE("fits hold films") {
    const Workplace place;
    const std::string fit = "fit mwir-aluminium-sandblasted --model he --index Al --most-points 40 --json ";
    const auto bare = nlohmann::json::parse(place.hts(fit).output);
    const auto coated =
        place.hts(fit + R"(--films '[{"index": {"n": 1.6, "k": 0.4}, "thickness_um": 1}]' --output m.json)");
    INFO(coated.errors);
    CHECK(coated.exit_code == 0);
    CHECK(nlohmann::json::parse(place.read("m.json")).at("films")[0].at("thickness_um") == 1);
    CHECK(nlohmann::json::parse(coated.output) != bare);
    check_complaint(place.hts(fit + R"(--films '[{"index": "Al2O", "thickness_um": 1}]')"), 2,
                    {"films[1].index"});
    check_complaint(place.hts("fit curet-sandpaper --model kurt --films '[]'"), 2, {"kurt", "index"});
}
