#include "tables/formats/mitsuba/rgl.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "hts/sampling/random.hpp"
#include "materials.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/bilinear_warp.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/specular_box.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;
using hts::tables::testing::rough_surface;
using hts::testing::exhaustive;
using hts::testing::TemporaryFolder;
using hts::testing::WorstCase;
namespace fs = std::filesystem;

const auto two = spectral::WavelengthGrid::from_micrometres({0.45, 0.65});

struct Surface4 {
    const char* name;
    spectral::Reflectance brdf;
};

std::vector<Surface4> surfaces(const spectral::WavelengthGrid& grid) {
    return {{"aluminium 0.28, 1.77", rough_surface("Al", 0.28, 1.77, 0, grid)},
            {"ceramic 1.45, 13.2, a 0.9", rough_surface("Al2O3", 1.45, 13.2, 0.9, grid)},
            {"fine 0.05, 1.0", rough_surface("Al", 0.05, 1.0, 0, grid)},
            {"very rough 2.5, 16", rough_surface("Al", 2.5, 16, 0, grid)}};
}

/// The file by hand: every map from the format's description, a trusted truth for a warp that does nothing.
TensorFileWriter lambertian_file(std::size_t phis) {
    TensorFileWriter file;
    std::vector<float> azimuths;
    for (std::size_t i = 0; i < phis; ++i)
        azimuths.push_back(static_cast<float>(
            (2.0 * static_cast<double>(i) / static_cast<double>(phis - 1) - 1) * std::numbers::pi));
    file.add("description", "by hand");
    file.add("jacobian", {1}, std::vector<std::uint8_t>{1});
    file.add("theta_i", {2}, std::vector<float>{0, 1.5F});
    file.add("phi_i", {phis}, azimuths);
    file.add("wavelengths", {2}, std::vector<float>{450, 650});
    file.add("ndf", {2, 2}, std::vector<float>(4, 2));
    file.add("sigma", {2, 2}, std::vector<float>(4, 0.25F));
    file.add("vndf", {phis, 2, 2, 2}, std::vector<float>(phis * 8, 3));
    file.add("luminance", {phis, 2, 2, 2}, std::vector<float>(phis * 8, 7));
    std::vector<float> spectra(phis * 16, 0.5F);
    for (std::size_t p = 0; p < phis; ++p)
        for (std::size_t i = 0; i < 4; ++i) spectra[p * 16 + 4 + i] = 0.25F;  // theta_i = 0, 650 nm
    file.add("spectra", {phis, 2, 2, 2, 2}, spectra);
    return file;
}

/// Mean of f cos/pdf and the share of draws above the horizon.
double mean_weight(const RglBrdf& brdf, const Direction& in, std::size_t draws) {
    Random random{3};
    std::vector<double> values(brdf.wavelengths().size());
    double sum = 0;
    for (std::size_t i = 0; i < draws; ++i) {
        const double u1 = random.uniform(), u2 = random.uniform();
        const auto draw = brdf.sample(in, u1, u2);
        if (!(draw.density > 0)) continue;
        const Direction out = Direction::from_unit_vector(draw.out);
        brdf.brdf({in, out}, values);
        sum += values[0] * out.cos_theta() / draw.density;
    }
    return sum / static_cast<double>(draws);
}

}  // namespace

TEST_CASE("the warp of a bilinear density is its inverse distribution") {
    // density (1 + x)(1 + 2y) and 1 + xy, whose distributions are polynomials
    const std::vector<float> slices{1, 2, 3, 6, 1, 1, 1, 2};
    const BilinearWarp warp{slices, 2, 2};
    Random random{5};
    WorstCase there{"warp, by quadrature", 3e-6}, back{"warp and back", 3e-6};
    for (int i = 0; i < 3000; ++i) {
        const Point2 u{static_cast<float>(random.uniform()), static_cast<float>(random.uniform())};
        const auto where = [&] { return std::to_string(u.x) + ", " + std::to_string(u.y); };
        const auto product = warp.sample(u, slice_mix({0, 0}, {0, 0}, 1, 2));
        const double x = product.point.x, y = product.point.y;
        there.note(std::abs((y + y * y) / 2 - u.y), where);
        there.note(std::abs((x + x * x / 2) / 1.5 - u.x), where);
        there.note(std::abs((1 + x) * (1 + 2 * y) / 3 - product.density) / 2, where);
        const float weight = static_cast<float>(i % 5) / 5;
        const SliceMix mix = slice_mix({0, 0}, {0, weight}, 1, 2);
        const auto mixed = warp.sample(u, mix);
        const auto again = warp.inverse(mixed.point, mix);
        back.note(std::abs(again.point.x - u.x), where);
        back.note(std::abs(again.point.y - u.y), where);
        back.note(std::abs(again.density - mixed.density) / 4, where);
        back.note(std::abs(warp.density(mixed.point, mix) - mixed.density) / 4, where);
    }
    there.check();
    back.check();
}

