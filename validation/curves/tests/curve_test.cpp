#include "validation/curves/curve.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "comparison.hpp"
#include "edited_text.hpp"
#include "hts/error.hpp"
#include "temporary_folder.hpp"
#include "validation/curves/built_in_curves.hpp"

using namespace hts::validation;
using hts::testing::TemporaryFolder;
using hts::validation::testing::with;

namespace {

const std::string valid = R"({
  "format": "hts curves", "format_version": 1, "surface": "slate", "kind": "measured", "by": "somebody",
  "source": "a notebook", "licence": "CC0-1.0", "how": "by hand", "quantity": "brdf", "scale": "absolute",
  "source_solid_angle_sr": 0.001, "measured_roughness": {"rms_um": 1.5, "method": "stylus"},
  "uncertainty": "repeated readings",
  "curves": [
    {"wavelength_um": 0.5, "theta_i_deg": 30, "points": [[-20, 0.1, 0.01], [0, 0.2, 0.01], [30, 0.5, 0.02]]},
    {"band_um": [2, 5.7], "theta_r_deg": 20, "points": [[10, 0.1, 0.01], [25.5, 0.3, 0.01]]},
    {"wavelength_um": 0.5, "points": [[30, 10, 45, 190, 0.25, 0.01]]}]
})";

void refuses(const std::string& text, const std::string& message) {
    const TemporaryFolder folder;
    const auto file = folder.write("bad.json", text);
    INFO(message);
    CHECK_THROWS_WITH(read_curves(file), Catch::Contains(file.string()) && Catch::Contains(message));
}

bool same(const CurvePoint& a, const CurvePoint& b) {
    return a.theta_i == b.theta_i && a.phi_i == b.phi_i && a.theta_r == b.theta_r && a.phi_r == b.phi_r &&
           a.value == b.value && a.uncertainty == b.uncertainty;
}

}  // namespace

TEST_CASE("a curve file says what it holds") {
    const TemporaryFolder folder;
    const auto file = folder.write("slate.json", valid);
    const CurveSet set = read_curves(file);
    CHECK(set.stem == "slate");
    CHECK(set.surface == "slate");
    CHECK(set.point_count() == 6);
    CHECK(set.source_solid_angle == 0.001);
    CHECK_FALSE(set.detector_solid_angle);
    CHECK(set.roughness->rms_um == 1.5);
    const Curve& outgoing = set.curves[0];
    CHECK(outgoing.sweep == Sweep::outgoing);
    CHECK(outgoing.fixed_angle() == 30);
    CHECK(outgoing.swept_angle(outgoing.points[0]) == -20);
    CHECK(outgoing.points[0].phi_r == 0);  // the light's side
    CHECK(outgoing.points[2].phi_r == 180);
    const Curve& incident = set.curves[1];
    CHECK(incident.sweep == Sweep::incident);
    CHECK(incident.fixed_angle() == 20);
    CHECK(incident.points[1].theta_i == 25.5);
    CHECK(incident.points[1].theta_r == 20);
    CHECK_FALSE(incident.band.single());
    CHECK(set.curves[2].sweep == Sweep::scattered);
    CHECK(set.curves[2].points[0].phi_i == 10);
    // the mirror direction of the light is where `pair` says
    const auto pair = outgoing.points[2].pair();
    CHECK(pair.out.vector().x == Approx(-pair.in.vector().x));
}

TEST_CASE("a curve file is read back to the last bit") {
    const TemporaryFolder folder;
    const auto file = folder.write("slate.json", valid);
    CurveSet set = read_curves(file);
    hts::testing::Random random{3};
    for (Curve& curve : set.curves) {
        for (CurvePoint& p : curve.points) {
            p.value = random.logarithmic(1e-9, 1e9);
            p.uncertainty = random.logarithmic(1e-12, 1e3);
        }
    }
    set.notes = {"one", "\"two\", in quotes"};
    const auto again = folder.write("again.json", curves_text(set));
    const CurveSet copy = read_curves(again);
    REQUIRE(copy.point_count() == set.point_count());
    CHECK(copy.notes == set.notes);
    CHECK(copy.how == set.how);
    CHECK(copy.uncertainty == set.uncertainty);
    for (std::size_t i = 0; i < set.curves.size(); ++i) {
        CHECK(copy.curves[i].sweep == set.curves[i].sweep);
        CHECK(copy.curves[i].band.last == set.curves[i].band.last);
        for (std::size_t j = 0; j < set.curves[i].points.size(); ++j)
            CHECK(same(copy.curves[i].points[j], set.curves[i].points[j]));
    }
}

