#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

namespace {

const std::string material = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";

}  // namespace

TEST_CASE("every verb explains itself with an example") {
    const Workplace place;
    for (const std::string verb :
         {"eval", "phi", "spectrum", "polar", "figures", "sample", "plan", "albedo", "furnace", "materials",
          "info", "chart", "stability", "curves", "compare", "fit", "render", "truth"}) {
        INFO(verb);
        const auto help = place.hts(verb + " --help");
        CHECK(help.exit_code == 0);
        CHECK(help.output.find("Example") != std::string::npos);
        CHECK(help.output.find("hts " + verb + " ") != std::string::npos);
    }
    CHECK(place.hts("--help").exit_code == 0);
    CHECK(place.hts("--version").output.starts_with("hts 0."));
}

TEST_CASE("the command starts without the libraries of fits, and without timing the processor's clock") {
    const Workplace place;
    const auto loaded = place.hts("--version", "LD_TRACE_LOADED_OBJECTS=1");
    REQUIRE(loaded.exit_code == 0);
    for (const char* library : {"ceres", "glog", "cholmod", "lapack", "gfortran", "hwy"}) {
        INFO(library);
        CHECK(loaded.output.find(library) == std::string::npos);
    }
}

TEST_CASE("hts phi keeps the logarithm where phi underflows") {
    const Workplace place;
    place.file("gt.csv", "g,t\n50,120\n1e-3,1e5\n1e10,0\n0,1\n");
    const auto rows = cells(place.hts("phi --points gt.csv").output);
    REQUIRE(rows.size() == 5);
    CHECK(rows[0] == std::vector<std::string>{"g", "t", "phi", "log_phi", "method"});
    CHECK(std::stod(rows[1][2]) == Approx(std::exp(std::stod(rows[1][3]))).epsilon(1e-12));
    CHECK(rows[2][2] == "0");
    CHECK(std::stod(rows[2][3]) < -800);
    CHECK(std::stod(rows[3][2]) == Approx(1e-10).epsilon(1e-9));
    CHECK(rows[4][3] == "-inf");
}

TEST_CASE("hts spectrum gives the spectrum and its colour") {
    const Workplace place;
    const std::string command =
        "spectrum --material " + material + " --theta-i 30 --theta-r 40 --phi 180 --wavelengths 0.38:0.78:9 ";
    const auto result = place.hts(command);
    CHECK(result.exit_code == 0);
    const auto rows = cells(result.output);
    REQUIRE(rows.size() == 10);
    CHECK(rows[0][0] == "wavelength_um");
    CHECK(result.errors.find("XYZ") != std::string::npos);
    CHECK(result.errors.find("sRGB") != std::string::npos);
    CHECK(nlohmann::json::accept(place.hts(command + "--json").output));
    CHECK(place.hts(command + "--illuminant E").errors != result.errors);
}

