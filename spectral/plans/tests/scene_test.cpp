#include "spectral/plans/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "spectral/energy/expected_distance.hpp"
#include "temporary_folder.hpp"

using hts::SpectralSample;
using hts::spectral::ErrorMeasure;
using hts::spectral::expected_distance;
using hts::spectral::Illuminant;
using hts::spectral::OutsideRange;
using hts::spectral::read_scene;
using hts::spectral::Scene;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;

namespace {

const std::string aluminium =
    R"({"name": "foil", "model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 2, "index": "Al"})";

/// A scene file, each of whose parts can be another.
struct SceneText {
    std::string materials = "[" + aluminium + "]";
    std::string wavelengths = R"("0.4:0.7:4")";
    std::string output = R"("rgb")";
    std::string theta_i = "80", theta_r = "70";
    std::string tolerance = R"({"delta_e_2000": 1})";
    std::string rest;

    [[nodiscard]] std::string text() const {
        return R"({"materials": )" + materials + R"(, "wavelengths_um": )" + wavelengths + R"(, "output": )" +
               output + R"(, "largest_theta_i_deg": )" + theta_i + R"(, "largest_theta_r_deg": )" + theta_r +
               R"(, "tolerance": )" + tolerance + rest + "}";
    }
};

Scene scene_of(const TemporaryFolder& folder, const SceneText& text) {
    return read_scene(folder.write("scene.json", text.text()));
}

std::string fingerprint_of(const TemporaryFolder& folder, const SceneText& text) {
    return fingerprint(scene_of(folder, text));
}

}  // namespace

TEST_CASE("a scene is read as it is written") {
    const TemporaryFolder folder;
    folder.write("gold.json",
                 R"({"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": 3, "index": "Au"})");
    SceneText text;
    text.materials = R"(["gold.json", )" + aluminium + "]";
    text.rest = R"(, "illuminant": "E", "memory_budget_bytes": 5000, "clamp": true, "name": "mine")";
    const Scene scene = scene_of(folder, text);
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name() == "gold");
    CHECK(scene.materials[1].name() == "foil");
    CHECK(scene.materials[1].properties().surface->correlation_length() == 2);
    CHECK(scene.wavelengths.size() == 4);
    CHECK(scene.outside_range == OutsideRange::hold);
    const std::string clamped = fingerprint(scene);
    text.rest = R"(, "illuminant": "E", "memory_budget_bytes": 5000, "outside": "hold", "name": "mine")";
    CHECK(fingerprint_of(folder, text) == clamped);
    text.rest = R"(, "outside": "near")";
    CHECK_THROWS_WITH(scene_of(folder, text), Catch::Contains("must be error, hold or zero"));
    text.rest = R"(, "outside": "hold", "clamp": true)";
    CHECK_THROWS_WITH(scene_of(folder, text), Catch::Contains("must not come with clamp"));
    CHECK(scene.largest_theta_i == Approx(80 * std::numbers::pi / 180));
    CHECK(scene.largest_theta_r == Approx(70 * std::numbers::pi / 180));
    CHECK(!scene.polarised);
    CHECK(scene.illuminant == Illuminant::E);
    CHECK(scene.measure == ErrorMeasure::delta_e_2000);
    CHECK(scene.tolerance == 1);
    CHECK(scene.memory_budget == 5000);
}

TEST_CASE("wavelengths may be a list, and most keys may be left out") {
    const TemporaryFolder folder;
    SceneText text;
    text.wavelengths = "[0.5, 0.6, 2]";
    text.output = R"("spectral")";
    text.tolerance = R"({"relative_brdf_error": 1e-3})";
    text.rest = R"(, "polarised": true)";
    const Scene scene = scene_of(folder, text);
    CHECK(scene.wavelengths.micrometres()[2] == 2);
    CHECK(scene.polarised);
    CHECK(!scene.illuminant);
    CHECK(scene.measure == ErrorMeasure::relative_brdf_error);
    CHECK(scene.tolerance == 1e-3);
    CHECK(!scene.memory_budget);
    text.output = R"("rgb")";
    text.wavelengths = R"("0.4:0.7:4")";
    CHECK(scene_of(folder, text).illuminant == Illuminant::D65);
}

