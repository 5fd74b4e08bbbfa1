// Whatever is wrong with the input: one line that names it, the right exit code, nothing left behind.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "command.hpp"

using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

constexpr int data_failed = 1;

const std::string point = " --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 170";
const std::string points_header = "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg";

std::string material(const std::string& roughness, const std::string& correlation, const std::string& rest) {
    return R"({"model": "he", "rms_roughness_um": )" + roughness + R"(, "correlation_length_um": )" +
           correlation + ", " + rest + "}";
}

}  // namespace

TEST_CASE("bad material files") {
    struct Case {
        std::string text;
        std::vector<std::string> named;
    };
    const std::string al = R"("index": "Al")";
    const std::vector<Case> bad{
        {material("-0.1", "1", al), {"rms_roughness_um", "-0.1", "um", ">= 0"}},
        {material("0.1", "0", al), {"correlation_length_um", "0", "um", "> 0"}},
        {material("1e999", "1", al), {"m.json"}},
        {material("0.1", "-3", al), {"correlation_length_um", "-3", "> 0"}},
        {material("\"rough\"", "1", al), {"rms_roughness_um", "number"}},
        {material("0.1", "1", R"("index": {"n": 1.5, "k": -0.2})"), {"\"index.k\"", "-0.2", ">= 0"}},
        {material("0.1", "1", R"("index": {"n": 0, "k": 1})"), {"\"index.n\"", "0", "> 0"}},
        {material("0.1", "1", R"("index": "unobtainium")"), {"index", "unobtainium", "Al", "polystyrene"}},
        {material("0.1", "1", R"("index": {"file": "none.yml"})"), {"index", "none.yml"}},
        {material("0.1", "1", al + R"(, "diffuse_albedo": 1.5)"), {"diffuse_albedo", "1.5", "0 to 1"}},
        {material("0.1", "1", al + R"(, "diffuse_albedo": -0.5)"), {"diffuse_albedo", "-0.5", "0 to 1"}},
        {material("0.1", "1", al + R"(, "rougness": 2)"), {"rougness", "rms_roughness_um"}},
        {material("0.1", "1", al + R"(, "diffuse_albedo": {"table": [[0.5, 1.5]]})"),
         {"\"diffuse_albedo.table\"", "row 1", "1.5", "0 to 1"}},
        {R"({"model": "he", "rms_roughness_um": 0.1, "index": "Al"})", {"correlation_length_um", "missing"}},
        {R"({"rms_roughness_um": 0.1})", {"model", "missing"}},
        {R"({"model": "phong"})", {"model", "phong", "he"}},
        {R"({"model": "he", )", {"m.json:1"}},
        {"[1, 2]", {"m.json", "object"}},
        {"", {"m.json", "empty"}},
    };
    for (const Case& one : bad) {
        const Workplace place;
        place.file("m.json", one.text);
        INFO(one.text);
        auto named = one.named;
        named.emplace_back("m.json");
        check_complaint(place.hts("eval --material m.json --output answer.csv" + point), data_failed, named);
        CHECK(place.names() == std::vector<std::string>{"m.json"});
    }
}

