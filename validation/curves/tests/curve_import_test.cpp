#include "validation/curves/curve_import.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "edited_text.hpp"
#include "hts/error.hpp"
#include "temporary_folder.hpp"
#include "validation/curves/digitised.hpp"

using namespace hts::validation;
using hts::testing::TemporaryFolder;
using hts::validation::testing::with;

namespace {

const std::string head =
    R"("kind": "measured", "by": "somebody", "source": "a notebook", "licence": "CC0-1.0",
  "quantity": "brdf", "scale": "absolute", "surface": "slate")";

std::string csv_recipe(const std::string& more = "") {
    return R"({"format": "csv", "sweep": "outgoing", "columns": {"theta_i": "ti_deg", "theta_r": "ts_deg"},
  "values": [{"column": "f", "wavelength_um": 0.5}], )" +
           more + head + "}";
}

CurveSet imported(const std::string& recipe, const std::string& name, const std::string& text) {
    const TemporaryFolder folder;
    const auto recipe_file = folder.write("recipe.json", recipe), file = folder.write(name, text);
    return imported_curves(file, read_recipe(recipe_file), "by the test");
}

void refuses(const std::string& recipe, const std::string& name, const std::string& text,
             const std::string& message) {
    INFO(message);
    CHECK_THROWS_WITH(imported(recipe, name, text), Catch::Contains(message));
}

const std::string csv = "# a comment\nti_deg,ts_deg,f\n30,-20,0.25\n30,30,1.5\n45,10,0.125\n30,0,0.5\n";

}  // namespace

TEST_CASE("a CSV file is imported as it stands, sorted by the angle that moves") {
    const CurveSet set = imported(csv_recipe(), "a.csv", csv);
    REQUIRE(set.curves.size() == 2);
    REQUIRE(set.curves[0].points.size() == 3);
    CHECK(set.how == "by the test");
    CHECK(set.curves[0].fixed_angle() == 30);
    const Curve& curve = set.curves[0];
    CHECK(curve.swept_angle(curve.points[0]) == -20);
    CHECK(curve.points[1].value == 0.5);
    CHECK(curve.points[2].value == 1.5);
    CHECK(curve.points[2].phi_r == 180);
    CHECK(curve.band.first == 0.5);
    CHECK(set.uncertainty.empty());
}

TEST_CASE("conventions of signs, azimuths and units are those of the recipe") {
    const CurveSet flipped = imported(csv_recipe(R"("mirror_sign": -1, )"), "a.csv", csv);
    CHECK(flipped.curves[0].swept_angle(flipped.curves[0].points[0]) == -30);
    CHECK(flipped.curves[0].points[0].value == 1.5);
    const CurveSet radians = imported(with(with(csv_recipe(), "ti_deg", "ti_rad"), "ts_deg", "ts_rad"),
                                      "a.csv", "ti_rad,ts_rad,f\n0.5,1.25,2\n");
    CHECK(radians.curves[0].points[0].theta_r == Approx(1.25 * 180 / std::acos(-1.0)).epsilon(1e-15));
    const std::string full = with(with(csv_recipe(), R"("theta_r": "ts_deg")",
                                       R"("theta_r": "ts_deg", "phi_i": "pi_deg", "phi_r": "ps_deg")"),
                                  "outgoing", "scattered");
    const std::string rows = "ti_deg,pi_deg,ts_deg,ps_deg,f\n30,5,40,20,1\n";
    CHECK(imported(full, "a.csv", rows).curves[0].points[0].phi_r == 20);
    const CurveSet mirrored =
        imported(with(full, R"("columns")", R"("mirror_azimuth_deg": 0, "columns")"), "a.csv", rows);
    CHECK(mirrored.curves[0].points[0].phi_r == 200);
    CHECK(mirrored.curves[0].points[0].phi_i == 5);
    // a sweep of the light
    const CurveSet incident =
        imported(with(csv_recipe(), "outgoing", "incident"), "a.csv", "ti_deg,ts_deg,f\n10,20,1\n11,20,2\n");
    REQUIRE(incident.curves.size() == 1);
    CHECK(incident.curves[0].fixed_angle() == 20);
    CHECK(incident.curves[0].points[1].theta_i == 11);
}

