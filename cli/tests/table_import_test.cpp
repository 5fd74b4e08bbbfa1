// hts table export and import of the formats in text, and a measured file as a material of the other verbs.

#include <catch2/catch.hpp>
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
    CHECK(place.hts("table import none.csv").errors.find("must be a file that exists") != std::string::npos);
    CHECK(place.hts("table import scan.csv --format ply").exit_code == 2);
    place.file("broken.bsdf", "Source Measured\nSymmetry Round\n");
    CHECK(place.hts("table import broken.bsdf").errors.find("broken.bsdf:2: Symmetry") != std::string::npos);
    CHECK(place.hts("eval --material scan.json --wavelength 0.5 --theta-i 10 --theta-r 10 --phi 180")
              .errors.find("0.633 um") != std::string::npos);
}
