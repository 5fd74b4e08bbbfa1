#include "tables/formats/measured_model.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "materials.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/zemax.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::testing::complaint;
using hts::testing::Random;
using hts::testing::TemporaryFolder;

const auto grid = spectral::WavelengthGrid::from_micrometres({0.5, 0.6});

spectral::Reflectance gold() {
    return tables::testing::brdf_of("rough-gold.json", grid);
}

}  // namespace

TEST_CASE("a measured model lies on straight lines between its wavelengths") {
    const auto brdf = gold();
    const auto reflector = material_of_file(brdf);
    const DirectionPair pair{Direction::from_degrees(30, 10), Direction::from_degrees(40, 200)};
    std::vector<double> values(2);
    brdf.brdf(pair, values);
    const auto at = [&](double um) {
        return reflector.at(Wavelength::from_micrometres(um)).brdf(pair).front();
    };
    CHECK(at(0.5) == values[0]);
    CHECK(at(0.6) == values[1]);
    CHECK(at(0.525) == Approx(0.75 * values[0] + 0.25 * values[1]).epsilon(1e-14));
    CHECK_THROWS_WITH(at(0.61), Catch::Contains("0.61 um") && Catch::Contains("from 0.5 to 0.6 um"));
    CHECK(reflector.at(Wavelength::from_micrometres(0.9), {.outside = spectral::OutsideRange::hold})
              .brdf(pair)
              .front() == values[1]);
    const auto single = material_of_file(brdf_at(brdf, 0));
    CHECK(single.at(Wavelength::from_micrometres(0.5)).brdf(pair).front() == values[0]);
    CHECK_THROWS_AS(single.at(Wavelength::from_micrometres(0.51)), Error);
}

TEST_CASE("draws of a measured model have the density it says, and their weights the albedo for mean") {
    for (const char* file : {"rough-gold.json", "purple-satin.json"}) {  // isotropic; with a grain
        const auto brdf = tables::testing::brdf_of(file, spectral::WavelengthGrid::from_micrometres({0.55}));
        const auto reflectance = material_of_file(brdf).at(Wavelength::from_micrometres(0.55));
        const auto model = reflectance.sampler(0);
        for (const double theta : {0.0, 35.0, 70.0}) {
            INFO(file << " at " << theta);
            const Direction in = Direction::from_degrees(theta, 25);
            // the density over the hemisphere, by cells of equal solid angle; draws are
            // counted in the same cells
            constexpr std::size_t rows = 8, columns = 16, points = 24;
            std::vector<double> expected(rows * columns, 0), drawn(rows * columns, 0);
            for (std::size_t row = 0; row < rows * points; ++row) {
                for (std::size_t column = 0; column < columns * points; ++column) {
                    const double cosine = (static_cast<double>(row) + 0.5) / (rows * points);
                    const Direction out = Direction::from_angles(
                        std::acos(cosine),
                        2 * std::numbers::pi * (static_cast<double>(column) + 0.5) / (columns * points));
                    expected[row / points * columns + column / points] +=
                        model.pdf(in, out) * 2 * std::numbers::pi / (rows * columns * points * points);
                }
            }
            Random random{8};
            const int count = 100'000;
            double sum = 0, squares = 0, none = 0;
            for (int i = 0; i < count; ++i) {
                const Draw draw = model.sample(in, random.uniforms());
                sum += draw.weight;
                squares += draw.weight * draw.weight;
                if (draw.lobe == Lobe::none) {
                    ++none;
                    continue;
                }
                CHECK(draw.weight * draw.pdf ==
                      Approx(reflectance.brdf({in, draw.out}).front() * draw.out.cos_theta()).epsilon(1e-12));
                const double turn =
                    std::atan2(draw.out.sin_phi(), draw.out.cos_phi()) / (2 * std::numbers::pi) + 1;
                const auto row = std::min(static_cast<std::size_t>(draw.out.cos_theta() * rows), rows - 1);
                drawn[row * columns + static_cast<std::size_t>(turn * columns) % columns] += 1.0 / count;
            }
            double integral = 0;
            for (std::size_t cell = 0; cell < expected.size(); ++cell) {
                integral += expected[cell];
                const double deviation = std::sqrt(expected[cell] / count) + 1e-4;
                CHECK(std::abs(drawn[cell] - expected[cell]) < 5 * deviation + 0.03 * expected[cell]);
            }
            CHECK(integral + none / count == Approx(1).margin(0.01));
            const double mean = sum / count, spread = std::sqrt(std::max(0.0, squares / count - mean * mean));
            const double albedo = reflectance.albedo(in, 0).total();
            std::cout << file << " at " << theta << ": mean weight " << mean << ", albedo " << albedo
                      << ", relative spread of weights " << spread / mean << '\n';
            CHECK(std::abs(mean - albedo) < 5 * spread / std::sqrt(count) + 1e-4 * albedo);
        }
    }
}