TEST_CASE("what a recipe leaves out is counted, and bad values there do not matter") {
    const std::string rows =
        "ti_deg,ts_deg,f\n30,-20,0.25\n30,28,9\n30,60,-0.1\n30,-31,4\n30,88,5\n30,40,0.5\n";
    const CurveSet set = imported(csv_recipe(R"("keep": {"positive_only": true, "largest_theta_deg": 85,
        "least_apart_deg": 5, "least_from_mirror_deg": 4}, )"),
                                  "a.csv", rows);
    CHECK(set.point_count() == 2);
    const std::vector<std::string> notes{"left out: 1 values that are 0 or negative",
                                         "left out: 1 values with a polar angle outside 0 ... 85 deg",
                                         "left out: 1 values with light and viewer less than 5 deg apart",
                                         "left out: 1 values less than 4 deg from the mirror direction"};
    CHECK(set.notes == notes);
    std::string many = "ti_deg,ts_deg,f\n";
    for (int angle = 0; angle < 60; ++angle)
        many += "30," + std::to_string(angle) + "," + (angle == 47 ? "8" : "1") + "\n";
    const CurveSet thin =
        imported(csv_recipe(R"("keep": {"every": 10, "all_within_deg_of_mirror": 1.5}, )"), "a.csv", many);
    std::vector<double> angles;
    for (const CurvePoint& p : thin.curves[0].points) angles.push_back(p.theta_r);
    CHECK(angles == std::vector<double>{0, 10, 20, 29, 30, 31, 40, 47, 50});  // and the largest
    CHECK(thin.notes.back() == "thinned: 9 of 60 values kept");
}

TEST_CASE("uncertainties come from reciprocal pairs and from printed digits") {
    const CurveSet set = imported(csv_recipe(R"("resolution": 0.01, "uncertainty_from_reciprocity": true, )"),
                                  "a.csv", "ti_deg,ts_deg,f\n30,50,1\n50,30,1.1\n");
    const double relative = std::log(1.1) / (0.6744897501960817 * std::sqrt(2.0));
    CHECK(set.curves[0].points[0].uncertainty ==
          Approx(std::hypot(relative, 0.01 / std::sqrt(12.0))).epsilon(5e-3));
    CHECK(set.uncertainty.find("1 reciprocal pairs") != std::string::npos);
}

TEST_CASE("uncertainties of one's own come from a column or a share, and rounding alone makes none") {
    const std::string rows = "ti_deg,ts_deg,f,sd\n30,50,1,0.03\n30,20,0.5,0.02\n";
    const std::string with_column =
        with(csv_recipe(), R"("column": "f")", R"("column": "f", "uncertainty_column": "sd")");
    const CurveSet own = imported(with_column, "a.csv", rows);
    CHECK(own.curves[0].points[0].uncertainty == 0.02);
    CHECK(own.curves[0].points[1].uncertainty == 0.03);
    CHECK(own.uncertainty == "one standard deviation: as the file states it, column \"sd\"");
    const CurveSet share =
        imported(csv_recipe(R"("relative_uncertainty": 0.04, "resolution": 0.01, )"), "a.csv", rows);
    CHECK(share.curves[0].points[1].uncertainty ==
          Approx(std::hypot(0.04, 0.01 / std::sqrt(12.0))).epsilon(5e-3));
    CHECK(share.uncertainty.find("0.04 of the value, as the recipe states") != std::string::npos);

    const CurveSet rounded = imported(csv_recipe(R"("resolution": 1e-6, )"), "a.csv", rows);
    CHECK(rounded.uncertainty.empty());
    CHECK(rounded.notes ==
          std::vector<std::string>{"values printed in steps of 1e-06; how far they can be trusted "
                                   "beyond that is not known, so no uncertainties"});
    const CurveSet lonely = imported(csv_recipe(R"("uncertainty_from_reciprocity": true, )"), "a.csv", rows);
    CHECK(lonely.uncertainty.empty());
    CHECK(lonely.notes ==
          std::vector<std::string>{"no uncertainties from reciprocity: no two points swap light and viewer"});

    refuses(with_column, "a.csv", with(rows, "0.02", "0"), ":3: uncertainty 0: must be > 0");
    refuses(with(with_column, R"("columns")", R"("relative_uncertainty": 0.1, "columns")"), "a.csv", rows,
            "key \"relative_uncertainty\": must not stand beside \"uncertainty_column\"");
    refuses(with(with_column, R"("columns")", R"("uncertainty_from_reciprocity": true, "columns")"), "a.csv",
            rows, "must not stand beside uncertainties that are known");
    refuses(with(with_column, R"({"column")", R"({"column": "f", "wavelength_um": 0.6}, {"column")"), "a.csv",
            rows, "must be of all or of none");
}

