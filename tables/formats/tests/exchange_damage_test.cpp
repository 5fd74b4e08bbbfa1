// Damaged and hostile files: a named error or a sound BRDF, nothing else.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "damaged_files.hpp"
#include "hts/sampling/random.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/zemax.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::check_damaged;
using hts::tables::testing::MemoryBudget;
using hts::tables::testing::require_sound;
using hts::testing::complaint;
using hts::testing::exhaustive;
using hts::testing::TemporaryFolder;

/// A smooth BRDF.
class Smooth final : public spectral::Evaluator {
  public:
    explicit Smooth(const spectral::WavelengthGrid& wavelengths)
        : spectral::Evaluator{"smooth", wavelengths} {}
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        for (double& value : values) value = 0.1 + 0.05 * dot(pair.in.mirror().vector(), pair.out.vector());
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
    }
};

spectral::Reflectance smooth(const spectral::WavelengthGrid& wavelengths) {
    return spectral::Reflectance{std::make_shared<const Smooth>(wavelengths)};
}

using Reader = std::function<spectral::Reflectance(std::string_view text)>;
struct Sample {
    std::string name, text;
    Reader read;
};

const auto green = spectral::WavelengthGrid::from_micrometres({0.55});

constexpr const char* astm = R"(ASTM E1392
SAMPLE nickel
NUM_POINTS 6
WAVELENGTH 0.6328
VARS theta_i,phi_i,theta_s,phi_s,450nm,550nm
0.1,0,0.1,3.1415927,1.5,1.25
0.1,0,0.6,3.1415927,0.5,0.25
0.1,0,1.2,3.1415927,0.2,0.125
0.9,0,0.1,3.1415927,0.4,0.25
0.9,0,0.6,3.1415927,0.5,0.75
0.9,0,1.2,3.1415927,1e-2,0.125
)";

std::vector<Sample> samples() {
    AngularGrid around;
    around.axis = PolarAxis::mirror;
    around.theta_i = {0, 40, 80};
    around.azimuth = {0, 90, 180};
    around.polar = {0, 5, 30, 120};
    AngularGrid above;
    above.theta_i = above.polar = {0, 45, 89};
    above.azimuth = {0, 60, 180};
    return {
        {"Zemax", zemax_texts(smooth(green), around).front(),
         [](auto text) { return zemax_brdf(text, "z"); }},
        {"Klems", klems_xml(smooth(green), KlemsBasis::quarter()),
         [](auto text) { return radiance_brdf(text, "x"); }},
        {"tensor tree", tensor_tree_xml(smooth(green), {3, 0.02}),
         [](auto text) { return radiance_brdf(text, "x"); }},
        {"CSV", scatter_csv(smooth(green), above),
         [](auto text) { return brdf_from("c", points_of_csv(text, "c")).brdf; }},
        {"ASTM", astm, [](auto text) { return brdf_from("a", points_of_astm(text, "a")).brdf; }},
    };
}

