// Odd files, as people and programs write them: for each the value that is read, or the whole message.
// They stand in the folder odd, written for this test.

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/measured_model.hpp"

namespace {

using namespace hts;
using namespace hts::tables;

const std::string folder = HTS_SOURCE_DIR "/tables/formats/tests/odd/";

struct Question {
    double theta_i = 30, theta_r = 60, phi = 120;  // [deg]
    double wavelength = 0.55;                      // [um]
};

/// A file that is read: the BRDF at a question, and what a note says.
struct Read {
    const char* file;
    double brdf;
    std::string note{};
    Question at{};
    std::optional<double> called{};  // wavelength that the user gives its channel [um]
};

/// A file that is refused, there or when it is asked: the message without the folder.
struct Refused {
    const char* file;
    std::string message;
    Question at{};
    std::optional<double> called{};
};

BrdfReading reading(const std::optional<double>& called) {
    if (!called) return {};
    return {.wavelengths = spectral::WavelengthGrid::from_micrometres({*called})};
}

double answer(const BrdfFile& file, const Question& at) {
    const auto material = material_of_file(file.brdf).named(file.brdf.name(), "measured", "");
    const DirectionPair pair{Direction::from_degrees(at.theta_i, 0),
                             Direction::from_degrees(at.theta_r, at.phi)};
    return material.at(Wavelength::from_micrometres(at.wavelength)).brdf(pair).front();
}

std::string joined(const std::vector<std::string>& notes) {
    std::string text;
    for (const std::string& note : notes) text += note + "\n";
    return text;
}

void check(const Read& expected) {
    INFO(expected.file);
    const BrdfFile file = read_brdf(folder + expected.file, reading(expected.called));
    CHECK(answer(file, expected.at) == Approx(expected.brdf).epsilon(5e-6).margin(1e-12));
    CHECK_THAT(joined(file.notes), Catch::Contains(expected.note));
    CHECK_THAT(file.notes.back(),
               Catch::StartsWith("covers ") && Catch::Contains("of the hemisphere of views"));
}

void check(const Refused& expected) {
    INFO(expected.file);
    std::string message = "nothing";
    try {
        static_cast<void>(answer(read_brdf(folder + expected.file, reading(expected.called)), expected.at));
    } catch (const Error& error) {
        message = error.what();
    }
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
        message.erase(at, folder.size());
    CHECK(message == expected.message);
}

const std::string columns =
    "theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg, brdf, wavelength_um, wavelength_nm, brdf_550nm";

}  // namespace