TEST_CASE("a material file names a measured file") {
    const TemporaryFolder folder;
    const auto one = spectral::WavelengthGrid::from_micrometres({0.6});
    const auto brdf = tables::testing::brdf_of("rough-gold.json", one);
    AngularGrid coarse = csv_grid();
    coarse.theta_i = coarse.polar = {0, 20, 40, 60, 80};
    folder.write("gold.csv", scatter_csv(brdf, coarse));
    const auto read = [&](const std::string& text) {
        return spectral::read_material(folder.write("m.json", text), models_with_files());
    };
    const auto material = read(R"({"name": "gold", "model": "measured", "file": "gold.csv"})");
    CHECK(material.name() == "gold");
    CHECK(material.model_name() == "measured");
    REQUIRE(material.warnings().size() == 2);
    CHECK(material.warnings().front().find("full grid") != std::string::npos);
    CHECK(
        material.warnings().back() ==
        "covers 0.6 um, theta_i 0 to 80 deg (5 values), theta_r 0 to 80 deg (5 values), phi 0 to 180 deg (23 "
        "values): 96.9 % of the hemisphere of views");
    const DirectionPair node{Direction::from_degrees(40, 0), Direction::from_degrees(60, 180)};
    double exact = 0;
    brdf.brdf(node, {&exact, 1});
    CHECK(material.at(one[0]).brdf(node).front() == Approx(exact).epsilon(1e-5));
    const auto complaint_about = [&](const std::string& text) {
        return complaint(folder, [&] { static_cast<void>(read(text)); });
    };
    CHECK(complaint_about(R"({"model": "measured"})") == "m.json: key \"file\": missing");
    CHECK(complaint_about(R"({"model": "measured", "file": "no.csv"})") ==
          "m.json: key \"file\": no.csv: no such file");
    CHECK(complaint_about(R"({"model": "measured", "file": "gold.csv", "format": "ply"})")
              .find("must be one of merl") != std::string::npos);
    CHECK(complaint_about(R"({"model": "measured", "file": "gold.csv", "wavelengths_um": [0]})")
              .find("wavelengths_um") != std::string::npos);
    CHECK(complaint_about(R"({"model": "measured", "file": "gold.csv", "index": 1})").find("not known") !=
          std::string::npos);
}

TEST_CASE("what hts eval writes is a file of points") {
    const std::string text =
        "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,directional_diffuse,brdf\n"
        "0.6,30,0,30,180,9,0.25\n0.5,30,0,30,180,9,0.5\n0.5,30,0,60,180,9,0.125\n0.6,30,0,60,180,9,0.75\n";
    const auto points = points_of_csv(text, "p.csv");
    CHECK(points.wavelengths.micrometres()[0] == 0.5);
    REQUIRE(points.angles.size() == 2);
    const auto brdf = brdf_from("p.csv", points).brdf;
    std::vector<double> values(2);
    brdf.brdf({Direction::from_degrees(30, 0), Direction::from_degrees(45, 180)}, values);
    CHECK(values[0] == Approx(0.3125));
    CHECK(values[1] == Approx(0.5));
    CHECK_THROWS_WITH(
        points_of_csv("wavelength_um,theta_i_deg,theta_r_deg,phi_r_deg,brdf\n0.5,1,1,0,1\n0.6,1,2,0,1\n",
                      "p"),
        Catch::Contains("1 of 2 wavelengths"));
}