void check_sound(const spectral::Reflectance& brdf) {
    static const std::vector<Direction> directions{
        Direction::from_degrees(0, 0), Direction::from_degrees(23, 7), Direction::from_degrees(61, 188),
        Direction::from_degrees(89.5, 301)};
    std::vector<double> values(brdf.wavelengths().size());
    for (const Direction& in : directions) {
        for (const Direction& out : directions) {
            brdf.brdf({in, out}, values);
            for (const double value : values) require_sound(value >= 0 && std::isfinite(value));
        }
    }
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("damaged text files give a named error or a sound BRDF") {
    const std::vector<std::string> nasty{"nan",
                                         "inf",
                                         "-1",
                                         "1e308",
                                         "1e999",
                                         "-0",
                                         "0",
                                         "18446744073709551616",
                                         "99999999",
                                         "{",
                                         "}",
                                         "{{{{{{{{",
                                         ",",
                                         "\n",
                                         "#",
                                         "<",
                                         "</Layer>",
                                         "<!DOCTYPE a [<!ENTITY b \"c\">]>&b;",
                                         "&b;",
                                         "\"",
                                         std::string(1, '\0'),
                                         "\xff",
                                         "0x10",
                                         "1.5.2",
                                         "TensorTree4",
                                         "Rows",
                                         "360",
                                         "VARS a,b",
                                         "Asymmetrical"};
    const TemporaryFolder folder;
    for (const Sample& sample : samples()) {
        std::size_t count = 0;
        const auto read = [&](const std::string& text) {
            // Now and then by way of a file whose format is guessed.
            check_sound(count++ % 16 == 15 ? read_brdf(folder.write("file.dat", text)).brdf
                                           : sample.read(text));
        };
        check_damaged({sample.name, sample.text, 1000, nasty, read, {}, 500, 200'000});
    }
}

TEST_CASE("damaged MERL files are refused with size or offset") {
    std::string bytes = merl_bytes(smooth(rgb_wavelengths()));
    const auto message = [&](std::string_view all) {
        const MemoryBudget budget{std::size_t{36} << 20};
        return message_of([&] { static_cast<void>(merl_brdf(all, "m")); });
    };
    Random random{12};
    const std::string header = bytes.substr(0, 12);
    const int count = exhaustive() ? 200'000 : 2'000;
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        if (i % 2 == 0) {
            refused += static_cast<int>(
                !message(std::string_view{bytes}.substr(0, random.bits() % merl_size)).empty());
        } else {
            const std::size_t at = random.bits() % 12;
            bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random.bits() % 255));
            refused += static_cast<int>(!message(bytes).empty());
            bytes.replace(0, 12, header);
        }
    }
    CHECK(refused == count);
    CHECK(message(bytes + "x").find("34992013 bytes") != std::string::npos);
    CHECK(message("").find("0 bytes") != std::string::npos);
    // values: every exponent bit set is infinity or NaN
    for (int i = 0; i < (exhaustive() ? 200 : 4); ++i) {
        const std::size_t at = 12 + 8 * (random.bits() % (merl_size / 8 - 2));
        const std::string kept = bytes.substr(at, 8);
        bytes[at + 7] = '\x7f';
        bytes[at + 6] = static_cast<char>(0xf0 + random.bits() % 16);
        CHECK(message(bytes).find("offset " + std::to_string(at)) != std::string::npos);
        bytes.replace(at, 8, kept);
    }
}

TEST_CASE("what is wrong with a file is named, with its line") {
    struct Case {
        std::size_t sample;
        std::string from, to;  // replaced once
        std::vector<std::string> named;
    };
    const auto files = samples();
    const std::vector<Case> cases{
        {0, "AngleOfIncidence 3", "AngleOfIncidence 999999999", {"z:9", "angle of incidence", "100000"}},
        {0, "ScatterAzimuth 3", "ScatterAzimuth 0", {"azimuth", "from 1"}},
        {0, "0 40 80", "0 40 20", {"polar angle of the light", "20", "> the one before it"}},
        {0, "ScatterType BRDF", "ScatterType BTDF", {"BTDF", "only reflection"}},
        {0, "SampleRotation 1", "SampleRotation 4", {"only isotropic"}},
        {0, "PlaneSymmetrical", "Spherical", {"Symmetry", "PlaneSymmetrical"}},
        {0, "DataEnd", "", {"DataEnd", "end of the file"}},
        {0, "# wavelength_um 0.55", "#", {"wavelength", "must be given"}},
        {0, "TIS", "TIS nan", {"TIS", "nan"}},
        {0, "TIS", "TIS 1e101", {"TIS", "at most 1e100", "1e101"}},
        {4, "1.25", "1e300", {"BRDF 1e+300 1/sr", "from -1e100 to 1e100"}},
        {1, "<Layer>", "<Lager>", {"not valid XML"}},
        {1, "Columns", "Diagonals", {"IncidentDataStructure", "Diagonals", "TensorTree3"}},
        {1, "Reflection Back", "Transmission Front", {"Reflection Back"}},
        {1, "<RowAngleBasis>LBNL/Klems Quarter", "<RowAngleBasis>LBNL/Klems Full", {"RowAngleBasis"}},
        {1, "</ScatteringData>", "1</ScatteringData>", {"more than 41"}},
        {2, "{", "{{", {"x:"}},
        {2, "TensorTree3", "TensorTree4", {"x:"}},
        {3, "theta_r_deg", "theta", {"theta_r_deg", "missing"}},
        {3, "brdf_550nm", "brdf", {"wavelength", "must be given"}},
        {3, "brdf_550nm", "radiance", {"brdf_550nm", "missing"}},
        {4, "NUM_POINTS 6", "NUM_POINTS 7", {"6 points", "NUM_POINTS says 7"}},
        {4, "VARS", "VARIABLES", {"VARS"}},
        {4, "theta_s", "theta_x", {"a:5", "theta_s"}},
        {4, "0.1,0,0.1", "0.1,0,9", {"a:6", "9 rad"}},
        {4, "1e-2", "x", {"a:11", "\"x\""}},
        {4, ",0.75", "", {"a:10", "5 numbers", "6"}},
        {4, "0.1,0,0.6,3.1415927,0.5", "0.1,,0.6,3.1415927,0.5", {"a:7", "\"\" is not a number"}},
        {4, "0.1,0,0.6,3.1415927,0.5", "0.1,,0,0.6,3.1415927,0.5", {"a:7", "7 numbers", "6"}},
        {4, "phi_i,", "theta_i,", {"a:5", "VARS: \"theta_i\" stands twice"}},
        {4, "450nm", "550nm", {"a:5", "VARS: \"550nm\" stands twice"}},
        {4, "450nm", "", {"a:5", "VARS: a name is empty"}},
        {4, "NUM_POINTS 6", "NUM_POINTS", {"a:3", "NUM_POINTS", "from 1 to 100000000"}},
        {4, "NUM_POINTS 6", "NUM_POINTS six", {"a:3", "NUM_POINTS", "\"six\"", "from 1 to 100000000"}},
        {4, "NUM_POINTS 6", "NUM_POINTS 200000000", {"200000000", "from 1 to 100000000"}},
    };
    for (const Case& one : cases) {
        std::string text = files[one.sample].text;
        const auto at = text.find(one.from);
        REQUIRE(at != std::string::npos);
        text.replace(at, one.from.size(), one.to);
        const std::string message = message_of([&] { static_cast<void>(files[one.sample].read(text)); });
        INFO(files[one.sample].name << ", " << one.from << " -> " << one.to << ": " << message);
        for (const std::string& part : one.named) CHECK(message.find(part) != std::string::npos);
    }
}