TEST_CASE("a file by hand is read as its description says") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-hand.bsdf";
    for (const std::size_t phis : {std::size_t{2}, std::size_t{5}}) {  // isotropic; anisotropic
        spectral::write_file(path.string(), lambertian_file(phis).bytes());
        const auto brdf = read_rgl(path);
        const double theta = 0.6;
        const DirectionPair pair{Direction::from_angles(theta, 1), Direction::from_degrees(70, 200)};
        std::vector<double> values(2);
        brdf->brdf(pair, values);
        const double scale = 2 / (4 * 0.25), cosine = pair.out.cos_theta();
        CHECK(values[0] == Approx(scale * 0.5 / cosine).epsilon(1e-6));
        CHECK(values[1] == Approx(scale * (0.25 + 0.25 * theta / 1.5) / cosine).epsilon(1e-6));
        // a uniform density over the square: 1/(2 pi^2 u sin(theta_m) 4 (w_i.m))
        const Vector3 sum = pair.in.vector() + pair.out.vector();
        const double length = std::sqrt(dot(sum, sum)), theta_m = std::acos(sum.z / length);
        const double u = std::sqrt(2 * theta_m / std::numbers::pi);
        CHECK(brdf->density(pair) ==
              Approx(1 / (2 * std::numbers::pi * std::numbers::pi * u * std::sin(theta_m) * 4 * (length / 2)))
                  .epsilon(1e-5));
        CHECK(brdf->wavelengths().micrometres()[1] == Approx(0.65));
    }
}

TEST_CASE("what Mitsuba and pbrt would refuse is refused by name") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-bad.bsdf";
    const auto refused = [&](const char* field, const TensorShape& shape, const std::vector<float>& numbers,
                             const std::string& message) {
        TensorFileWriter file;
        const TensorFile good = TensorFile::parse(lambertian_file(2).bytes(), "good");
        for (const char* name :
             {"theta_i", "phi_i", "wavelengths", "ndf", "sigma", "vndf", "luminance", "spectra"}) {
            const bool is_it = std::string{field} == name;
            if (is_it && numbers.empty()) continue;
            const auto kept = good.floats(name, good.shape(name).size());
            file.add(name, is_it ? shape : kept.shape, is_it ? numbers : kept.numbers);
        }
        file.add("description", "x");
        file.add("jacobian", {1}, std::vector<std::uint8_t>{1});
        spectral::write_file(path.string(), file.bytes());
        CHECK_THROWS_WITH(read_rgl(path),
                          Catch::Contains("hts-rgl-bad.bsdf: field \"" + std::string{field} + "\": ") &&
                              Catch::Contains(message));
    };
    refused("vndf", {}, {}, "is missing");
    refused("theta_i", {2}, {1, 0.5F}, "must increase");
    refused("theta_i", {2}, {0, 2}, "2: must be from 0 to");
    refused("wavelengths", {2}, {0, 500}, "0: must be from 1");
    refused("ndf", {1, 2}, {1, 1}, "at least 2 rows");
    refused("sigma", {2, 2}, {1, 1, 0, 1}, "0: must be >= ");
    refused("vndf", {2, 2, 2, 2}, std::vector<float>(16, 0), "slice 0 has no positive integral");
    refused("vndf", {2, 2, 3, 3}, std::vector<float>(36, 3e38F), "slice 0 has no positive integral");
    refused("luminance", {2, 2, 2, 2}, std::vector<float>(16, -1), "-1: must be >= 0");
    refused("luminance", {2, 2, 3, 3}, std::vector<float>(36, 1), "as many rows and columns as spectra");
    refused("spectra", {2, 1, 2, 2, 2}, std::vector<float>(16, 1), "does not have the shape");
    CHECK_THROWS_WITH(read_rgl("/nowhere/x.bsdf"), Catch::Contains("/nowhere/x.bsdf: no such file"));
}