TEST_CASE("odd files of points: separators, decimal commas, columns") {
    const Question mirror{30, 30, 180};
    for (const Read& each : std::vector<Read>{
             {"points/plain.csv", 0.175, "on a full grid", {}, 0.55},
             {"points/semicolons.csv", 0.175, "semicolons between fields, decimal commas", {}, 0.55},
             {"points/tabs.tsv", 0.175, "tabs between fields\n", {}, 0.55},
             {"points/tabs-decimal-commas.txt", 0.175, "tabs between fields, decimal commas", {}, 0.55},
             {"points/blanks.txt", 0.175, "white space between fields\n", {}, 0.55},
             {"points/trailing-commas.csv", 0.175, "", {}, 0.55},
             {"points/sep-line.csv", 0.165, "semicolons between fields, decimal commas", mirror, 0.55},
             {"points/mark-and-crlf.csv", 0.165, "", mirror, 0.55},
             {"points/aligned.csv", 0.165, "", mirror, 0.55},
             {"points/quoted.csv", 0.165, "", mirror, 0.55},
             {"points/nanometres.csv", 0.175, "covers 0.5 to 0.6 um (2 values)", {.wavelength = 0.5}},
             {"points/nanometres.csv", 0.525, "", {.wavelength = 0.6}},
             {"points/said-twice.csv", 0.175, "1 point says again what another says: left out", {}, 0.55},
             {"points/other-column.csv", 0.175, "columns not used: remark", {}, 0.55},
             {"points/negative.csv",
              0,
              "2 values are negative, the first on line 22, the least -0.004 1/sr: taken as 0",
              {},
              0.55},
         })
        check(each);
    for (const Refused& each : std::vector<Refused>{
             {"points/mixed-decimals.csv",
              "points/mixed-decimals.csv:3: \"0.04\": a decimal point, where line 2 has a decimal comma: "
              "must be one of them"},
             {"points/rows-with-semicolons.csv",
              "points/rows-with-semicolons.csv:2: 1 fields: must be 4 as in the header, which has commas "
              "between fields where this line has semicolons"},
             {"points/decimal-commas-between-commas.csv",
              "points/decimal-commas-between-commas.csv:2: 5 fields: must be 4 as in the header; numbers "
              "with decimal commas need semicolons or tabs between fields"},
             {"points/rows-with-blanks.csv",
              "points/rows-with-blanks.csv:2: 1 fields: must be 4 as in the header, which has commas between "
              "fields where this line has white space"},
             {"points/header-with-blanks.csv",
              "points/header-with-blanks.csv:2: 4 fields: must be 1 as in the header, which has white space "
              "between names where this line has commas"},
             {"points/both-units.csv",
              "points/both-units.csv:1: columns \"wavelength_um\" and \"wavelength_nm\": must be one of the "
              "two"},
             {"points/unknown-wavelength.csv",
              "points/unknown-wavelength.csv:1: column \"wavelength\": not known; must be \"wavelength_um\"",
              {},
              0.5},
             {"points/misspelt-wavelength.csv",
              "points/misspelt-wavelength.csv:1: column \"wavelenght_um\": not known; must be "
              "\"wavelength_um\""},
             {"points/misspelt-azimuth.csv",
              "points/misspelt-azimuth.csv:1: column \"phi_i\": not known; must be one of " + columns,
              {},
              0.5},
             {"points/column-without-unit.csv",
              "points/column-without-unit.csv:1: column \"brdf_550\": not known; must be \"brdf_550nm\""},
             {"points/two-values.csv",
              "points/two-values.csv:41: theta_i 30, phi_i 0, theta_r 60, phi_r 120 deg: the directions of "
              "line 22 again, BRDF 0.5 and 0.175 1/sr: must have one value",
              {},
              0.55},
             {"points/no-number.csv",
              "points/no-number.csv:3: column \"brdf\": \"nan\" is not a finite number",
              {},
              0.55},
             {"points/below-horizon.csv",
              "points/below-horizon.csv:3: column \"theta_r_deg\": angle 95 deg: must be from 0 to 90",
              {},
              0.55},
             {"points/lacks-a-wavelength.csv",
              "points/lacks-a-wavelength.csv:4: 1 of 2 wavelengths at theta_i_deg 30, theta_r_deg 40, "
              "phi_r_deg 180: must be all"},
             {"points/header-alone.csv", "points/header-alone.csv: no points", {}, 0.55},
             {"points/plain.csv", "points/plain.csv: does not say its wavelength, which must be given"},
             {"points/nanometres.csv",
              "points/nanometres.csv: says its wavelengths, which must not be given",
              {},
              0.5},
         })
        check(each);
}

TEST_CASE("odd files of points: few directions are no hemisphere") {
    const Question beside{30, 30, 90};
    const std::string beyond = "; --outside hold or zero answers beyond";
    for (const Read& each : std::vector<Read>{
             // 41.4 deg from the mirror direction
             {"scatter/in-plane.csv", 0.05,
              "177 points in the plane of incidence; views beside it are assumed", beside, 0.55},
             {"scatter/in-plane-coarse.csv", 0.05, "in the plane of incidence", beside, 0.55},
             {"scatter/in-plane-coarse.csv", 2.05, "", {30, 30, 180}, 0.55},
             {"scatter/across.csv", 0.1, "", beside, 0.55},
             {"scatter/wide-gap.csv", 0.1, "", {0, 80, 90}, 0.55},
         })
        check(each);
    for (const Refused& each : std::vector<Refused>{
             {"scatter/along-normal.csv",
              "scatter/along-normal.csv: theta_i 30, theta_r 60, phi 180 deg: outside what was measured: "
              "must be within theta_i 0, 30, 60 deg, angle from the mirror direction 0, 30, 60 deg, which "
              "grows towards the normal" +
                  beyond,
              {30, 60, 180},
              0.55},
             {"scatter/wide-gap.csv",
              "scatter/wide-gap.csv: theta_i 0, theta_r 30, phi 90 deg: outside what was measured: must be "
              "within theta_i 0, 40 deg, theta_r 0, 80 deg, phi 0, 90, 180 deg" +
                  beyond,
              {0, 30, 90},
              0.55},
             {"scatter/across.csv",
              "scatter/across.csv: theta_i 30, theta_r 30, phi 180 deg: outside what was measured: must be "
              "within theta_i 30 deg, theta_r 0 to 80 deg (9 values), phi 90 deg" +
                  beyond,
              {30, 30, 180},
              0.55},
             {"scatter/in-plane.csv",
              "scatter/in-plane.csv: theta_i 45, theta_r 30, phi 180 deg: outside what was measured: must be "
              "within theta_i 30 deg, angle from the mirror direction -58 to 118 deg (177 values), which "
              "grows towards the normal" +
                  beyond,
              {45, 30, 180},
              0.55},
         })
        check(each);
}

