// Files of three channels, bases that files define, scatter files written, polarised files as materials.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "materials.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/zemax.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::testing::TemporaryFolder;

constexpr double pi = std::numbers::pi;

/// Blue, green and red that no two channels, lights or views share; its specular term is 0.1, 0.2, 0.3.
class Coloured final : public spectral::Evaluator {
  public:
    Coloured() : spectral::Evaluator{"coloured", rgb_wavelengths()} {}
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool above = pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
        const double lobe = 1.2 + dot(pair.in.mirror().vector(), pair.out.vector());
        for (std::size_t k = 0; k < 3; ++k)
            values[k] =
                above ? 0.1 + 0.05 * static_cast<double>(k + 1) * lobe * (1 + pair.in.cos_theta()) : 0;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        for (std::size_t k = 0; k < 3; ++k) values[k] = 0.1 * static_cast<double>(k + 1);
    }
};

spectral::Reflectance coloured() {
    return spectral::Reflectance{std::make_shared<const Coloured>()};
}

/// Largest difference over random pairs, of the largest value.
double difference(const spectral::Reflectance& a, const spectral::Reflectance& b, double least_cosine = 0.1) {
    REQUIRE(a.size() == b.size());
    Random random{8};
    std::vector<double> here(a.size()), there(a.size());
    double worst = 0, largest = 0;
    for (int i = 0; i < 2000; ++i) {
        const DirectionPair pair{random.direction(least_cosine), random.direction(least_cosine)};
        a.brdf(pair, here);
        b.brdf(pair, there);
        for (std::size_t k = 0; k < here.size(); ++k) {
            worst = std::max(worst, std::abs(here[k] - there[k]));
            largest = std::max(largest, here[k]);
        }
    }
    return worst / largest;
}

std::vector<double> held(const spectral::Reflectance& brdf, const DirectionPair& pair) {
    return brdf.brdf(pair);
}

}  // namespace

TEST_CASE("tristimulus values and chromaticities lead back to linear sRGB") {
    const auto zyx = tristimulus_of_srgb(coloured());
    CHECK(difference(coloured(), srgb_of_tristimulus(zyx)) < 1e-12);
    const auto chromaticity = chromaticity_of_tristimulus(zyx);
    const DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(50, 130)};
    const auto c = held(zyx, pair), uv = held(chromaticity, pair);
    CHECK(uv[0] == Approx(4 * c[2] / (c[2] + 15 * c[1] + 3 * c[0])));
    CHECK(uv[1] == Approx(9 * c[1] / (c[2] + 15 * c[1] + 3 * c[0])));
    CHECK_THROWS_WITH(tristimulus_of_srgb(brdf_at(coloured(), 0)), Catch::Contains("number of channels 1"));
    // a spectrum that is the same at all wavelengths is white: 1, 1, 1 of linear sRGB
    const auto grid = spectral::WavelengthGrid::linear(0.4, 0.7, 31);
    const auto glass = hts::tables::testing::rough_surface("BK7", 0, 1, 0.5, grid);
    const auto white = held(tristimulus_brdf(glass, spectral::Illuminant::D65), pair);
    for (const double value :
         held(srgb_of_tristimulus(tristimulus_brdf(glass, spectral::Illuminant::D65)), pair))
        CHECK(value == Approx(0.5 / pi).epsilon(1e-3));
    CHECK(white[1] == Approx(0.5 / pi).epsilon(1e-3));
    CHECK(white[0] > white[1]);
}

TEST_CASE("Klems' matrices of colour: X, Visible and Z") {
    const KlemsBasis& basis = KlemsBasis::quarter();
    const auto zyx = tristimulus_of_srgb(coloured());
    const std::string text = klems_xml(zyx, basis, true);
    for (const char* name : {">CIE-X<", ">Visible<", ">CIE-Z<"}) CHECK(text.find(name) != std::string::npos);
    const auto file = radiance_file(text, "k");
    CHECK(file.channels == xyz_channels());
    const auto& read = file.brdf;
    REQUIRE(read.size() == 3);
    CHECK(read.wavelengths().micrometres()[2] == 0.62);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        auto alone = with_channels_named(brdf_at(zyx, channel), luminance_wavelength());
        const auto expected =
            klems_brdf("k", luminance_wavelength(), basis, klems_means(alone, basis, true).front());
        CHECK(difference(with_channels_named(brdf_at(read, channel), luminance_wavelength()), expected) <
              1e-4);
    }
    // one wavelength asks for luminance
    const auto green = spectral::WavelengthGrid::from_micrometres({0.5});
    const auto luminance = radiance_brdf(text, "k", green);
    const DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(30, 180)};
    CHECK(held(luminance, pair)[0] == Approx(held(read, pair)[1]).epsilon(1e-4));
    CHECK_THROWS_WITH(radiance_brdf(text, "k", spectral::WavelengthGrid::from_micrometres({0.5, 0.6})),
                      Catch::Contains("k: holds 3 channels, not 2"));
    // the specular term of a patch is in the patch that mirrors it: all of its light over
    // its projected solid angle
    const auto without = radiance_brdf(klems_xml(zyx, basis), "k");
    std::vector<double> mirror(3);
    zyx.specular_reflectance(pair.in, mirror);
    for (std::size_t k = 0; k < 3; ++k)
        CHECK((held(read, pair)[k] - held(without, pair)[k]) *
                  basis.projected_solid_angle(basis.patch(pair.out)) ==
              Approx(mirror[k]).epsilon(1e-3));
}