TEST_CASE("surfaces survive an RGL file") {
    // As fine as it must be, at 1e5 pairs of three seeds, takes minutes; a quarter of the
    // resolution shows the same at less.
    const bool full = exhaustive();
    const auto grid = full ? spectral::WavelengthGrid::linear(0.38, 0.78, 31) : two;
    WorstCase error{"RGL, of the peak", full ? tables::accuracy::rgl : 0.2};
    WorstCase typical{"RGL, 99 % of pairs, of the peak", full ? 0.007 : 0.035};
    WorstCase integral{"RGL, integral of the density from 1", full ? 0.0035 : 0.006};
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-surfaces.bsdf";
    for (const Surface4& surface : surfaces(grid)) {
        if (full)
            write_rgl(surface.brdf, path);
        else
            write_rgl(surface.brdf, path, {24, 32, 65, 128});
        const spectral::Reflectance read{read_rgl(path)};
        const auto seeds = full ? std::vector<std::uint64_t>{7, 2027, 990017} : std::vector<std::uint64_t>{7};
        for (const std::uint64_t seed : seeds) {
            const RoundTrip trip = round_trip(surface.brdf, read, {full ? 100'000U : 4'000U, seed});
            if (full) WARN(surface.name << ", " << fs::file_size(path) << " bytes\n" << trip.text());
            error.note(trip.worst.error, [&] { return surface.name; });
            typical.note(trip.percentile_99, [&] { return surface.name; });
            REQUIRE(trip.density.size() == 7);
            for (const DensityIntegral& each : trip.density)
                integral.note(std::abs(each.integral - 1), [&] {
                    return std::string{surface.name} + " at " + std::to_string(each.theta_i);
                });
            for (const AlbedoError& each : trip.albedo)
                CHECK(each.read_back == Approx(each.original).margin(full ? 0.01 : 0.05));
        }
    }
    error.check();
    typical.check();
    integral.check();
}

TEST_CASE("directions drawn from an RGL file weigh what is reflected") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-draws.bsdf";
    const auto aluminium = brdf_of("rough-aluminium.json", two);
    write_rgl(aluminium, path, {24, 32, 65, 128});
    const std::shared_ptr<const RglBrdf> read = read_rgl(path);
    const RoundTrip trip = round_trip(aluminium, spectral::Reflectance{read}, {100, 1});
    for (const AlbedoError& each : trip.albedo) {
        if (each.theta_i > 1.2) continue;
        const double drawn = mean_weight(*read, Direction::from_angles(each.theta_i, 0.4), 20'000);
        const double integrated =
            each.wavelength_um < 0.5 ? each.read_back : each.original;  // of 0.45 um, to 2 %
        CHECK(drawn == Approx(integrated).epsilon(0.03));
    }
}

TEST_CASE("no number of an RGL file is negative, nor is what readers make of it up to the horizon") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-horizon.bsdf";
    const auto aluminium = brdf_of("rough-aluminium.json", two);
    write_rgl(aluminium, path, {24, 32, 65, 128});
    const TensorFile file = TensorFile::read(path);
    for (const char* name : {"ndf", "sigma", "vndf", "luminance", "spectra"}) {
        const auto numbers = file.floats(name, file.shape(name).size()).numbers;
        CHECK(*std::min_element(numbers.begin(), numbers.end()) >= 0);
    }
    // between nodes, where a slope taken for the whole cell would fall below 0; f
    // cos(theta_o) to a part of its peak
    const auto read = read_rgl(path);
    Random random{11};
    std::vector<double> expected(2), found(2);
    WorstCase horizon{"RGL, f cos(theta_o) from 85 to 90 degrees, of its peak", 0.03};
    for (const double theta : {10., 37., 61., 80.}) {
        const Direction in = Direction::from_degrees(theta, 0);
        double peak = 0;
        for (double view = 0; view < 90; view += 1) {
            const Direction out = Direction::from_degrees(view, 180);
            aluminium.brdf({in, out}, expected);
            peak = std::max(peak, expected[0] * out.cos_theta());
        }
        for (int i = 0; i < 200; ++i) {
            const Direction out = Direction::from_degrees(85 + 5 * random.uniform(), 360 * random.uniform());
            aluminium.brdf({in, out}, expected);
            read->brdf({in, out}, found);
            horizon.note(std::abs(found[0] - expected[0]) * out.cos_theta() / peak,
                         [&] { return std::to_string(theta); });
        }
    }
    horizon.check();
}

