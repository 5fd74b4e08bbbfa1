#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

TEST_CASE("hts truth needs a study that it knows and a folder") {
    const Workplace place;
    CHECK(place.hts("truth").exit_code == 2);
    CHECK(place.hts("truth fourier").exit_code == 2);
    CHECK(place.hts("truth nothing --output f").exit_code == 2);
    CHECK(place.hts("truth --help").output.find("hts truth rays --quick") != std::string::npos);
    CHECK(place.names().empty());
}

TEST_CASE("hts truth fourier --quick writes what it found, the same on one thread, and is as recorded") {
    const Workplace place;
    const auto result = place.hts("truth fourier --quick --output f");
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.output.find("met     quick: directional-diffuse term before shadowing") !=
          std::string::npos);
    CHECK(place.read("f/fourier-integral.svg").find("</svg>") != std::string::npos);
    const std::string table = place.read("f/fourier-integral.csv");
    CHECK(table.find("# hts truth fourier --quick --output FOLDER\n") != std::string::npos);
    CHECK(cells(table.substr(table.find("phase_variance"))).size() == 81);
    CHECK(place.hts("truth fourier --quick --output g", "OMP_NUM_THREADS=1").exit_code == 0);
    CHECK(place.read("g/fourier-integral.csv") == table);
}

TEST_CASE("hts validate tells findings on the model from regressions of the program") {
    const Workplace place;
    const auto result = place.hts("validate --only figures --output v");
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);  // though a criterion is missed
    CHECK(result.output.find("  missed  Fig. 9: that peak is specular") != std::string::npos);
    CHECK(result.output.find("14 of 15 criteria met: v/report.html") != std::string::npos);
    CHECK(result.errors.empty());
    CHECK(place.read("v/report.html").find("Every result is the one recorded") != std::string::npos);
}

TEST_CASE("hts validate --record puts results into a file, and keeps the others there") {
    const Workplace place;
    CHECK(place.hts("validate --only figures --output v --record r.json").exit_code == 0);
    const auto all = nlohmann::json::parse(place.read("r.json"))["results"];
    CHECK(all.size() > 80);  // those of the program
    place.file("r.json", R"({"results": [{"section": "s", "claim": "c", "verdict": "met", "measured": "1",
                             "tolerance": 0.5}]})");
    CHECK(place.hts("validate --only figures --output v --record r.json").exit_code == 0);
    const auto some = nlohmann::json::parse(place.read("r.json"))["results"];
    REQUIRE(some.size() == 16);
    CHECK(some.back()["section"] == "s");
    CHECK(some.back()["tolerance"] == 0.5);
    place.file("r.json", R"({"results": 3})");
    const auto refused = place.hts("validate --only figures --output v --record r.json");
    CHECK(refused.exit_code == 1);
    CHECK(refused.errors.find("r.json: key \"results\"") != std::string::npos);
    CHECK(place.read("r.json") == R"({"results": 3})");
}

TEST_CASE("hts truth vector is shared out and collected, and says what does not go together") {
    const Workplace place;
    CHECK(place.hts("truth fourier --collect --output f").exit_code == 2);
    CHECK(place.hts("truth vector --quick --shard 1/2 --output f").exit_code == 2);
    CHECK(place.hts("truth vector --shard 3/2 --output f").exit_code == 2);
    CHECK(place.hts("truth vector --shard 1/2 --collect --output f").exit_code == 2);
    CHECK(place.hts("truth vector --realisations 3 --output f").exit_code == 2);
    CHECK(place.names().empty());
    const auto nothing = place.hts("truth vector --collect --output f");
    CHECK(nothing.exit_code == 1);
    CHECK(nothing.errors.find("0 realisations of the surface sigma0 0.05") != std::string::npos);
}
