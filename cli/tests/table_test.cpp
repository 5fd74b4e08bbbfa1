// hts table: build, check, info, lookup, merge; the same bytes however a table is built.

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

using namespace hts::cli::testing;
namespace fs = std::filesystem;

constexpr auto material =
    R"({"name": "rough aluminium", "model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
        "index": "Al"})";
constexpr auto build = "table build --material al.json --wavelengths 0.5,0.6 --tolerance 0.1 --output ";

/// Starts a build in the folder and kills it with SIGKILL once its slices are being written.
void start_and_kill(const fs::path& folder) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (::chdir(folder.c_str()) != 0) ::_exit(3);
        const int null = ::open("/dev/null", O_WRONLY);
        ::dup2(null, STDERR_FILENO);
        ::execl(HTS_COMMAND, "hts", "table", "build", "--material", "al.json", "--wavelengths", "0.5,0.6",
                "--tolerance", "0.1", "--output", "killed.htst", nullptr);
        ::_exit(3);
    }
    const auto slices = folder / "killed.htst.slices";
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    while (!fs::exists(slices) && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::microseconds{100});
    }
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));  // it was at work until then
    CHECK(fs::exists(slices));
    CHECK_FALSE(fs::exists(folder / "killed.htst"));
}

}  // namespace

TEST_CASE("table: the same bytes for any number of threads and shards, and after kill -9") {
    const Workplace place;
    place.file("al.json", material);
    REQUIRE(place.hts(std::string{build} + "m.htst", "OMP_NUM_THREADS=1").exit_code == 0);
    const std::string bytes = place.read("m.htst");
    REQUIRE(place.hts(std::string{build} + "two.htst", "OMP_NUM_THREADS=2").exit_code == 0);
    CHECK(place.read("two.htst") == bytes);

    for (const char* part : {"1", "2", "3"}) {
        REQUIRE(place.hts(std::string{build} + "part." + part + " --shard " + part + "/3").exit_code == 0);
    }
    REQUIRE(place.hts("table merge part.3 part.1 part.2 --output merged.htst").exit_code == 0);
    CHECK(place.read("merged.htst") == bytes);
    const Result lacking = place.hts("table merge part.3 part.1 --output lacking.htst");
    CHECK(lacking.exit_code == 1);
    CHECK_THAT(lacking.errors, Catch::Contains("part 2/3 is missing"));

    start_and_kill(place.folder());
    REQUIRE(place.hts(std::string{build} + "killed.htst").exit_code == 0);
    CHECK(place.read("killed.htst") == bytes);
    CHECK(place.names() == std::vector<std::string>{"al.json", "killed.htst", "m.htst", "merged.htst",
                                                    "part.1", "part.2", "part.3", "two.htst"});
}

TEST_CASE("table: check, info and lookup of what was built") {
    const Workplace place;
    place.file("al.json", material);
    REQUIRE(place.hts(std::string{build} + "m.htst").exit_code == 0);
    const Result check = place.hts("table check m.htst --samples 5000 --seed 99");
    CHECK(check.exit_code == 0);
    const auto checked = cells(check.output);
    REQUIRE(checked.size() == 2);
    CHECK(std::stod(checked[1][6]) <= 0.1);
    CHECK(std::stod(checked[1][6]) > 0.01);
    CHECK_THAT(place.hts("table info m.htst").output, Catch::Contains("tolerance             0.1"));
    CHECK_THAT(place.hts("table info m.htst --json").output, Catch::Contains("\"rms_roughness_um\": 0.28"));

    place.file(
        "points.csv",
        "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,30,0,40,180\n0.6,80,10,70,200\n");
    const auto found = cells(place.hts("table lookup m.htst --points points.csv").output);
    const auto exact = cells(place.hts("eval --material al.json --points points.csv").output);
    REQUIRE(found.size() == 3);
    for (std::size_t row = 1; row < found.size(); ++row) {
        CHECK(std::stod(found[row][7]) == Approx(std::stod(exact[row][7])).epsilon(0.1));
        CHECK(std::stod(found[row][9]) > 0.3);  // the metal's albedo
    }
    place.file(
        "nm.csv",
        "wavelength_nm;theta_i_deg;phi_i_deg;theta_r_deg;phi_r_deg\n500;30;0;40;180\n600;80;10;70;200\n");
    const auto in_nm = cells(place.hts("table lookup m.htst --points nm.csv").output);
    REQUIRE(in_nm.size() == 3);
    for (std::size_t row = 1; row < found.size(); ++row) CHECK(in_nm[row][7] == found[row][7]);
    const auto refusal = [&](const std::string& row) {
        place.file("bad.csv", "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n" + row + "\n");
        const Result result = place.hts("table lookup m.htst --points bad.csv");
        CHECK(result.exit_code == 1);
        return result.errors;
    };
    CHECK_THAT(refusal("0.61,30,0,40,180"),
               Catch::Contains(
                   "bad.csv:2: wavelength 0.61 um: must be within those of the table, from 0.5 to 0.6 um"));
    CHECK_THAT(refusal("0.5,89,0,40,180"), Catch::Contains("must be at most 88 deg"));
}

