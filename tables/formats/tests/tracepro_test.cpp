// TracePro's surface properties: what a table says is found where it says it, and what is wrong is named.

#include "tables/formats/points/tracepro.hpp"

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "damaged_files.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;

constexpr const char* head =
    "TracePro Surface Property Data\r\nFile Name\tC:/a.txt\r\nTracePro Release: 7 0 0\r\n"
    "Database Version: 3 3 0\r\nData generated at 01.01.2020 00:00:00\r\n\r\nName\ttest\r\nCatalog\tc\r\n"
    "Description\r\nCoating    1\r\nScatter    5\r\nInteraction    0\r\nPolarization   0\r\nUser_Data  1\r\n"
    "Solve\tBRDF\r\n\r\n";
constexpr const char* surface_columns =
    "Temperature\tWavelength\tIncAngle\tAziAngle\tAbso_S\tAbso_P\tRefl_S\tRefl_P\tTran_S\tTran_P\t"
    "PhaseRefl\tPhaseTran\tBRDF_A\tBRDF_B\tBRDF_By\tBRDF_g\tBRDF_gy\tBTDF_A\tBTDF_B\tBTDF_By\tBTDF_g\t"
    "BTDF_gy\r\n";
constexpr const char* table_columns =
    "Temperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF\t\r\n";

/// A lobe that falls with |beta - beta_0|, brighter on the side away from the normal.
double lobe(double um, double theta, double beta, double azimuth) {
    return um * (1 + 0.01 * theta) * (2.2 - beta) * (1 + 0.3 * std::cos(azimuth * std::numbers::pi / 180));
}

std::string rows(const std::vector<double>& azimuths) {
    std::string text;
    for (const double kelvin : {300., 900.})
        for (const double um : {0.55, 0.65})
            for (double theta = 0; theta <= 80; theta += 20)
                for (double beta = 0; beta <= 2.01; beta += 0.25)
                    for (const double azimuth : azimuths) {
                        const double value = kelvin == 300 ? lobe(um, theta, beta, azimuth) : 7;
                        for (const double number : {kelvin, um, theta, 0., beta, azimuth, value, 0.})
                            text += shortest(number) + "\t";
                        text += "\r\n";
                    }
    return text;
}

std::string table(const std::vector<double>& azimuths, const std::string& surface = "") {
    return head + (surface.empty() ? "" : surface_columns + surface) + "Table_BSDF_Data\r\n" + table_columns +
           rows(azimuths);
}

std::vector<double> all_around() {
    std::vector<double> result;
    for (double azimuth = 0; azimuth < 360; azimuth += 10) result.push_back(azimuth);
    return result;
}

/// Where a pair stands in such a table.
struct Place {
    double beta, azimuth;
};
Place place_of(const DirectionPair& pair) {
    const Vector3 in = pair.in.vector(), out = pair.out.vector();
    const double x = out.x + in.x, y = out.y + in.y, s = std::hypot(in.x, in.y);
    // outwards is where the mirror direction lies from the normal, opposite to the light
    const double along = s > 0 ? -(x * in.x + y * in.y) / s : -x,
                 across = s > 0 ? (x * in.y - y * in.x) / s : -y;
    return {std::hypot(x, y), std::atan2(across, along) * 180 / std::numbers::pi};
}

}  // namespace

TEST_CASE("a table of TracePro is linear between its values, about the mirror direction") {
    const std::string surface =
        "300\t0.55\t0\t0\t0.05\t0.05\t0.1\t0.1\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\r\n";
    for (const bool one_side : {false, true}) {
        std::vector<double> azimuths = all_around();
        if (one_side) azimuths.resize(19);
        const TraceProFile file = tracepro_file(table(azimuths, surface), "t.txt");
        const std::string notes = spectral::joined(file.notes);
        for (const char* part : {"specular reflectance of up to 0.1", "those at 300 K are taken",
                                 "ScatterAzimuth 0 is taken to point away from the normal"})
            CHECK_THAT(notes, Catch::Contains(part));
        CHECK(file.brdf.wavelengths().micrometres()[1] == 0.65);
        CHECK(file.brdf.properties().isotropic);
        Random random{3};
        double worst = 0;
        for (int k = 0; k < 2000; ++k) {
            const DirectionPair pair{random.direction(0.2), random.direction(0.2)};
            const double theta = std::acos(pair.in.cos_theta()) * 180 / std::numbers::pi;
            const Place at = place_of(pair);
            std::vector<double> values(2);
            file.brdf.brdf(pair, values);
            for (std::size_t i : {0U, 1U}) {
                const double expected = lobe(i == 0 ? 0.55 : 0.65, theta, at.beta, at.azimuth);
                worst = std::max(worst, std::abs(values[i] / expected - 1));
            }
        }
        std::cout << "TracePro, azimuths " << azimuths.size() << ": worst " << worst << '\n';
        CHECK(worst < 0.005);  // the cosine between azimuths 10 degrees apart
    }
    // turned about
    const auto turned = tracepro_file(table(all_around()), "t.txt", 180).brdf;
    const DirectionPair outwards{Direction::from_degrees(40, 0), Direction::from_degrees(60, 180)};
    CHECK(turned.brdf(outwards)[0] == Approx(lobe(0.55, 40, place_of(outwards).beta, 180)).epsilon(1e-6));
}