TEST_CASE("bombs are refused quickly") {
    const auto tree = [](const std::string& data) {
        return message_of([&] {
            static_cast<void>(radiance_brdf(
                "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree3</"
                "IncidentDataStructure>"
                "</DataDefinition><WavelengthData><WavelengthDataBlock><WavelengthDataDirection>Reflection "
                "Back"
                "</WavelengthDataDirection><ScatteringData>" +
                    data +
                    "</ScatteringData></WavelengthDataBlock></WavelengthData></Layer></Optical></"
                    "WindowElement>",
                "x"));
        });
    };
    CHECK(tree("{0.5}").empty());
    CHECK(tree(std::string(1'000'000, '{')).find("must be at most 24") != std::string::npos);
    CHECK(tree("{1 2 3}").find("power of 8") != std::string::npos);
    CHECK(tree("{}").find("0 numbers") != std::string::npos);
    CHECK(tree("{1} {2}").find("after the tree") != std::string::npos);
    std::string nested;
    for (int i = 0; i < 200'000; ++i) nested += "<a>";
    CHECK(message_of([&] { static_cast<void>(radiance_brdf(nested, "x")); }).find("not valid XML") !=
          std::string::npos);
    const std::string bomb =
        "<?xml version=\"1.0\"?><!DOCTYPE lolz [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b "
        "\"&a;&a;&a;&a;&a;&a;&a;&a;\">]><WindowElement>&b;</WindowElement>";
    CHECK(message_of([&] { static_cast<void>(radiance_brdf(bomb, "x")); }).find("Layer") !=
          std::string::npos);
}

TEST_CASE("a file is recognised by what it holds, or refused with the list of formats") {
    const TemporaryFolder folder;
    const std::vector<std::string> formats{"zemax", "radiance", "radiance", "csv", "astm"};
    const auto files = samples();
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto path = folder.write("file.dat", files[i].text);
        CHECK(read_brdf(path).format == formats[i]);
        CHECK_THROWS_AS(read_brdf(path, {.format = formats[i] == "zemax" ? "astm" : "zemax"}), Error);
    }
    const auto message = [&](const std::string& text) {
        const auto path = folder.write("unknown.dat", text);
        return complaint(folder, [&] { static_cast<void>(read_brdf(path)); });
    };
    CHECK(message("Lorem ipsum") ==
          "unknown.dat: of no format that is known: merl, rgl, pbsdf, radiance, zemax, lighttools, fred, "
          "tracepro, openmaterial, bird, astm, csv");
    CHECK(message("") == "unknown.dat: file is empty");
    CHECK_THROWS_WITH(read_brdf(folder.path() / "none.dat"), Catch::Contains("no such file"));
    CHECK_THROWS_WITH(read_brdf(folder.path()), Catch::Contains("is a directory"));
}