TEST_CASE("a table takes the optical constants of a file along, and check holds it against those") {
    const Workplace place;
    const auto constants = [](double n) {
        return "wavelength_um,n,k\n0.4," + std::to_string(n) + ",6\n0.7," + std::to_string(n + 0.7) + ",7\n";
    };
    place.file("nk.csv", constants(0.8));
    place.file("al.json", R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
                              "index": {"file": "nk.csv"}})");
    REQUIRE(place.hts(std::string{build} + "m.htst").exit_code == 0);
    const std::string check = "table check m.htst --samples 3000", before = place.hts(check).output;
    CHECK(before.find("m.htst") != std::string::npos);
    place.file("nk.csv", constants(3));
    CHECK(place.hts(check).exit_code == 0);
    CHECK(place.hts(check).output == before);
    std::filesystem::remove(place.folder() / "nk.csv");
    CHECK(place.hts(check).output == before);
}

TEST_CASE("table lookup interpolates between wavelengths, and check measures that") {
    const Workplace place;
    place.file("al.json", material);
    REQUIRE(
        place.hts("table build --material al.json --wavelengths 0.5:0.6:3 --tolerance 0.05 --output m.htst")
            .exit_code == 0);
    place.file(
        "between.csv",
        "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5244,30,0,40,180\n0.53,60,10,50,190\n");
    const Result found = place.hts("table lookup m.htst --points between.csv");
    INFO(found.errors);
    REQUIRE(found.exit_code == 0);
    CHECK_THAT(found.errors,
               Catch::Contains("2 values between its wavelengths: hts table check measures their error"));
    const Result checked = place.hts("table check m.htst --samples 5000");
    INFO(checked.errors);
    REQUIRE(checked.exit_code == 0);
    const auto report = cells(checked.output);
    REQUIRE(report[0].back() == "between_largest");
    const double largest = std::stod(report[1].back());
    CHECK(largest > 0);
    CHECK(largest < 0.1);
    const auto values = cells(found.output),
               exact = cells(place.hts("eval --material al.json --points between.csv").output);
    for (std::size_t row = 1; row < 3; ++row)
        CHECK(std::stod(values[row][7]) == Approx(std::stod(exact[row][7])).epsilon(largest));
}

TEST_CASE("table: bad input") {
    const Workplace place;
    place.file("al.json", material);
    const auto errors = [&](const std::string& arguments, int exit_code) {
        const Result result = place.hts(arguments);
        INFO(arguments);
        CHECK(result.exit_code == exit_code);
        return result.errors;
    };
    CHECK_THAT(errors(std::string{build} + "m.htst --shard 4/3", 2),
               Catch::Contains("--shard: \"4/3\": must be k/N"));
    CHECK_THAT(errors(std::string{build} + "m.htst --shard two", 2), Catch::Contains("must be k/N"));
    CHECK_THAT(errors(std::string{build} + "none/m.htst", 1), Catch::Contains("cannot be written"));
    CHECK_THAT(errors("table build --material al.json --tolerance 2 --output m.htst", 2),
               Catch::Contains("--tolerance: \"2\": must be a number from 1e-09 to 0.5"));
    CHECK_THAT(errors("table check al.json", 1), Catch::Contains("al.json: is no table"));
    CHECK_THAT(errors("table info none.htst", 1), Catch::Contains("none.htst: cannot be read"));
    CHECK(place.names() == std::vector<std::string>{"al.json"});
}