TEST_CASE("tensor trees of colour: Visible with u' and v'") {
    const auto zyx = tristimulus_of_srgb(coloured());
    const std::string text = tensor_tree_xml(zyx, {5, 1e-3});
    for (const char* name : {">CIE-u<", ">Visible<", ">CIE-v<"}) CHECK(text.find(name) != std::string::npos);
    const auto file = radiance_file(text, "t");
    CHECK(file.channels == xyz_channels());
    const auto expected = radiance_brdf(
        tensor_tree_xml(with_channels_named(brdf_at(zyx, 1), luminance_wavelength()), {5, 1e-3}), "t");
    CHECK(difference(with_channels_named(brdf_at(file.brdf, 1), luminance_wavelength()), expected) < 1e-3);
    const DirectionPair pair{Direction::from_degrees(41, 13), Direction::from_degrees(33, 170)};
    const auto here = held(file.brdf, pair), there = held(zyx, pair);
    CHECK(here[2] / here[1] == Approx(there[2] / there[1]).epsilon(0.01));
    CHECK(here[0] / here[1] == Approx(there[0] / there[1]).epsilon(0.01));
    CHECK_THROWS_WITH(tensor_tree_xml(brdf_at(coloured(), 0), {9, 0}), Catch::Contains("from 1 to 8"));
}