TEST_CASE("a property of TracePro without a table has the coefficients of ABg") {
    std::string text = std::string{head} + surface_columns;
    for (const double theta : {0., 60.})
        text += "300\t0.6328\t" + shortest(theta) +
                "\t0\t0.05\t0.05\t0\t0\t0\t0\t0\t0\t0.001\t0.0001\t0\t2\t0\t0\t0\t0\t0\t0\r\n";
    const TemporaryFolder folder;
    const auto file = read_brdf(folder.write("abg.txt", text));
    CHECK(file.format == "tracepro");
    for (const double view : {10., 29., 31., 75.}) {
        const DirectionPair pair{Direction::from_degrees(30, 15), Direction::from_degrees(view, 195)};
        CHECK(file.brdf.brdf(pair)[0] ==
              Approx(0.001 / (0.0001 + std::pow(place_of(pair).beta, 2))).epsilon(2e-3));
    }
    CHECK(file.brdf.brdf({Direction::from_degrees(30, 0), Direction::from_degrees(30, 180)})[0] ==
          Approx(10));
}

TEST_CASE("what is wrong with a property of TracePro is named with its line") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text, const BrdfReading& how = {}) {
        const auto path = folder.write("t.txt", text);
        return complaint(folder, [&] { static_cast<void>(read_brdf(path, how)); });
    };
    const std::string good = table({0, 90, 180});
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const auto at = text.find(from);
        REQUIRE(at != std::string::npos);
        return message(text.replace(at, from.size(), to));
    };
    CHECK(message(good).empty());
    CHECK(with("300\t0.55\t0\t0\t0.25\t0\t", "300\t0.55\t0\t0\t2.5\t0\t") ==
          "t.txt:22: ScatterBeta 2.5: must be from 0 to 2");
    CHECK(with("300\t0.55\t0\t0\t0.25\t0\t", "300\t0.55\t95\t0\t0.25\t0\t") ==
          "t.txt:22: IncAngle 95: must be from 0 to 90");
    CHECK(with("300\t0.55\t0\t0\t0.25\t0\t", "300\t0.55\t0\tx\t0.25\t0\t").find("t.txt:22: \"x\"") == 0);
    CHECK(with("300\t0.55\t0\t0\t0.25\t0\t", "300\t0.55\t0\t0\t0.25\t") ==
          "t.txt:22: 7 numbers: must be 8, as there are columns");
    CHECK(with("300\t0.55\t0\t0\t0.25\t0\t", "300\t0.55\t0\t0\t0.25\t90\t").find("an earlier row again") !=
          std::string::npos);
    CHECK(with("300\t0.55\t20\t0\t0.25\t0\t", "300\t0.55\t20\t0\t0.26\t0\t").find("values: must be") !=
          std::string::npos);
    CHECK(with("ScatterBeta", "Beta") == "t.txt:18: column ScatterBeta: missing");
    CHECK(message(std::string{head} + "Table_BSDF_Data\r\n" + table_columns) ==
          "t.txt: no values below Table_BSDF_Data");
    CHECK(message(head).find("t.txt: no columns: must have a line") == 0);
    CHECK(message(std::string{head} + surface_columns +
                  "300\t0.6\t0\t0\t1\t1\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\r\n")
              .find("BRDF_A 0: must be > 0 in a file without Table_BSDF_Data") != std::string::npos);
    CHECK(message(good, {.wavelengths = spectral::WavelengthGrid::from_micrometres({0.5})}) ==
          "t.txt: says its wavelengths, which must not be given");

    tables::testing::check_damaged(
        {"TracePro",
         table({0, 180}),
         400,
         {"nan", "-1", "1e308", "1e999", "\t", "\n", std::string(1, '\0'), "\xff", "Table_BSDF_Data",
          "Temperature", "360"},
         [](const std::string& text) {
             const auto brdf = tracepro_file(text, "t").brdf;
             std::vector<double> values(brdf.size());
             brdf.brdf({Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)}, values);
             for (const double value : values)
                 tables::testing::require_sound(value >= 0 && std::isfinite(value));
         }});
}