TEST_CASE("every fault of a scene is named with file, key and legal range") {
    struct Case {
        SceneText text;
        std::vector<std::string> named;
    };
    const auto with = [](auto member, const std::string& value) {
        SceneText text;
        text.*member = value;
        return text;
    };
    const std::string spectral_output = R"("spectral")";
    const std::string polymer =
        R"([{"name": "p", "model": "he", "rms_roughness_um": 0, "correlation_length_um": 2, "index": )"
        R"("PMMA"}])";
    SceneText spectral = with(&SceneText::output, spectral_output);
    SceneText lit = spectral;
    lit.tolerance = R"({"relative_brdf_error": 0.1})";
    lit.rest = R"(, "illuminant": "D65")";
    SceneText polarised_paint = lit;
    polarised_paint.materials = R"([{"name": "wall", "model": "lambert", "diffuse_albedo": 0.5}])";
    polarised_paint.rest = R"(, "polarised": true)";
    SceneText compensated_paint = polarised_paint;
    compensated_paint.rest = R"(, "compensate_energy": true)";
    const std::vector<Case> cases{
        {with(&SceneText::materials, R"(["none.json"])"), {"\"materials[1]\"", "none.json", "no such file"}},
        {with(&SceneText::materials, "[]"), {"\"materials\"", "at least one"}},
        {with(&SceneText::materials, "{}"), {"\"materials\"", "must be an array"}},
        {with(&SceneText::materials, "[7]"), {"\"materials[1]\"", "path of a material file or a material"}},
        {with(&SceneText::materials, "[" + aluminium + "," + aluminium + "]"),
         {"\"materials[2]\"", "foil", "differ"}},
        {with(&SceneText::materials, R"([{"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 2,
              "index": "unobtainium"}])"),
         {"\"materials[1].index\"", "unobtainium", "Al"}},
        {with(&SceneText::materials, R"([{"model": "phong"}])"), {"\"materials[1].model\"", "phong", "he"}},
        {with(&SceneText::materials, polymer), {"\"wavelengths_um\"", "\"p\"", "0.4368 to 1.052 um"}},
        {with(&SceneText::wavelengths, "[]"), {"\"wavelengths_um\"", "at least one"}},
        {with(&SceneText::wavelengths, R"("0.7:0.4:5")"),
         {"\"wavelengths_um\"", "0.4", "> the first, 0.7 um"}},
        {with(&SceneText::wavelengths, R"("0.4:0.7:0")"), {"\"wavelengths_um\"", "from 1 to 1000000"}},
        {with(&SceneText::wavelengths, R"("0.5:0.7:5")"), {"\"wavelengths_um\"", "must cover 0.4 to 0.7 um"}},
        {with(&SceneText::wavelengths, "[-0.5]"), {"\"wavelengths_um\"", "-0.5", "> 0"}},
        {with(&SceneText::output, R"("photons")"), {"\"output\"", "photons", "spectral or rgb"}},
        {with(&SceneText::theta_i, "0"), {"\"largest_theta_i_deg\"", "> 0 and <= 90 deg"}},
        {with(&SceneText::theta_r, "91"), {"\"largest_theta_r_deg\"", "91", "> 0 and <= 90 deg"}},
        {spectral, {"\"tolerance.delta_e_2000\"", "contradicts", "spectral"}},
        {lit, {"\"illuminant\"", "contradicts", "spectral"}},
        {with(&SceneText::rest, R"(, "polarised": true)"),
         {"\"tolerance.delta_e_2000\"", "contradicts", "polarised"}},
        {with(&SceneText::rest, R"(, "polarised": 1)"), {"\"polarised\"", "true or false"}},
        {polarised_paint, {"\"polarised\"", "must be of model he", "\"wall\" has model lambert"}},
        {compensated_paint, {"\"compensate_energy\"", "must be of model he", "\"wall\" has model lambert"}},
        {with(&SceneText::rest, R"(, "illuminant": "F2")"), {"\"illuminant\"", "F2", "E, D65"}},
        {with(&SceneText::rest, R"(, "memory_budget_bytes": 0)"), {"\"memory_budget_bytes\"", "0", "> 0"}},
        {with(&SceneText::rest, R"(, "memory_budget_bytes": 2.5)"),
         {"\"memory_budget_bytes\"", "2.5", "whole number"}},
        {with(&SceneText::rest, R"(, "colour": 1)"), {"\"colour\"", "not known", "wavelengths_um"}},
        {with(&SceneText::tolerance, R"({"delta_e_2000": 1, "relative_brdf_error": 0.1})"),
         {"\"tolerance\"", "contradict each other", "one of them"}},
        {with(&SceneText::tolerance, "{}"),
         {"\"tolerance\"", "relative_brdf_error, delta_e_2000 or true_db"}},
        {with(&SceneText::tolerance, R"({"delta_e_2000": -1})"),
         {"\"tolerance.delta_e_2000\"", "-1", "0.001 to 100"}},
        {with(&SceneText::tolerance, R"({"relative_brdf_error": 1e-13})"),
         {"\"tolerance.relative_brdf_error\"", "1e-13", "from 1e-12 to 1"}},
    };
    for (const Case& one : cases) {
        const TemporaryFolder folder;
        const std::string text = complaint(folder, [&] { static_cast<void>(scene_of(folder, one.text)); });
        INFO(text);
        CHECK(text.starts_with("scene.json: key "));
        for (const std::string& part : one.named) {
            INFO("must name: " << part);
            CHECK(text.find(part) != std::string::npos);
        }
    }
}