TEST_CASE("a basis that a file defines is taken as it says") {
    const auto one = with_channels_named(brdf_at(coloured(), 1), luminance_wavelength());
    for (const KlemsBasis& known : {KlemsBasis::half(), KlemsBasis::quarter()}) {
        const KlemsBasis own{"own " + std::to_string(known.size()), known.rings()};
        const std::string text = klems_xml(one, own);
        CHECK(text.find("<AngleBasisName>" + own.name() + "</AngleBasisName>") != std::string::npos);
        CHECK(difference(radiance_brdf(text, "k"), radiance_brdf(klems_xml(one, known), "k")) == 0);
    }
    // rings that nobody else has, also under a name that is known
    for (const std::string name : {"three rings", "LBNL/Klems Quarter"}) {
        const KlemsBasis three{name, {{0, 20, 1}, {20, 50, 4}, {50, 90, 3}}};
        const auto read = radiance_brdf(klems_xml(one, three), "k");
        CHECK(difference(read, klems_brdf("k", luminance_wavelength(), three,
                                          klems_means(one, three).front())) < 1e-5);
    }
    const KlemsBasis two{"two", {{0, 20, 1}, {20, 90, 2}}};
    const auto damaged = [&](const std::string& from, const std::string& to) {
        std::string text = klems_xml(one, two);
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    CHECK_THROWS_WITH(radiance_brdf(damaged("<LowerTheta>20<", "<LowerTheta>25<"), "k"),
                      Catch::Contains("k:14: ") && Catch::Contains("rings must follow each other"));
    CHECK_THROWS_WITH(radiance_brdf(damaged("<UpperTheta>90<", "<UpperTheta>80<"), "k"),
                      Catch::Contains("90 deg"));
    CHECK_THROWS_WITH(radiance_brdf(damaged("<nPhis>2<", "<nPhis>2.5<"), "k"),
                      Catch::Contains("nPhis 2.5: must be a whole number"));
    CHECK_THROWS_WITH(radiance_brdf(damaged("<nPhis>2<", "<nPhis>many<"), "k"), Catch::Contains("nPhis"));
}

TEST_CASE("a Zemax file of tristimulus values comes back as them") {
    const auto zyx = tristimulus_of_srgb(coloured());
    const std::string text = zemax_colour_text(zyx);
    CHECK(text.find("SpectralContent XYZ") != std::string::npos);
    CHECK(text.find("wavelength_um") == std::string::npos);
    CHECK(difference(zemax_brdf(text, "z"), zyx) < 0.01);
}

TEST_CASE("a scatter file holds what a CSV file holds, in radians") {
    AngularGrid grid = csv_grid();
    grid.theta_i = {0, 20, 50, 80};
    const auto from_csv = brdf_from("c", points_of_csv(scatter_csv(coloured(), grid), "c")).brdf;
    const std::string text = scatter_astm(coloured(), grid);
    CHECK(text.find("\nVARS theta_i,phi_i,theta_s,phi_s,460nm,550nm,620nm\n") != std::string::npos);
    CHECK(text.find("\nNUM_POINTS " + std::to_string(grid.size()) + "\n") != std::string::npos);
    const auto from_astm = brdf_from("a", points_of_astm(text, "a"));
    CHECK(from_astm.layout == PointLayout::grid);
    CHECK(difference(from_astm.brdf, from_csv) < 1e-6);
    const std::string rgb = scatter_astm(coloured(), grid, true);
    CHECK(rgb.find(",phi_s,R,G,B\n") != std::string::npos);
    CHECK(difference(brdf_from("a", points_of_astm(rgb, "a")).brdf, from_csv) < 1e-6);
    CHECK_THROWS_WITH(scatter_astm(brdf_at(coloured(), 0), grid, true), Catch::Contains("3 for R, G, B"));
}

TEST_CASE("an RGL file of three channels is read with blue first, as it was written") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "colour.bsdf";
    const auto rough = hts::tables::testing::brdf_of("rough-aluminium.json", rgb_wavelengths());
    const RoundTripOptions few{.pairs = 200, .seed = 1};
    const auto exported = exported_rgl(rough, path, few, RglChannels::rgb);
    spectral::write_file(path.string(), exported.files.front().text);
    const TensorFile file = TensorFile::read(path);
    CHECK(file.contains("rgb"));
    CHECK_FALSE(file.contains("wavelengths"));
    CHECK_FALSE(file.contains("spectra"));
    CHECK(file.shape("rgb")[2] == 3);
    const auto found = read_brdf(path);
    CHECK(found.format == "rgl");
    CHECK(found.channels == rgb_channels());
    CHECK(found.brdf.wavelengths().micrometres()[0] == 0.46);
    CHECK(difference(found.brdf, rough) < 0.02);
    CHECK(found.brdf.properties().isotropic);
    const auto named =
        read_brdf(path, {.wavelengths = spectral::WavelengthGrid::from_micrometres({0.4, 0.5, 0.6})});
    CHECK(named.brdf.wavelengths().micrometres()[2] == 0.6);
    CHECK_THROWS_WITH(exported_rgl(brdf_at(rough, 0), path, few, RglChannels::rgb),
                      Catch::Contains("3 in a file of rgb"));
}

TEST_CASE("a polarised file is recognised by what it holds and keeps its polarisation as a material") {
    const TemporaryFolder folder;
    const auto five = spectral::WavelengthGrid::linear(0.45, 0.65, 5);
    const auto aluminium = hts::tables::testing::brdf_of("rough-aluminium.json", five);
    for (const char* name : {"al.pbsdf", "al.bsdf", "al"}) {
        const auto path = folder.path() / name;
        write_pbsdf(aluminium, path, {31, 31, 25});
        const auto found = read_brdf(path);
        CHECK(found.format == "pbsdf");
        CHECK(found.brdf.properties().polarised);
        const auto material = material_of_file(found.brdf);
        CHECK(material.properties().polarised);
        const auto between = material.at(spectral::WavelengthGrid::from_micrometres({0.5, 0.525}));
        const DirectionPair pair{Direction::from_degrees(40, 10), Direction::from_degrees(45, 195)};
        const auto here = between.mueller(pair);
        const auto there = found.brdf.mueller(pair);
        for (std::size_t e = 0; e < 16; ++e) {
            CHECK(here[0].elements()[e] == there[1].elements()[e]);
            CHECK(here[1].elements()[e] ==
                  Approx((there[1].elements()[e] + there[2].elements()[e]) / 2).margin(1e-15));
        }
    }
    CHECK_THROWS_WITH(read_brdf(folder.path() / "al", {.wavelengths = five}),
                      Catch::Contains("says its wavelengths"));
}
