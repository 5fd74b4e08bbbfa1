#include "tables/formats/mitsuba/pbsdf.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "materials.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/specular_box.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::tables;
using hts::tables::testing::brdf_of;
using hts::testing::exhaustive;
using hts::testing::WorstCase;
namespace fs = std::filesystem;

const auto five = spectral::WavelengthGrid::linear(0.45, 0.65, 5);
constexpr PbsdfResolution small{9, 10, 13};

/// A surface of the given constant index.
spectral::Reflectance surface(double n, double k, double albedo) {
    return spectral::he_torrance_material("surface", {0.28, 1.77},
                                          spectral::OpticalConstants::constant({n, k}),
                                          spectral::DiffuseAlbedo{albedo})
        .at(five, {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
}

/// Written, and the raw arrays read.
class Written {
    [[nodiscard]] static spectral::Reflectance written(const spectral::Reflectance& brdf,
                                                       const fs::path& path,
                                                       const PbsdfResolution& resolution) {
        write_pbsdf(brdf, path, resolution);
        return read_pbsdf(path);
    }

    hts::testing::TemporaryFolder folder_;
    fs::path path_;

  public:
    Written(const spectral::Reflectance& brdf, const PbsdfResolution& resolution)
        : path_{folder_.path() / "test.pbsdf"}, read{written(brdf, path_, resolution)} {
        const TensorFile file = TensorFile::read(path_);
        theta_h = file.floats("theta_h", 2).numbers;
        theta_d = file.floats("theta_d", 2).numbers;
        phi_d = file.floats("phi_d", 2).numbers;
        matrices = file.floats("M", 6).numbers;
    }

    /// An element at a node and the first wavelength.
    [[nodiscard]] double element(std::size_t p, std::size_t d, std::size_t h, std::size_t e) const {
        return static_cast<double>(matrices[((p * theta_d.size() + d) * theta_h.size() + h) * 80 + e]);
    }
    /// Light and view of a node, both frames of the format spelled out; null where one is below the horizon.
    [[nodiscard]] std::optional<DirectionPair> pair(std::size_t p, std::size_t d, std::size_t h) const {
        const double th = theta_h[h], td = theta_d[d], pd = phi_d[p];
        const Vector3 half{std::sin(th), 0, std::cos(th)};
        const Vector3 towards{std::cos(pd) * std::cos(th), std::sin(pd), -std::cos(pd) * std::sin(th)};
        const Vector3 light = std::cos(td) * half + std::sin(td) * towards;
        const Vector3 view = std::cos(td) * half - std::sin(td) * towards;
        if (light.z < 0.01 || view.z < 0.01) return std::nullopt;
        return DirectionPair{Direction::from_vector(light), Direction::from_vector(view)};
    }

    std::vector<float> theta_h, theta_d, phi_d, matrices;
    spectral::Reflectance read;
};

using Complex = std::complex<double>;

/// Mitsuba's matrix of a facet in the frame of its own plane: [[A, B, 0, 0], [B, A, 0, 0], [0, 0, C cos, -C
/// sin], [0, 0, C sin, C cos]], normalised to A = 1, of the textbook's amplitudes for
/// n + ik, exp(-i omega t).
std::array<double, 16> facet_matrix(Complex index, double theta_d) {
    const double c1 = std::cos(theta_d);
    const Complex c2 = std::sqrt(1.0 - std::pow(std::sin(theta_d) / index, 2));
    const Complex s = (c1 - index * c2) / (c1 + index * c2), p = (index * c1 - c2) / (index * c1 + c2);
    const double a = (std::norm(s) + std::norm(p)) / 2, b = (std::norm(s) - std::norm(p)) / 2;
    const Complex cross = p * std::conj(s);  // Verdet's r_p, and exp(+i omega t): the phase changes sign
    const double re = cross.real() / a, im = -cross.imag() / a;
    return {1, b / a, 0, 0, b / a, 1, 0, 0, 0, 0, re, -im, 0, 0, im, re};
}

}  // namespace

TEST_CASE("the matrix that Mitsuba gives gold at 60 degrees stands in the file") {
    // computed with NIST's SCATMECH and turned into Mitsuba's convention: n = 0.183 + 3.43i,
    // in the plane of incidence
    const std::array<double, 16> expected{1, 0.035982,  0,         0, 0.035982, 1,        0,        0, 0,
                                          0, -0.695831, -0.717304, 0, 0,        0.717304, -0.695831};
    const auto formula = facet_matrix({0.183, 3.43}, std::numbers::pi / 3);
    for (std::size_t e = 0; e < 16; ++e) CHECK(formula[e] == Approx(expected[e]).margin(1e-6));
}

TEST_CASE("nodes hold Fresnel's matrix of the facet in the plane of light and view") {
    // A facet of a He-Torrance surface mirrors like a flat one, so every matrix, also out of the plane of
    // incidence, has the form above; conductors turn linear into circular light, so no
    // sign of S2 or S3 can hide.
    const Complex index{0.183, 3.43};
    const auto gold = surface(index.real(), index.imag(), 0);
    const Written file{gold, small};
    WorstCase worst{"pbsdf, nodes against Fresnel's formula, of m00", 1e-5};
    for (std::size_t p = 0; p < file.phi_d.size(); ++p) {
        for (std::size_t d = 0; d < file.theta_d.size(); ++d) {
            for (std::size_t h = 0; h < file.theta_h.size(); ++h) {
                if (!file.pair(p, d, h)) continue;
                const double m00 = file.element(p, d, h, 0);
                if (!(m00 > 1e-30)) continue;
                const auto expected = facet_matrix(index, static_cast<double>(file.theta_d[d]));
                for (std::size_t e = 0; e < 16; ++e)
                    worst.note(std::abs(file.element(p, d, h, e) / m00 - expected[e]), [&] {
                        return "element " + std::to_string(e) + ", node " + std::to_string(p) + " " +
                               std::to_string(d) + " " + std::to_string(h);
                    });
            }
        }
    }
    worst.check();
    CHECK(worst.count() > 16 * 300);
}

TEST_CASE("at nodes the reader gives the engine's Mueller matrix") {
    const auto plastic = surface(1.5, 0, 0.4);
    const auto gold = surface(0.183, 3.43, 0.1);
    const std::array<Stokes, 4> lights{Stokes{1, 0, 1, 0}, Stokes{1, 0, 0, 1}, Stokes{1, 0.6, -0.8, 0},
                                       Stokes{1, 0, 0.6, -0.8}};  // diagonal, circular and between
    WorstCase elements{"pbsdf at nodes against the engine, of m00", 1e-5};
    WorstCase stokes{"pbsdf at nodes, diagonal and circular light, of m00", 2e-5};
    std::vector<Mueller> expected(5), found(5);
    for (const auto& brdf : {plastic, gold}) {
        const Written file{brdf, small};
        for (std::size_t p = 0; p < file.phi_d.size(); ++p)
            for (std::size_t d = 1; d < file.theta_d.size(); ++d)
                for (std::size_t h = 1; h < file.theta_h.size(); ++h) {
                    const auto pair = file.pair(p, d, h);
                    if (!pair) continue;
                    brdf.mueller(*pair, expected);
                    file.read.mueller(*pair, found);
                    const double m00 = expected[2](0, 0);
                    const auto where = [&] {
                        return std::to_string(p) + " " + std::to_string(d) + " " + std::to_string(h);
                    };
                    for (std::size_t e = 0; e < 16; ++e)
                        elements.note(std::abs(found[2].elements()[e] - expected[2].elements()[e]) / m00,
                                      where);
                    for (const Stokes& light : lights)
                        for (std::size_t i = 0; i < 4; ++i)
                            stokes.note(std::abs((found[2] * light)[i] - (expected[2] * light)[i]) / m00,
                                        where);
                }
    }
    elements.check();
    stokes.check();
}

TEST_CASE("between nodes a polarised file is near the engine, and total") {
    const bool full = exhaustive();
    const auto aluminium = brdf_of("rough-aluminium.json", five);
    const Written file{aluminium, full ? PbsdfResolution{} : PbsdfResolution{31, 31, 25}};
    const RoundTrip trip = round_trip(aluminium, file.read, {full ? 100'000U : 4'000U, 3});
    if (full) WARN(trip.text());
    REQUIRE(trip.worst_mueller);
    CHECK(trip.median < 0.005);
    CHECK(trip.percentile_99 < 0.1);
    CHECK(trip.worst_mueller->error < 1);
    std::vector<double> values(5);
    std::vector<Mueller> matrices(5);
    for (const double theta : {0., 30., 90.}) {
        const Direction in = Direction::from_degrees(theta, 40);
        for (const Direction& out : {in, in.mirror(), Direction::from_degrees(0, 0)}) {
            file.read.brdf({in, out}, values);
            file.read.mueller({in, out}, matrices);
            for (std::size_t k = 0; k < 5; ++k) {
                CHECK(std::isfinite(values[k]));
                CHECK(matrices[k](0, 0) == Approx(values[k]).margin(1e-12));
                for (const double each : matrices[k].elements()) CHECK(std::isfinite(each));
            }
        }
    }
}

TEST_CASE("what a polarised file cannot hold is refused by name") {
    const auto plastic = brdf_of("smooth-plastic.json", spectral::WavelengthGrid::linear(0.45, 0.65, 4));
    CHECK_THROWS_WITH(write_pbsdf(plastic, "/nowhere/x"),
                      Catch::Contains("number of wavelengths of a .pbsdf file 4: must be 5"));
    const auto odd = brdf_of("smooth-plastic.json", spectral::WavelengthGrid::linear(0.45, 0.6501, 5));
    CHECK_THROWS_WITH(write_pbsdf(odd, "/nowhere/x"), Catch::Contains("a whole number of nanometres"));
    const auto boxed = with_specular_box(brdf_of("smooth-plastic.json", five), 0.01);
    CHECK_THROWS_WITH(write_pbsdf(boxed, "/nowhere/x"), Catch::Contains("has no Mueller matrix"));
    CHECK_THROWS_WITH(write_pbsdf(surface(1.5, 0, 0), "/nowhere/x", {1, 9, 9}),
                      Catch::Contains("number of theta_h 1"));
}

TEST_CASE("a polarised file that is not one is refused by name") {
    const hts::testing::TemporaryFolder folder;
    const auto path = folder / "hts-pbsdf-bad.pbsdf";
    const auto refused = [&](const std::vector<float>& theta_h, const std::vector<std::uint16_t>& wavelengths,
                             std::size_t matrices, const std::string& message) {
        TensorFileWriter file;
        file.add("theta_h", {1, theta_h.size()}, theta_h);
        file.add("theta_d", {1, 1}, std::vector<float>{0});
        file.add("phi_d", {1, 1}, std::vector<float>{0});
        file.add("wvls", {wavelengths.size()}, wavelengths);
        file.add("M", {1, 1, matrices, 5, 4, 4}, std::vector<float>(matrices * 80, 1));
        spectral::write_file(path.string(), file.bytes());
        CHECK_THROWS_WITH(read_pbsdf(path),
                          Catch::Contains("hts-pbsdf-bad.pbsdf: field ") && Catch::Contains(message));
    };
    const std::vector<std::uint16_t> nm{450, 500, 550, 600, 650};
    refused({0, 0}, nm, 2, "\"theta_h\": must increase");
    refused({0, 1}, {450, 500, 550, 600}, 2, "\"wvls\": must be 5");
    refused({0, 1}, {450, 500, 550, 550, 650}, 2, "\"wvls\": must be positive and increase");
    refused({0, 1}, nm, 3, "\"M\": must have a 4 x 4 matrix per");
}