TEST_CASE("noise about 0 is kept, and what is too large for noise is not") {
    const std::string rows =
        "ti_deg,ts_deg,f\n30,30,2\n30,60,0.003\n30,65,-0.004\n30,70,0.001\n30,75,-0.003\n30,80,0\n";
    const CurveSet set = imported(csv_recipe(), "a.csv", rows);
    CHECK(set.point_count() == 6);
    CHECK(set.noise_floor.value() == Approx(0.005 / std::sqrt(2.0)));
    CHECK(set.notes.front().find("2 values below 0 kept as noise about 0 of standard deviation 0.00354") ==
          0);
    const TemporaryFolder folder;
    const CurveSet again = read_curves(folder.write("again.json", curves_text(set)));
    CHECK(again.noise_floor == set.noise_floor);
    CHECK(again.curves[0].points[4].value == set.curves[0].points[4].value);

    CHECK(imported(csv_recipe(R"("noise_floor": 0.01, )"), "a.csv", rows).noise_floor == 0.01);
    CHECK_FALSE(imported(csv_recipe(), "a.csv", csv).noise_floor);
    refuses(csv_recipe(), "a.csv", with(rows, "-0.003", "-0.3"),
            ":6: value -0.3: must be >= 0, or noise about 0 of at most 5 % of the largest value");
    CHECK_THROWS_WITH(
        read_curves(folder.write("bad.json", with(curves_text(set), "noise_floor\": ", "noise_floor\": -"))),
        Catch::Contains("noise_floor"));
    // what half of such values are worth: the mean of both signs is 0, that of the positive half is not
    CHECK(log_ratio(1e-3, -1e-3, 0.01).value() == Approx(0.1).epsilon(1e-3));
    CHECK(log_ratio(2, 1, 1e-6).value() == Approx(std::log(2)).epsilon(1e-9));
    CHECK_FALSE(log_ratio(1, -1e-3, 0));
}

TEST_CASE("an emissivity becomes a hemispherical reflectance, of the rows that a recipe asks for") {
    const std::string rows =
        "surface,theta_deg,emissivity,sd\nbrass,15,0.06,0.02\nslate,15,0.8,0.03\nslate,30,0.75,0.03\n";
    const std::string recipe = R"({"format": "csv", "kind": "measured", "surface": "slate", "by": "somebody",
        "source": "a notebook", "licence": "CC0-1.0", "quantity": "emissivity", "scale": "absolute",
        "columns": {"theta_i": "theta_deg"}, "rows": {"column": "surface", "text": "slate"},
        "values": [{"column": "emissivity", "uncertainty_column": "sd", "band_um": [2, 5.7]}]})";
    const CurveSet set = imported(recipe, "e.csv", rows);
    CHECK(set.quantity == Quantity::hemispherical_reflectance);
    REQUIRE(set.point_count() == 2);
    CHECK(set.curves[0].points[1].theta_i == 30);
    CHECK(set.curves[0].points[1].value == 0.25);
    CHECK(set.curves[0].points[1].uncertainty == 0.03);
    const TemporaryFolder folder;
    CHECK(read_curves(folder.write("e.json", curves_text(set))).curves[0].points[0].value ==
          set.curves[0].points[0].value);
    refuses(with(recipe, R"("theta_i": "theta_deg")", R"("theta_i": "theta_deg", "theta_r": "theta_deg")"),
            "e.csv", rows, "the light leaves into all directions");
    refuses(with(recipe, R"("text": "slate")", R"("text": "chalk")"), "e.csv", rows,
            "keeps none of its 0 values");
    CHECK_THROWS_WITH(read_curves(folder.write(
                          "bad.json", with(curves_text(set), R"("theta_r_deg": 0)", R"("theta_r_deg": 5)"))),
                      Catch::Contains("hemispherical_reflectance: must be absolute, in curves with"));
}

