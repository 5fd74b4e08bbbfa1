#include <catch2/catch.hpp>
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

TEST_CASE("hts truth fourier --quick writes what it found, the same on one thread, and passes") {
    const Workplace place;
    const auto result = place.hts("truth fourier --quick --output f");
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.output.find("passed  directional-diffuse term before shadowing") != std::string::npos);
    CHECK(place.read("f/fourier-integral.svg").find("</svg>") != std::string::npos);
    const std::string table = place.read("f/fourier-integral.csv");
    CHECK(table.find("# hts truth fourier --quick --output FOLDER\n") != std::string::npos);
    CHECK(cells(table.substr(table.find("phase_variance"))).size() == 81);
    CHECK(place.hts("truth fourier --quick --output g", "OMP_NUM_THREADS=1").exit_code == 0);
    CHECK(place.read("g/fourier-integral.csv") == table);
}
