// hts fit: fits by the command, the files they leave, and what it refuses.

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "command.hpp"

using hts::cli::testing::cells;
using hts::cli::testing::Workplace;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("hts fit prints the fit and leaves a material that other verbs take") {
    const Workplace place;
    const auto result = place.hts(
        "fit mwir-aluminium-sandblasted --index Al --most-points 60 --rings 0 --starts 2 "
        "--output fitted.json --report report.json");
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(result.errors.empty());
    for (const std::string part :
         {"sigma0", "tau", "median |ln(model/measured)|", "AIC", "starts reached the best"}) {
        INFO(part);
        CHECK(contains(result.output, part));
    }
    CHECK(place.hts("eval --material fitted.json --wavelength 3 --theta-i 30 --theta-r 40 --phi 180")
              .exit_code == 0);

    const auto report = nlohmann::json::parse(place.read("report.json"));
    const auto material = nlohmann::json::parse(place.read("fitted.json"));
    CHECK(report["material"] == material);
    CHECK(report["parameters"][0]["value"] == material["rms_roughness_um"]);
    CHECK(report["statistics"]["values"].get<int>() <= 60);
    CHECK(report["correlation"].size() == report["correlated"].size());
}

TEST_CASE("hts fit holds, frees and starts parameters as told") {
    const Workplace place;
    const auto report = [&](const std::string& options) {
        const auto result = place.hts("fit curet-sandpaper --starts 1 --json " + options);
        INFO(options << ": " << result.errors);
        REQUIRE(result.exit_code == 0);
        std::map<std::string, nlohmann::json> parameters;
        const auto found = nlohmann::json::parse(result.output);
        for (const auto& p : found["parameters"]) parameters[p["name"]] = p;
        return parameters;
    };
    auto fitted = report("--model kurt --fix f0=0.3 --free my,scale --start mx=0.4");
    CHECK(fitted["f0"]["outcome"] == "fixed");
    CHECK(fitted["f0"]["value"] == 0.3);
    CHECK(fitted["my"]["outcome"] != "tied");
    CHECK(fitted["scale"]["outcome"] == "fitted");
    CHECK(report("--model kurt")["my"]["outcome"] == "tied");
    CHECK(report("--model kurt")["my"]["value"] == report("--model kurt")["mx"]["value"]);
    CHECK_FALSE(report("--fix index=SiO2").contains("n"));
    CHECK(report("--loss cauchy --loss-scale 0.2 --residual relative").contains("n"));
}

TEST_CASE("what hts fit finds beside a material, hts compare takes") {
    const Workplace place;
    const auto fit =
        place.hts("fit mwir-aluminium-sandblasted --free scale --starts 4 --output fitted.json --json");
    REQUIRE(fit.exit_code == 0);
    const auto fitted = nlohmann::json::parse(place.read("fitted.json"));
    CHECK(fitted["fitted"]["data"] == "mwir-aluminium-sandblasted");
    const auto compared = place.hts("compare mwir-aluminium-sandblasted --material fitted.json");
    INFO(compared.errors);
    CHECK(compared.exit_code == 0);
    CHECK(contains(compared.errors, "model times the factor"));
    CHECK(place.hts("compare mwir-aluminium-sandblasted --material fitted.json --scale 1").exit_code == 1);
    // the factor belongs to these curves alone
    CHECK_FALSE(contains(place.hts("compare mwir-brass --material fitted.json").errors, "factor"));
    CHECK(place.hts("eval --material fitted.json --wavelength 3 --theta-i 30 --theta-r 40 --phi 180")
              .exit_code == 0);
}