TEST_CASE("bad CSV files and recipes are refused") {
    refuses(csv_recipe(), "a.csv", with(csv, "1.5", "abc"), ":4: column \"f\": \"abc\" is not a number");
    refuses(csv_recipe(), "a.csv", with(csv, "1.5", "nan"), ":4: column \"f\"");
    refuses(csv_recipe(), "a.csv", with(csv, "1.5", "-1.5"), ":4: value -1.5: must be >= 0");
    refuses(csv_recipe(), "a.csv", with(csv, "45,10", "95,10"),
            ":5: polar angle 95 deg: must be 0 ... 90 deg");
    refuses(csv_recipe(), "a.csv", with(csv, "30,0", "30,30"),
            ":6: the same directions as on line 4: must stand once");
    refuses(csv_recipe(), "a.csv", with(csv, "ts_deg", "angle"), "column \"ts_deg\": missing");
    refuses(csv_recipe(), "a.csv", with(csv, "ti_deg,ts_deg,f", "ti_deg,ts_deg"), "a.csv:3");
    refuses(with(csv_recipe(), "ts_deg", "ts"), "a.csv", with(csv, "ts_deg", "ts"),
            "column \"ts\": no unit: must end in _deg or _rad");
    refuses(csv_recipe(R"("keep": {"least_theta_deg": 80}, )"), "a.csv", csv,
            "the recipe keeps none of its 4 values");
    refuses(csv_recipe(R"("keep": {"every": 1.5}, )"), "a.csv", csv,
            "key \"keep.every\": 1.5: must be a whole number");
    refuses(csv_recipe(R"("keep": {"every": 0}, )"), "a.csv", csv,
            "key \"keep.every\": 0: must be 1 ... 1000");
    refuses(csv_recipe(R"("mirror_sign": 2, )"), "a.csv", csv, "key \"mirror_sign\": 2: must be 1 or -1");
    refuses(csv_recipe(R"("colour": 2, )"), "a.csv", csv, "key \"colour\": not known");
    refuses(with(csv_recipe(), R"("format": "csv")", R"("format": "xls")"), "a.csv", csv,
            "key \"format\": \"xls\": must be one of csv, fred, astm, digitised");
    refuses(with(csv_recipe(), R"("theta_i": "ti_deg", )", ""), "a.csv", csv,
            "key \"columns.theta_i\": missing");
    refuses(with(csv_recipe(), R"("theta_i": "ti_deg", )", R"("theta_i": "ti_deg", "phi_i": "x", )"), "a.csv",
            csv, "one azimuth alone");
    refuses(with(csv_recipe(), R"(, "wavelength_um": 0.5)", ""), "a.csv", csv,
            "key \"values[1].band_um\": missing");
    refuses(with(csv_recipe(), R"(, "surface": "slate")", ""), "a.csv", csv, "key \"surface\": missing");
}

namespace {

const std::string fred_recipe = R"({"format": "fred", "sweep": "scattered", "mirror_azimuth_deg": 0,
  "values": [{"wavelength_um": 0.65}], )" +
                                head + "}";
const std::string fred =
    "type bsdf_data\nformat angles=deg bsdf=value scale=1\n10\t0\n0\t0\t0.03125\n5\t10\t0.5\n30\t0\n40 180 "
    "0.25\n";

const std::string astm_recipe = R"({"format": "astm", "sweep": "outgoing", )" + head + "}";
const std::string astm =
    "TITLE slate\nNUM_POINTS 3\nVARS theta_i,phi_i,theta_s,phi_s,450nm,650nm\n"
    "0.5,0,0.25,3.14159265,1,2\n0.5,0,0.75,0,3,4\n0.5,0,0.75,3.14159265,5,6\n";

}  // namespace

TEST_CASE("a FRED table is imported exactly") {
    const CurveSet set = imported(fred_recipe, "a.txt", fred);
    REQUIRE(set.curves.size() == 1);
    const auto& points = set.curves[0].points;
    REQUIRE(points.size() == 3);
    CHECK(points[1].theta_i == 10);
    CHECK(points[1].theta_r == 5);
    CHECK(points[1].phi_r == 190);
    CHECK(points[1].value == 0.5);
    CHECK(points[2].theta_i == 30);
    CHECK(points[2].phi_r == 360);
    const CurveSet plane = imported(with(with(fred_recipe, "scattered", "outgoing"), R"("values")",
                                         R"("keep": {"in_plane_only": true}, "values")"),
                                    "a.txt", fred);
    REQUIRE(plane.curves.size() == 2);
    CHECK(plane.curves[1].swept_angle(plane.curves[1].points[0]) == -40);
    CHECK(plane.notes.back() == "left out: 1 values out of the plane of incidence");
}