TEST_CASE("hts polar writes the curves, the script and the picture") {
    const Workplace place;
    const auto result = place.hts("polar --material " + material +
                                  " --wavelength 0.5 --theta-i 10,45 --solid-angle 0.003 --output fig.svg");
    CHECK(result.exit_code == 0);
    CHECK(place.names() == std::vector<std::string>{"fig.csv", "fig.gnuplot", "fig.svg"});
    CHECK(place.read("fig.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("hts sample draws directions with density and weight") {
    const Workplace place;
    const std::string command =
        "sample --material " + material + " --wavelength 2 --theta-i 45 --count 4000 --seed 3 ";
    const auto result = place.hts(command);
    CHECK(result.exit_code == 0);
    CHECK(result.errors.find("mean weight") != std::string::npos);
    const auto rows = cells(result.output);
    REQUIRE(rows.size() == 4001);
    CHECK(rows[0] == std::vector<std::string>{"theta_r_deg", "phi_r_deg", "lobe", "pdf", "weight"});
    // weight pdf is what hts eval says: BRDF times cosine, or the specular reflectance
    std::set<std::string> seen;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (!seen.insert(rows[i][2]).second || rows[i][2] == "none") continue;
        const auto answer =
            cells(place
                      .hts("eval --material " + material + " --wavelength 2 --theta-i 45 --theta-r " +
                           rows[i][0] + " --phi " + rows[i][1])
                      .output);
        const std::string column = rows[i][2] == "specular" ? "specular_reflectance" : "brdf";
        const auto at = std::find(answer[0].begin(), answer[0].end(), column) - answer[0].begin();
        const double cosine = column == "brdf" ? std::cos(std::stod(rows[i][0]) * std::acos(-1) / 180) : 1;
        INFO(rows[i][2]);
        CHECK(std::stod(rows[i][3]) * std::stod(rows[i][4]) ==
              Approx(std::stod(answer[1][static_cast<std::size_t>(at)]) * cosine).epsilon(1e-9));
    }
    CHECK(seen.size() == 3);
    CHECK(place.hts(command).output == result.output);
    CHECK(place.hts("sample --material " + material + " --wavelength 2 --theta-i 45 --count 4000 --seed 4")
              .output != result.output);
    CHECK(nlohmann::json::parse(place.hts(command + "--json").output).size() == 4000);
    CHECK(place.hts(command + "--output dirs.csv --plot dirs.svg").exit_code == 0);
    CHECK(place.read("dirs.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("hts sample names what is wrong") {
    const Workplace place;
    const std::string command = "sample --material " + material;
    const auto wrong = [&](const std::string& arguments, const std::string& message) {
        const auto result = place.hts(command + arguments);
        INFO(arguments << ": " << result.errors);
        CHECK(result.exit_code == 2);
        CHECK(result.output.empty());
        CHECK(result.errors.find(message) != std::string::npos);
    };
    wrong(" --wavelength -1 --theta-i 45", "wavelength -1 um");
    wrong(" --wavelength 0.5 --theta-i 95", "polar angle 95 deg");
    wrong(" --wavelength 0.5", "--theta-i");
    wrong(" --wavelength 0.5 --theta-i 45 --count 0", "--count");
    wrong(" --wavelength 0.5 --theta-i 45 --seed -1", "--seed");
    CHECK(place.hts("sample --material missing.json --wavelength 0.5 --theta-i 45").exit_code == 1);
}

TEST_CASE("hts materials lists the collection and describes one") {
    const Workplace place;
    const auto list = place.hts("materials");
    for (const std::string name : {"Al", "Cu", "Au", "Ag", "Cr", "Fe", "Ni", "Ti", "W", "MgF2", "MgO",
                                   "Al2O3", "SiC", "SiO2", "BK7", "PMMA", "polycarbonate", "polystyrene"}) {
        INFO(name);
        CHECK(list.output.find("\n" + name + ",") != std::string::npos);
    }
    const auto one = place.hts("materials Al --wavelengths 0.5,2");
    CHECK(cells(one.output).size() == 3);
    CHECK(one.errors.find("Rak") != std::string::npos);
}

TEST_CASE("hts albedo splits the reflectance by term and finds a diffuse albedo") {
    const Workplace place;
    const auto result = place.hts("albedo --material " + material +
                                  " --wavelengths 0.5,2 --theta-i 0,70 --compensate-energy");
    CHECK(result.exit_code == 0);
    const auto rows = cells(result.output);
    REQUIRE(rows.size() == 5);
    CHECK(rows[0] == std::vector<std::string>{"wavelength_um", "theta_i_deg", "specular",
                                              "directional_diffuse", "uniform_diffuse", "total",
                                              "largest_albedo", "limited_at_deg", "compensated_total"});
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto number = [&](std::size_t column) { return std::stod(rows[i][column]); };
        CHECK(number(5) == Approx(number(2) + number(3) + number(4)).epsilon(1e-15));
        CHECK(number(5) + number(6) <= 1 + 1e-12);
        CHECK(number(8) > number(5));
        CHECK(number(8) < 1);
    }
    const std::string plastic = "albedo --wavelengths 0.46 --theta-i 0 --json --material " HTS_SOURCE_DIR
                                "/cli/data/smooth-plastic.json ";
    const auto solved = nlohmann::json::parse(place.hts(plastic + "--measured 0.195").output);
    CHECK(solved[0]["measured_albedo"] == Approx(0.155).margin(0.0005));  // the paper: 0.15
    CHECK(solved[0]["total"] == Approx(0.19).margin(0.0005));
    const auto too_dark = place.hts(plastic + "--measured 0.01");
    CHECK(too_dark.exit_code == 1);
    CHECK(too_dark.errors.find("measured reflectance 0.01: must be from 0.0399") != std::string::npos);
}

TEST_CASE("hts albedo gives the same on one thread and on several") {
    const Workplace place;
    const std::string command = "albedo --material " + material + " --wavelengths 0.4:0.7:4 --theta-i 0,80";
    CHECK(place.hts(command, "OMP_NUM_THREADS=1").output == place.hts(command, "OMP_NUM_THREADS=3").output);
}

TEST_CASE("hts furnace maps the energy that the model gains and loses") {
    const Workplace place;
    CHECK(place.hts("furnace --output map --quick").exit_code == 0);
    const auto rows = cells(place.read("map/furnace.csv"));
    CHECK(rows[0] == std::vector<std::string>{"sigma0_over_tau", "sigma0_over_lambda", "theta_i_deg",
                                              "specular", "directional_diffuse", "total"});
    double lowest = 1, highest = 1;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        lowest = std::min(lowest, std::stod(rows[i][5]));
        highest = std::max(highest, std::stod(rows[i][5]));
    }
    CHECK(lowest < 0.1);
    CHECK(highest > 1.03);
    CHECK(nlohmann::json::parse(place.read("map/furnace.json")).size() == rows.size() - 1);
    CHECK(place.read("map/furnace.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("hts stability passes the engine and shows where naive methods fail") {
    const Workplace place;
    const auto result = place.hts("stability --json --output reports/stability");
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    std::size_t rivals = 0;
    for (const auto& row : nlohmann::json::parse(result.output)) {
        const bool fails = row["verdict"] != "ok" && row["verdict"] != "model";
        INFO(row["method"]);
        if (row["engine"] == "yes") CHECK_FALSE(fails);
        if (row["engine"] == "no" && fails) ++rivals;
    }
    CHECK(rivals >= 10);
    CHECK(place.read("reports/stability/stability.html").find("</html>") != std::string::npos);
    CHECK(place.read("reports/stability/stability.csv").starts_with("row,problem,method,"));
    const auto table = place.hts("stability");
    CHECK(table.exit_code == 0);
    CHECK(table.output.find("engine: passes every row") != std::string::npos);
}

TEST_CASE("hts chart and hts stability need a folder that can be made") {
    const Workplace place;
    place.file("taken", "a file");
    CHECK(place.hts("chart").exit_code == 2);
    CHECK(place.hts("chart --output charts --seed -1").exit_code == 2);
    for (const std::string verb : {"chart", "stability"}) {
        const auto result = place.hts(verb + " --output taken/charts");
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(result.errors.find("taken/charts: cannot be made") != std::string::npos);
    }
    CHECK(place.names() == std::vector<std::string>{"taken"});
}