TEST_CASE("odd scatter files") {
    const Question fred{50, 40, 135, 0.65};
    const double lobe = 0.02 + 0.002 * 40 * (1 + std::cos(std::numbers::pi / 4));
    for (const Read& each : std::vector<Read>{
             {"scatter/plain.astm", 0.175, "on a full grid"},
             {"scatter/vars-by-tab.astm", 0.175},
             {"scatter/vars-by-comma.astm", 0.175},
             {"scatter/semicolons.astm", 0.175},
             {"scatter/trailing-commas.astm", 0.175},
             {"scatter/long-head.astm", 0.175},
             {"scatter/xyz.astm",
              2 * 0.175,
              "channels, no spectrum: asked for as Z at 0.46 um, Y at 0.55 um, X at 0.62 um",
              {.wavelength = 0.62}},
             {"scatter/xyz.astm", 0.175 / 2, "", {.wavelength = 0.46}},
             {"scatter/plain.fred.txt", lobe, "azimuths counted with the mirror direction at 0 deg", fred,
              0.65},
             {"scatter/viavi.fred.txt", lobe, "Instrument: scatterometer\nSample: black\n", fred, 0.65},
             {"scatter/radians.fred.txt", lobe, "", fred, 0.65},
         })
        check(each);
    for (const Refused& each : std::vector<Refused>{
             {"scatter/wrong-count.astm", "scatter/wrong-count.astm: 39 points: NUM_POINTS says 7"},
             {"scatter/two-values.astm",
              "scatter/two-values.astm:43: theta_i 30, phi_i 0, theta_r 60, phi_r 120 deg: the "
              "directions of line 24 again, BRDF 0.7 and 0.175 1/sr: must have one value"},
             {"scatter/misspelt.astm",
              "scatter/misspelt.astm: channels \"phi_in, 550nm\": must be wavelengths such as 550nm, or R, "
              "G, B, or X, Y, Z, or one"},
             {"scatter/other-side.fred.txt",
              "scatter/other-side.fred.txt: more light at azimuth 180 deg than at 0, where the mirror "
              "direction is taken to be: mirror_azimuth_deg (--mirror-azimuth) must be 180",
              {},
              0.65},
             {"scatter/logarithms.fred.txt",
              "scatter/logarithms.fred.txt:2: must be \"format angles=deg bsdf=value scale=1\", angles deg "
              "or rad, scale any number",
              {},
              0.65},
             {"scatter/no-light.fred.txt",
              "scatter/no-light.fred.txt:3: values before the light's direction: must follow \"theta_i "
              "phi_i\"",
              {},
              0.65},
             {"scatter/plain.fred.txt",
              "scatter/plain.fred.txt: does not say its wavelength, which must be given"},
         })
        check(each);
}