TEST_CASE("bad FRED tables are refused") {
    refuses(fred_recipe, "a.txt", with(fred, "bsdf_data", "mesh"), "a.txt:1: must be \"type bsdf_data\"");
    refuses(fred_recipe, "a.txt", with(fred, "angles=deg", "angles=turns"),
            "a.txt:2: must be \"format angles=deg bsdf=value scale=1\"");
    refuses(fred_recipe, "a.txt", with(fred, "10\t0\n", ""), "a.txt:3: values before the light's direction");
    refuses(fred_recipe, "a.txt", with(fred, "40 180 0.25", "40 180 0.25 7"),
            "a.txt:7: 4 numbers: must be 2");
    refuses(fred_recipe, "a.txt", with(fred, "0.25", "x"), "a.txt:7: \"x\" is not a number");
    refuses(fred_recipe, "a.txt", with(fred, "0.5", "-0.5"), "a.txt:5: value -0.5: must be >= 0");
}

TEST_CASE("an ASTM file is imported exactly, a curve per channel") {
    const CurveSet set = imported(astm_recipe, "a.astm", astm);
    REQUIRE(set.curves.size() == 2);
    const Curve& red = set.curves[1];
    CHECK(red.band.first == Approx(0.65).epsilon(1e-15));
    REQUIRE(red.points.size() == 3);
    CHECK(red.swept_angle(red.points[0]) == Approx(-0.75 * 180 / std::acos(-1.0)).epsilon(1e-15));
    CHECK(red.points[0].value == 4);
    CHECK(red.points[2].value == 6);
    CHECK(red.points[2].phi_r == 180);
    const CurveSet one = imported(
        with(astm_recipe, R"("sweep")", R"("values": [{"column": "450nm"}], "sweep")"), "a.astm", astm);
    CHECK(one.curves.size() == 1);
}

TEST_CASE("bad ASTM files are refused") {
    refuses(astm_recipe, "a.astm", with(astm, "NUM_POINTS 3", "NUM_POINTS 4"), "3 points: NUM_POINTS says 4");
    refuses(astm_recipe, "a.astm", with(astm, "NUM_POINTS 3", "NUM_POINTS -3"),
            ":2: NUM_POINTS: \"-3\": must be a whole number from 1 to 100000000");
    refuses(astm_recipe, "a.astm", with(astm, "theta_s,phi_s", "theta_s,phi"),
            ":3: VARS: must name theta_i, phi_i, theta_s, phi_s and a channel");
    refuses(astm_recipe, "a.astm", with(astm, "VARS", "COLUMNS"), "no line VARS");
    refuses(astm_recipe, "a.astm", with(astm, "450nm", "blue"), "channel \"blue\" names no wavelength");
    refuses(astm_recipe, "a.astm", with(astm, "0.5,0,0.75,0,3,4", "0.5,0,0.75,0,3"),
            ":5: 5 numbers: must be 6");
    refuses(astm_recipe, "a.astm", with(astm, "0.5,0,0.75,0,3,4", "1.6,0,0.75,0,3,4"),
            "must be 0 ... 90 deg");
    refuses(with(astm_recipe, R"("sweep")", R"("values": [{"column": "green"}], "sweep")"), "a.astm", astm,
            "no channel \"green\": must be one of 450nm, 650nm");
}

namespace {

const std::string figure = R"({"axes": {"type": "cartesian", "angle": [[100, 500, 0], [300, 500, 40]],
  "value": [[50, 450, 0.01], [50, 250, 1]], "value_scale": "log"}, "reading_px": 0.5,
  "curves": [{"wavelength_um": 0.5, "theta_i_deg": 30, "pixels": [[150, 350], [50, 250], [250, 350]]}]})";
const std::string digitised_recipe =
    R"({"format": "digitised", )" + with(head, "measured", "digitised") + "}";

}  // namespace