TEST_CASE("a distance from exact scattering is that of model and arithmetic together") {
    const TemporaryFolder folder;
    SceneText text;
    text.output = R"("spectral")";
    text.theta_i = "60";
    text.wavelengths = R"("0.5:0.7:3")";
    const auto at = [&](const std::string& model, const std::string& decibels, const char* rest = "") {
        std::string of{aluminium};
        of.replace(of.find("he\""), 2, model);
        text.materials = "[" + of + "]";
        text.tolerance = R"({"true_db": )" + decibels + "}";
        text.rest = rest;
        return scene_of(folder, text);
    };
    // the greatest expected distance, by the same interpolation, point by point
    const Scene scene = at("he_unified", "0.9");
    REQUIRE(scene.true_db == 0.9);
    CHECK(scene.measure == ErrorMeasure::relative_brdf_error);
    double greatest = 0;
    const auto prepared = scene.materials[0].at(scene.wavelengths);
    for (const SpectralSample& sample : prepared.samples()) {
        for (const double theta : {0., 15., 30., 45., 60.})
            greatest = std::max(greatest, expected_distance(*scene.materials[0].properties().surface, sample,
                                                            hts::Direction::from_degrees(theta, 0))
                                              .distance.unified.unpolarised);
    }
    CHECK(greatest + 10 * std::log10(1 + scene.tolerance) == Approx(0.9).epsilon(1e-12));
    CHECK(at("he_unified", "0.9", R"(, "polarised": true)").tolerance < scene.tolerance);
    CHECK(at("he", "3").tolerance < at("he_unified", "3").tolerance);
    CHECK(at("he_unified", "30").tolerance == 1);
    CHECK(fingerprint(at("he_unified", "30")) != fingerprint(at("he_unified", "29")));
    using Catch::Contains;
    CHECK_THROWS_WITH(at("he", "0.01"), Contains("tolerance.true_db") && Contains("0.01: must be above") &&
                                            Contains("he of \"foil\"") && Contains("um (he_unified: "));
    text.theta_i = "85";
    CHECK_THROWS_WITH(at("he", "3"),
                      Contains("\"foil\" at 75 deg, ") && Contains("outside what was solved exactly"));
    text.theta_i = "60";
    text.materials = R"([{"name": "wall", "model": "lambert", "diffuse_albedo": 0.5}])";
    CHECK_THROWS_WITH(scene_of(folder, text), Contains("must be of model he or he_unified") &&
                                                  Contains("\"wall\" has model lambert"));
}

TEST_CASE("the fingerprint knows what a plan depends on, and nothing else") {
    const TemporaryFolder folder;
    const SceneText plain;
    std::vector<SceneText> others(9);
    others[0].materials = "[" + std::string{aluminium}.replace(aluminium.find("0.1"), 3, "0.2") + "]";
    others[1].materials = "[" + std::string{aluminium}.replace(aluminium.find("Al"), 2, "Cu") + "]";
    others[2].wavelengths = R"("0.4:0.7:5")";
    others[3].theta_i = "79";
    others[4].theta_r = "79";
    others[5].tolerance = R"({"delta_e_2000": 2})";
    others[6].rest = R"(, "illuminant": "E")";
    others[7].rest = R"(, "memory_budget_bytes": 100000)";
    others[8].tolerance = R"({"relative_brdf_error": 1})";
    std::set<std::string> prints{fingerprint_of(folder, plain)};
    for (const SceneText& other : others) prints.insert(fingerprint_of(folder, other));
    CHECK(prints.size() == 1 + others.size());

    SceneText same = plain;  // the material in a file of another folder, white space and name elsewhere
    const TemporaryFolder elsewhere;
    same.materials = "[\n \"" + elsewhere.write("m.json", aluminium).string() + "\"]";
    same.rest = R"(, "name": "renamed")";
    CHECK(fingerprint_of(folder, same) == fingerprint_of(folder, plain));
}

TEST_CASE("the fingerprint sees a table change between the scene's wavelengths") {
    const TemporaryFolder folder;
    const auto with_dip = [&](const std::string& n) {
        SceneText text;
        text.materials =
            R"([{"name": "t", "model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 2, "index":
            {"table": [[0.4, 1.5, 0], [0.53, 1.5, 0], [0.55, )" +
            n + R"(, 0], [0.57, 1.5, 0], [0.7, 1.5, 0]]}}])";
        return fingerprint_of(folder, text);
    };
    CHECK(with_dip("1.5") != with_dip("1.6"));
}