TEST_CASE("a specular term spread over facets survives in an RGL file and in what is drawn from it") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-box.bsdf";
    const auto fine = brdf_of("fine-aluminium.json", two);
    for (const double solid_angle : {1e-4, 1e-3}) {
        write_rgl(with_specular_lobe(fine, solid_angle), path, {48, 64, 33, 512}, solid_angle);
        const std::shared_ptr<const RglBrdf> read = read_rgl(path);
        WorstCase albedo{"RGL, reflectance with the specular term", 0.005};
        for (const double theta : {0.5, 33., 52., 80.}) {
            const Direction in = Direction::from_degrees(theta, 30);
            const double truth = fine.albedo(in, 0).total();
            albedo.note(std::abs(mean_weight(*read, in, 40'000) - truth),
                        [&] { return std::to_string(theta); });
        }
        albedo.check();
    }
}

TEST_CASE("an RGL file does not depend on the number of threads, and reads the same from any azimuth") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-turned.bsdf";
    const auto aluminium = brdf_of("rough-aluminium.json", two);
    write_rgl(aluminium, path, {6, 8, 9, 16});
    const auto read = read_rgl(path);
    std::vector<double> here(2), there(2);
    for (const double turn : {90., 200., 359.}) {
        read->brdf({Direction::from_degrees(40, 0), Direction::from_degrees(50, 150)}, here);
        read->brdf({Direction::from_degrees(40, turn), Direction::from_degrees(50, 150 + turn)}, there);
        for (std::size_t k = 0; k < 2; ++k) CHECK(there[k] == Approx(here[k]).epsilon(1e-4));
    }
    read->brdf({Direction::from_degrees(90, 0), Direction::from_degrees(50, 150)}, here);
    CHECK(here == std::vector<double>{0, 0});
}

TEST_CASE("anisotropic surfaces are read back, their light over a full turn") {
    const TemporaryFolder folder;
    const auto path = folder / "hts-rgl-brushed.bsdf";
    const auto brushed =
        brdf_of("brushed-aluminium.json", spectral::WavelengthGrid::from_micrometres({0.55}));
    REQUIRE_FALSE(brushed.properties().isotropic);
    write_rgl(brushed, path, {18, 48, 65, 128, 17});
    const spectral::Reflectance read{std::shared_ptr<const RglBrdf>{read_rgl(path)}};
    CHECK_FALSE(read.properties().isotropic);
    // of draws from the lobe, lights up to 60 deg; the coarse file is at its worst in the flanks of the lobe
    WorstCase worst{"RGL file of brushed aluminium, of the peak", 0.1};
    std::vector<double> errors;
    const auto sampler = brushed.evaluator().sampler(0);
    Random random{5};
    for (int i = 0; i < 3000; ++i) {
        const Direction in = Direction::from_degrees(random.uniform(0, 60), random.uniform(-180, 180));
        const Draw drawn = sampler->draw(in, random.uniforms());
        if (drawn.lobe != Lobe::directional_diffuse || drawn.out.cos_theta() < 0.2) continue;
        double original = 0, there = 0;
        brushed.brdf({in, drawn.out}, {&original, 1});
        read.brdf({in, drawn.out}, {&there, 1});
        const double peak = lobe_peaks(brushed, in, 0.01, 1.5).front();
        errors.push_back(std::abs(there - original) / peak);
        worst.note(errors.back(), [&] { return "draw " + std::to_string(i); });
    }
    worst.check();
    std::sort(errors.begin(), errors.end());
    CHECK(errors[errors.size() * 99 / 100] < 0.06);
}

TEST_CASE("senseless resolutions are refused") {
    const auto aluminium = brdf_of("rough-aluminium.json", two);
    CHECK_THROWS_WITH(write_rgl(aluminium, "/nowhere/x.bsdf", {1, 8, 9, 16}),
                      Catch::Contains("number of angles of incidence 1"));
    CHECK_THROWS_WITH(write_rgl(aluminium, "/nowhere/x.bsdf", {2, 2, 2, 8}),
                      Catch::Contains("/nowhere/x.bsdf"));
}