TEST_CASE("odd files of Radiance and OpticStudio") {
    const std::string back = "read: \"Reflection Back, Visible\", the side of the normal";
    const Question red{30, 60, 120, 0.633};
    for (const Read& each : std::vector<Read>{
             {"matrices/plain.xml", 0.2, back + "\n"},
             {"matrices/log-line.xml", 0.2, back},
             {"matrices/mark.xml", 0.2, back},
             {"matrices/upper-case.xml", 0.2, "read: \"REFLECTION BACK, VISIBLE\""},
             {"matrices/several.xml", 0.2,
              "read: \"Reflection Back, visible\", the side of the normal; left out: \"Reflection Back, "
              "Solar\", \"Reflection Back, CIE-X\", \"Reflection Front, visible\""},
             {"matrices/front.xml", 0.4,
              "read: \"Reflection Front, Visible\", the other side, since there is no Reflection Back"},
             {"matrices/negative.xml",
              0.2,
              "1 value is negative, the first on line 9, the least -0.1 1/sr: taken as 0",
              {10, 20, 180}},
             {"matrices/plain.bsdf", 0.15, "", red},
             {"matrices/upper-case.bsdf", 0.15, "", red},
             {"matrices/no-wavelength.bsdf", 0.15, "", {}, 0.55},
             {"matrices/negative.bsdf",
              0.15,
              "2 values are negative, the first on line 18",
              {60, 60, 120, 0.633}},
             {"matrices/xyz.bsdf",
              0.2,
              "channels, no spectrum: asked for as Z at 0.46 um, Y at 0.55 um, X at 0.62 um",
              {.wavelength = 0.62}},
             {"matrices/xyz.bsdf", 0.15, "", {.wavelength = 0.55}},
             {"matrices/xyz.bsdf", 0.05, "", {.wavelength = 0.46}},
             {"matrices/lighttools.bsdf",
              0.19,
              "read: 4 blocks of BRDF Front; left out: 4 of BRDF Back, 4 of BTDF Back, 4 of BTDF Front",
              {40, 40, 180}},
             {"matrices/lighttools.bsdf", 3 * 0.14, "", {40, 40, 150, 0.6}},
             {"matrices/lighttools-half.bsdf", 0.14, "", {40, 40, 210}},
             {"matrices/lighttools-xyz.bsdf",
              0.38,
              "channels, no spectrum: asked for as Z at 0.46 um, Y at 0.55 um, X at 0.62 um",
              {40, 40, 180, 0.62}},
             {"matrices/short-radius.bsdf", 0.15, "", {40, 50, 180, 0.633}},
         })
        check(each);
    for (const Refused& each : std::vector<Refused>{
             {"matrices/solar.xml",
              "matrices/solar.xml:4: no block of Reflection Back or Reflection Front for the wavelength "
              "Visible; there are \"Reflection Back, Solar\", \"Reflection Front, NIR\""},
             {"matrices/two-visible.xml",
              "matrices/two-visible.xml:12: a second block of Reflection Back, visible (the first is on line "
              "7): must be one"},
             {"matrices/transmission.xml",
              "matrices/transmission.xml:4: no block of Reflection Back or Reflection Front for the "
              "wavelength Visible; there are \"Transmission Back, Visible\""},
             {"matrices/short-radius.bsdf",
              "matrices/short-radius.bsdf: theta_i 40, theta_r 80, phi 180 deg: outside what was measured: "
              "must be within theta_i 0, 40, 80 deg, angle from the mirror direction 0, 10, 20, 30 deg, "
              "azimuth about it 0, 180 deg; --outside hold or zero answers beyond",
              {40, 80, 180, 0.633}},
             {"matrices/no-wavelength.bsdf",
              "matrices/no-wavelength.bsdf: does not say its wavelength, which must be given"},
             {"matrices/second-block.bsdf",
              "matrices/second-block.bsdf:27: text after DataEnd, which no reader would see"},
             {"matrices/transmission.bsdf",
              "matrices/transmission.bsdf:5: ScatterType BTDF: only reflection can be read"},
             {"matrices/lighttools-twice.bsdf",
              "matrices/lighttools-twice.bsdf:26: a second block of AOI 40, POI 0, 550 nm: must be one"},
             {"matrices/lighttools-back.bsdf",
              "matrices/lighttools-back.bsdf: no block of reflection at the front; there are 2 of BRDF Back"},
             {"matrices/empty.bsdf", "matrices/empty.bsdf: file is empty"},
             {"matrices/unknown.bsdf",
              "matrices/unknown.bsdf: of no format that is known: merl, rgl, pbsdf, radiance, zemax, "
              "lighttools, fred, tracepro, openmaterial, bird, astm, csv"},
         })
        check(each);
}