TEST_CASE("bad curve files are refused with the key and what is legal") {
    refuses(with(valid, R"("surface": "slate",)", ""), R"(key "surface": missing)");
    refuses(with(valid, R"("surface": "slate",)", R"("surface": " ",)"),
            R"(key "surface": must not be empty)");
    refuses(with(valid, R"("surface")", R"("colour": 1, "surface")"), R"(key "colour": not known)");
    refuses(with(valid, R"("measured")", R"("guessed")"),
            R"(key "kind": "guessed": must be one of measured, digitised, theory)");
    refuses(with(valid, R"("brdf")", R"("radiance")"),
            R"(key "quantity": "radiance": must be one of brdf, brdf_cosine)");
    refuses(with(valid, R"("absolute")", R"("relative")"), R"(key "scale")");
    refuses(with(valid, R"("format_version": 1)", R"("format_version": 2)"),
            R"(key "format_version": 2: must be 1)");
    refuses(with(valid, "0.001", "7"), "source_solid_angle_sr 7 sr: must be > 0 and at most 2 pi sr");
    refuses(with(valid, "[30, 0.5, 0.02]", "[95, 0.5, 0.02]"),
            R"(key "curves[1].points": row 3: theta_r 95 deg: must be 0 ... 90 deg)");
    refuses(with(valid, "[30, 0.5, 0.02]", "[30, -0.5, 0.02]"), "value -0.5: must be >= 0");
    refuses(with(valid, "[30, 0.5, 0.02]", "[30, NaN, 0.02]"), "not valid JSON");
    refuses(with(valid, "[30, 0.5, 0.02]", "[30, 0.5, 0]"), "uncertainty 0: must be > 0");
    refuses(with(valid, "[30, 0.5, 0.02]", "[30, 0.5]"),
            R"(row 3: must be 3 numbers, [theta_r_deg, value, uncertainty])");
    refuses(with(valid, "[0, 0.2, 0.01]", "[-20, 0.2, 0.01]"),
            R"(row 2: the same directions as in an earlier row)");
    refuses(with(valid, R"("uncertainty": "repeated readings",)", ""), "must be 2 numbers");
    refuses(with(valid, "[2, 5.7]", "[5.7, 2]"), "end of the band 2 um: must be at least its beginning");
    refuses(with(valid, "[2, 5.7]", "[2]"), R"(key "curves[2].band_um": must be [first, last])");
    refuses(with(valid, R"("wavelength_um": 0.5)", R"("wavelength_um": -0.5)"),
            "wavelength -0.5 um: must be > 0");
    refuses(with(valid, R"("theta_r_deg": 20)", R"("theta_r_deg": 20, "theta_i_deg": 20)"),
            "must not stand beside");
    refuses(with(valid, R"("points": [[10, 0.1, 0.01], [25.5, 0.3, 0.01]])", R"("points": [])"),
            R"(key "curves[2].points": must have at least one row)");
    refuses(with(valid, "1.5", "-1"), "rms_roughness_um -1 um: must be >= 0");
}

TEST_CASE("the curve sets that come along state source, licence and how they were made") {
    const auto names = built_in_curve_names();
    CHECK(names.size() >= 12);
    std::set<std::string> surfaces;
    for (const std::string& name : names) {
        INFO(name);
        const CurveSet set = built_in_curves(name);
        CHECK(set.stem == name);
        CHECK(set.kind == CurveKind::measured);
        CHECK(set.how.starts_with("hts curves import "));
        surfaces.insert(set.surface);
        const bool free = set.licence == "CC0-1.0" || set.licence == "MIT";
        CHECK((free || set.point_count() <= 48));  // of others no more than a few dozen figures are cited
    }
    CHECK(surfaces.size() == names.size());
    CHECK_THROWS_WITH(built_in_curves("marble"),
                      Catch::Contains("no curve set \"marble\": must be a file or one of"));
    CHECK(curves_named("mwir-brass").surface == "brass");
}

TEST_CASE("curves that leave the plane of incidence are not in-plane curves") {
    const TemporaryFolder folder;
    const auto file = folder.write("slate.json", valid);
    CurveSet set = read_curves(file);
    set.curves[0].points[1].phi_r = 90;
    CHECK_THROWS_WITH(
        checked(set, "here"),
        Catch::Contains("here: key \"curves[1].points\": row 2: directions that leave the plane"));
}