TEST_CASE("bad points files") {
    struct Case {
        std::string text;
        std::vector<std::string> named;
    };
    const std::string good = points_header + "\n0.5,30,0,40,170\n";
    const std::vector<Case> bad{
        {"", {"p.csv", "empty"}},
        {"wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg\n0.5,1,2,3\n", {"p.csv:1", "phi_r_deg", "missing"}},
        {good + "0.5,30,0,forty,170\n", {"p.csv:3", "theta_r_deg", "forty", "number"}},
        {good + "0.5,30,0,40\n", {"p.csv:3", "4", "5"}},
        {good + "0.5,30,0,91,170\n", {"p.csv:3", "91", "0 to 90 deg"}},
        {good + "0.5,-1,0,40,170\n", {"p.csv:3", "-1", "0 to 90 deg"}},
        {good + "0.5,nan,0,40,170\n", {"p.csv:3", "theta_i_deg", "nan"}},
        {good + "0.5,30,inf,40,170\n", {"p.csv:3", "phi_i_deg", "inf"}},
        {good + "0,30,0,40,170\n", {"p.csv:3", "wavelength", "0", "um", "> 0"}},
        {good + "-0.5,30,0,40,170\n", {"p.csv:3", "wavelength", "-0.5", "um", "> 0"}},
        {good + "500,30,0,40,170\n", {"p.csv:3", "500", "0.10332 to 200 um", "Al"}},
        {points_header + ",albedo\n0.5,30,0,40,170,1.1\n", {"p.csv:2", "albedo", "1.1", "0 to 1"}},
        {points_header + ",k\n0.5,30,0,40,170,-1\n", {"p.csv:2", "k", "-1", ">= 0"}},
        {points_header + ",rms_roughness_um\n0.5,30,0,40,170,-1\n", {"p.csv:2", "roughness", "-1", ">= 0"}},
    };
    for (const Case& one : bad) {
        const Workplace place;
        place.file("m.json", material("0.28", "1.77", R"("index": "Al")"));
        place.file("p.csv", one.text);
        INFO(one.text);
        check_complaint(place.hts("eval --material m.json --points p.csv --output answer.csv"), data_failed,
                        one.named);
        CHECK(place.names() == std::vector<std::string>{"m.json", "p.csv"});
    }
}

TEST_CASE("files that are no files") {
    const Workplace place;
    place.file("m.json", material("0.28", "1.77", R"("index": "Al")"));
    place.file("p.csv", points_header + "\n0.5,30,0,40,170\n");
    check_complaint(place.hts("eval --material . " + point), data_failed, {".", "directory"});
    check_complaint(place.hts("eval --material none.json " + point), data_failed, {"none.json"});
    check_complaint(place.hts("eval --material m.json --points ."), data_failed, {".", "directory"});
    check_complaint(place.hts("eval --material m.json --points none.csv"), data_failed, {"none.csv"});
    check_complaint(place.hts("eval --material m.json --points p.csv --output ."), data_failed,
                    {".", "directory"});
    check_complaint(place.hts("eval --material m.json --points p.csv --output none/answer.csv"), data_failed,
                    {"none/answer.csv", "written"});
    check_complaint(place.hts("info none.json"), data_failed, {"none.json", "no such file"});
    check_complaint(place.hts("materials ./none.yml"), data_failed, {"./none.yml", "no such file"});
    check_complaint(place.hts("materials none.csv"), data_failed, {"none.csv", "no such file"});
    CHECK(place.names() == std::vector<std::string>{"m.json", "p.csv"});
}

TEST_CASE("a wavelength that the material does not have is traced to its option") {
    const Workplace place;
    place.file("m.json", material("0.28", "1.77", R"("index": "Al")"));
    const std::string pair = " --theta-i 30 --theta-r 40 --phi 170";
    const std::vector<std::pair<std::string, std::string>> commands{
        {"eval --material m.json --wavelength 500" + pair, "--wavelength: "},
        {"eval --material m.json --wavelengths 0.5,500" + pair, "--wavelengths: "},
        {"eval --material m.json --wavelengths 0.5,500 --random-pairs 10", "--wavelengths: "},
        {"spectrum --material m.json --wavelengths 0.5,500" + pair, "--wavelengths: "},
        {"polar --material m.json --wavelength 500 --theta-i 30", "--wavelength: "},
        {"info m.json --wavelengths 0.5,500", "--wavelengths: "}};
    for (const auto& [command, option] : commands) {
        check_complaint(place.hts(command), data_failed, {option, "500", "0.10332 to 200 um", "Al"});
        CHECK(place.hts(command + " --clamp").exit_code == 0);
    }
}

TEST_CASE("a file in the way is kept when the run fails") {
    const Workplace place;
    place.file("m.json", material("0.28", "1.77", R"("index": "Al")"));
    place.file("p.csv", points_header + "\n0.5,30,0,40,170\n0.5,30,0,100,170\n");
    place.file("answer.csv", "precious");
    check_complaint(place.hts("eval --material m.json --points p.csv --output answer.csv"), data_failed,
                    {"p.csv:3"});
    CHECK(place.read("answer.csv") == "precious");
}