TEST_CASE("pixels of a figure become values, on linear, logarithmic and polar axes") {
    const auto linear =
        FigureAxes::cartesian({{100, 500}, 0}, {{300, 500}, 40}, {{50, 450}, 0}, {{50, 250}, 2}, false);
    CHECK(linear({150, 350}).angle == Approx(10).epsilon(1e-14));
    CHECK(linear({150, 350}).value == Approx(1).epsilon(1e-14));
    CHECK(linear.value_per_pixel({150, 350}) == Approx(0.01).epsilon(1e-14));
    const auto logarithmic =
        FigureAxes::cartesian({{100, 500}, 0}, {{300, 500}, 40}, {{50, 450}, 0.01}, {{50, 250}, 1}, true);
    CHECK(logarithmic({150, 350}).value == Approx(0.1).epsilon(1e-13));
    CHECK(logarithmic.value_per_pixel({150, 350}) == Approx(0.1 * std::log(100) / 200).epsilon(1e-13));
    // a polar figure, the normal up, the value 1 at 80 pixels on it
    const auto polar = FigureAxes::polar({{200, 300}, 0}, {200, 220}, {0, 1}, false);
    const double s = std::sin(std::acos(-1.0) / 6), c = std::cos(std::acos(-1.0) / 6);
    CHECK(polar({200 + 40 * s, 300 - 40 * c}).angle == Approx(30).epsilon(1e-13));
    CHECK(polar({200 + 40 * s, 300 - 40 * c}).value == Approx(0.5).epsilon(1e-13));
    CHECK(polar({200 - 80 * s, 300 - 80 * c}).angle == Approx(-30).epsilon(1e-13));
    const auto polar_log = FigureAxes::polar({{200, 300}, 0.001}, {240, 300}, {90, 10}, true);
    CHECK(polar_log({200, 280}).angle == Approx(0).margin(1e-12));
    CHECK(polar_log({200, 280}).value == Approx(0.1).epsilon(1e-13));
}

TEST_CASE("a page that lies askew is read as well as a straight one") {
    const double turn = 0.1;
    const auto turned = [&](Pixel p) {
        return Pixel{p.x * std::cos(turn) - p.y * std::sin(turn) + 13,
                     p.x * std::sin(turn) + p.y * std::cos(turn) - 7};
    };
    const auto axes = FigureAxes::cartesian({turned({100, 500}), 0}, {turned({300, 500}), 40},
                                            {turned({50, 450}), 0}, {turned({50, 250}), 2}, false);
    CHECK(axes(turned({150, 350})).angle == Approx(10).epsilon(1e-13));
    CHECK(axes(turned({150, 350})).value == Approx(1).epsilon(1e-13));
}

TEST_CASE("a digitised figure is imported with its reading uncertainty, and bad ones are refused") {
    const CurveSet set = imported(digitised_recipe, "f.json", figure);
    CHECK(set.kind == CurveKind::digitised);
    const Curve& curve = set.curves.at(0);
    CHECK(curve.fixed_angle() == 30);
    CHECK(curve.swept_angle(curve.points[1]) == Approx(-10));
    CHECK(curve.points[1].value == Approx(1));
    CHECK(curve.points[0].uncertainty == Approx(0.5 * 0.1 * std::log(100) / 200));
    refuses(digitised_recipe, "f.json", with(figure, "\"log\"", "\"ln\""),
            "key \"axes.value_scale\": \"ln\": must be linear or log");
    refuses(digitised_recipe, "f.json", with(figure, "0.01]", "0]"),
            "value on a logarithmic axis 0: must be > 0");
    refuses(digitised_recipe, "f.json", with(figure, "[300, 500, 40]", "[100, 500, 40]"),
            "angle axis: two marks at the same pixel");
    refuses(digitised_recipe, "f.json", with(figure, "[50, 250, 1]", "[250, 450, 1]"), "axes: parallel");
    refuses(digitised_recipe, "f.json", with(figure, "[250, 350]]", "[750, 350]]"),
            "row 3: angle 130 deg: must be -90 ... 90 deg");
    refuses(digitised_recipe, "f.json", with(figure, "\"reading_px\": 0.5", "\"reading_px\": 0"),
            "key \"reading_px\": 0: must be > 0");
    refuses(digitised_recipe, "f.json", with(figure, "cartesian", "round"),
            "key \"axes.type\": \"round\": must be cartesian or polar");
}