TEST_CASE("hts fit says what solid angle and measured roughness mean") {
    const Workplace place;
    const auto plain = place.hts("fit anodised-ec1 --starts 4");
    INFO(plain.output);
    CHECK(contains(plain.output, "note: the specular term was not compared: no solid angle"));
    CHECK(contains(plain.output, "times below the rms roughness measured, 1.222 um"));
    CHECK(contains(plain.output, "the standard errors are not valid"));
    const auto seen = place.hts("fit anodised-ec1 --starts 4 --detector-solid-angle 1e-4");
    INFO(seen.output);
    CHECK_FALSE(contains(seen.output, "specular term"));
    CHECK(contains(seen.output, "only sigma0/tau = 0."));
    CHECK(seen.output.find("sigma0/tau ") < seen.output.find("  sigma0  "));
    const auto held =
        nlohmann::json::parse(place.hts("fit anodised-ec1 --starts 2 --fix sigma0=measured --json").output);
    CHECK(held["parameters"][0]["value"] == 1.222);
    CHECK(held["parameters"][0]["outcome"] == "fixed");
    CHECK(place.hts("fit mwir-brass --fix sigma0=measured").exit_code == 2);
    CHECK(place.hts("fit anodised-ec1 --detector-solid-angle 7").exit_code == 2);
    CHECK(contains(
        place.hts("compare anodised-ec1 --material " HTS_SOURCE_DIR "/cli/data/rough-aluminium.json").errors,
        "the specular term was not compared"));
}

TEST_CASE("hts fit compares all models") {
    const Workplace place;
    const auto rows =
        cells(place.hts("fit --all-models curet-sandpaper --most-points 20 --rings 0 --starts 1").output);
    REQUIRE(rows.size() > 10);
    CHECK(rows[0][0] == "data");
    std::set<std::string> data, models;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        data.insert(rows[i][0]);
        models.insert(rows[i][1]);
    }
    CHECK(data == std::set<std::string>{"curet-sandpaper"});
    for (const std::string model : {"he", "beckmann", "ggx", "kurt", "ward", "lambert"})
        CHECK(models.contains(model));
    CHECK(rows.size() - 1 == models.size());
}

TEST_CASE("hts fit refuses what cannot be fitted, and leaves no file") {
    const Workplace place;
    const auto refused = [&](const std::string& arguments, int code, const std::string& message) {
        const auto result = place.hts("fit " + arguments + " --output fitted.json");
        INFO(arguments << ": " << result.errors);
        CHECK(result.exit_code == code);
        CHECK(contains(result.errors, message));
        CHECK(place.names().empty());
    };
    refused("nowhere.json", 1, "nowhere.json");
    refused("curet-sandpaper --most-points 3", 1, "free parameters: must be more");
    refused("curet-sandpaper --largest-theta 1", 1, "up to 1 deg: must be at least one");
    refused("curet-sandpaper --fix a=0 --fix a=1", 2, "--fix: a: must be given once");
    refused("curet-sandpaper --start tau=1 --start tau=2", 2, "--start: tau: must be given once");
    refused("curet-sandpaper --fix tau=1 --fix correlation_length_um=2", 2,
            "correlation_length_um and tau are one parameter: must be fixed once");
    refused("curet-sandpaper --free rms_roughness_um --fix sigma0=2", 2, "sigma0: freed and fixed");
    refused("--all-models '" HTS_SOURCE_DIR "/cli/tests'", 1, "cli/tests: no curve sets (*.json)");
}

TEST_CASE("a fitted material leads back to its index from another folder") {
    const Workplace place;
    std::filesystem::create_directories(place.folder() / "out");
    place.file("metal.csv", "wavelength_um,n,k\n2,2,20\n6,6,50\n");
    const auto fitted = place.hts(
        R"(fit mwir-aluminium-sandblasted --model he --index '{"file": "metal.csv"}' --most-points 60 )"
        R"(--rings 0 --starts 1 --output out/m.json)");
    INFO(fitted.errors);
    REQUIRE(fitted.exit_code == 0);
    CHECK(place.read("out/m.json").find("\"../metal.csv\"") != std::string::npos);
    CHECK(place.hts("eval --material out/m.json --wavelength 4 --theta-i 30 --theta-r 30 --phi 180")
              .exit_code == 0);
}
