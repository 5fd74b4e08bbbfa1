#include "spectral/models/reflectance.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include <omp.h>
#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"

using hts::Direction;
using hts::Stokes;
using hts::Surface;
using hts::Tolerance;
using hts::spectral::DiffuseAlbedo;
using hts::spectral::DirectionPair;
using hts::spectral::Evaluator;
using hts::spectral::Material;
using hts::spectral::OutsideRange;
using hts::spectral::Reflectance;
using hts::spectral::WavelengthGrid;

namespace {

const Surface surface{0.28, 1.77};
constexpr Tolerance exactly{hts::accuracy::finest_tolerance};

Material rough_aluminium(double albedo = 0) {
    return hts::spectral::he_torrance_material(
        "rough aluminium", surface, hts::spectral::built_in_optical_constants("Al"), DiffuseAlbedo{albedo});
}

const DirectionPair forward{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};

std::vector<DirectionPair> fan_of_pairs() {
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < 300; ++i) {
        pairs.push_back(
            {Direction::from_degrees(i % 90, 17 * i), Direction::from_degrees((7 * i) % 91, 5 * i)});
    }
    return pairs;
}

}  // namespace

TEST_CASE("a spectrum is the model at each wavelength") {
    const auto grid = WavelengthGrid::linear(0.38, 0.78, 41);
    const Reflectance reflectance = rough_aluminium(0.2).at(grid, {.tolerance = exactly});
    const auto aluminium = hts::spectral::built_in_optical_constants("Al");
    const auto brdf = reflectance.brdf(forward);
    const auto lobe = reflectance.directional_diffuse(forward);
    const auto uniform = reflectance.uniform_diffuse();
    const auto specular = reflectance.specular_reflectance(forward.in);
    REQUIRE(brdf.size() == 41);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const auto index = aluminium.index(grid[i]);
        const hts::View in = view(surface, forward.in);
        const hts::PairFactors pair{surface, in, view(surface, forward.out)};
        const double expected = hts::directional_diffuse(pair, grid[i], index).brdf;
        CHECK(lobe[i] == expected);
        CHECK(uniform[i] == hts::uniform_diffuse(0.2));
        CHECK(brdf[i] == expected + uniform[i]);
        CHECK(specular[i].value() == hts::specular_reflectance(surface, in, grid[i], index).value());
    }
}

TEST_CASE("many pairs give the same bits as one at a time, on any number of threads") {
    for (const double tolerance : {1e-12, 1e-6, 1e-3}) {
        const Reflectance reflectance =
            rough_aluminium().at(WavelengthGrid::linear(0.38, 0.78, 7), {.tolerance = Tolerance{tolerance}});
        const auto pairs = fan_of_pairs();
        std::vector<double> serial;
        for (const DirectionPair& pair : pairs) {
            const auto spectrum = reflectance.brdf(pair);
            serial.insert(serial.end(), spectrum.begin(), spectrum.end());
        }
        for (const int threads : {1, 2, 3}) {
            omp_set_num_threads(threads);
            std::vector<double> parallel(serial.size());
            reflectance.brdf(pairs, parallel);
            INFO("tolerance " << tolerance << ", " << threads << " threads");
            CHECK(std::memcmp(parallel.data(), serial.data(), serial.size() * sizeof(double)) == 0);
        }
    }
}

TEST_CASE("a coarser tolerance is met, with and without polarisation") {
    const auto grid = WavelengthGrid::linear(0.38, 0.78, 7);
    const Reflectance exact = rough_aluminium(0.2).at(grid, {.tolerance = exactly});
    const Reflectance by_default = rough_aluminium(0.2).at(grid);
    CHECK(by_default.brdf(forward) ==
          rough_aluminium(0.2).at(grid, {.tolerance = Tolerance{1e-6}}).brdf(forward));
    for (const double tolerance : {1e-6, 1e-3}) {
        const Reflectance fast = rough_aluminium(0.2).at(grid, {.tolerance = Tolerance{tolerance}});
        std::vector<double> brdf(grid.size());
        std::vector<hts::Mueller> mueller(grid.size());
        for (const DirectionPair& pair : fan_of_pairs()) {
            fast.brdf(pair, brdf);
            fast.mueller(pair, mueller);
            const auto expected = exact.brdf(pair);
            const auto expected_mueller = exact.mueller(pair);
            for (std::size_t i = 0; i < grid.size(); ++i) {
                CHECK(brdf[i] == Approx(expected[i]).epsilon(tolerance));
                CHECK(mueller[i](0, 0) == Approx(expected[i]).epsilon(tolerance));
                CHECK(mueller[i](1, 2) ==
                      Approx(expected_mueller[i](1, 2)).epsilon(tolerance).margin(tolerance * expected[i]));
            }
        }
        CHECK(fast.bytes() > exact.bytes());
    }
}

TEST_CASE("a result of the wrong size is refused") {
    const Reflectance reflectance =
        rough_aluminium().at(WavelengthGrid::linear(0.38, 0.78, 7), {.tolerance = exactly});
    const auto pairs = fan_of_pairs();
    std::vector<double> result(12);
    CHECK_THROWS_WITH(reflectance.brdf(pairs, result),
                      "brdf: result has 12 values: must be pairs x wavelengths = 2100");
    CHECK_THROWS_WITH(reflectance.brdf(forward, result),
                      "brdf: result has 12 values: must be wavelengths = 7");
    std::vector<hts::Mueller> matrices(1);
    CHECK_THROWS_WITH(reflectance.mueller(forward, matrices),
                      "mueller: result has 1 values: must be wavelengths = 7");
}

TEST_CASE("polarised reflection adds up to the BRDF") {
    const Reflectance reflectance =
        rough_aluminium(0.3).at(WavelengthGrid::linear(0.4, 0.7, 4), {.tolerance = exactly});
    const auto brdf = reflectance.brdf(forward);
    const auto mueller = reflectance.mueller(forward);
    const auto of_lobe = reflectance.directional_diffuse_mueller(forward);
    const auto lobe = reflectance.directional_diffuse(forward);
    const auto specular = reflectance.specular_reflectance(forward.in);
    const auto specular_mueller = reflectance.specular_mueller(forward.in);
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        CHECK(mueller[i](0, 0) == Approx(brdf[i]).epsilon(1e-13));
        CHECK((mueller[i] * Stokes::unpolarised()).intensity() == Approx(brdf[i]).epsilon(1e-13));
        CHECK(of_lobe[i](0, 0) == Approx(lobe[i]).epsilon(1e-13));
        CHECK(of_lobe[i](2, 2) == mueller[i](2, 2));
        CHECK((of_lobe[i] * Stokes::s_polarised()).degree_of_polarisation() == Approx(1).epsilon(1e-13));
        const Stokes lit = mueller[i] * Stokes::s_polarised();
        CHECK(lit.degree_of_polarisation() < 1);  // the uniform-diffuse term depolarises
        CHECK(lit.degree_of_polarisation() > 0.1);
        CHECK(specular_mueller[i](0, 0) == Approx(specular[i].value()).epsilon(1e-13));
    }
}

TEST_CASE("the specular term grows and the lobe fades with wavelength") {
    const Reflectance reflectance =
        rough_aluminium().at(WavelengthGrid::linear(0.5, 8, 16), {.tolerance = exactly});
    const auto specular = reflectance.specular_reflectance(Direction::from_degrees(10, 0));
    for (std::size_t i = 1; i < specular.size(); ++i) CHECK(specular[i].value() > specular[i - 1].value());
}

TEST_CASE("wavelengths beyond the optical constants are refused unless clamped") {
    const Material tungsten = hts::spectral::he_torrance_material(
        "tungsten", Surface{0.1, 1}, hts::spectral::built_in_optical_constants("W"));
    const auto visible = WavelengthGrid::linear(0.4, 0.7, 4);
    CHECK_THROWS_AS(tungsten.at(visible), hts::Error);
    const Reflectance clamped = tungsten.at(visible, {.outside = OutsideRange::hold});
    CHECK(clamped.brdf(forward)[0] > 0);
}

TEST_CASE("the albedo of polarised light is that of its Mueller matrix over the hemisphere") {
    const Reflectance reflectance = rough_aluminium(0.2).at(WavelengthGrid::from_micrometres({0.5, 3}));
    double worst = 0;
    for (const double theta : {0.0, 35.0, 70.0, 85.0}) {
        const auto in = Direction::from_degrees(theta, 20);
        for (std::size_t i = 0; i < reflectance.size(); ++i) {
            const auto s = reflectance.albedo(in, i, Stokes::s_polarised());
            const auto p = reflectance.albedo(in, i, Stokes::p_polarised());
            const auto both = reflectance.albedo(in, i);
            CHECK(std::abs((s.total() + p.total()) / 2 - both.total()) < 1e-7);
            CHECK(reflectance.albedo(in, i, Stokes::unpolarised()).total() ==
                  Approx(both.total()).epsilon(1e-7));
            CHECK(s.uniform_diffuse == both.uniform_diffuse);
            // by the way of every model that has Mueller matrices
            const auto by_matrices =
                reflectance.evaluator().Evaluator::albedo(in, i, Stokes{1, -0.3, 0.4, 0.5});
            const auto direct = reflectance.albedo(in, i, Stokes{1, -0.3, 0.4, 0.5});
            worst = std::max(worst, std::abs(by_matrices.total() - direct.total()));
        }
    }
    std::printf("albedo of polarised light, by the lobe's integral and by matrices: worst difference %.2g\n",
                worst);
    CHECK(worst < 1e-6);
    const Reflectance unpolarised =
        hts::spectral::material_from_text(R"({"name": "w", "model": "lambert", "diffuse_albedo": 0.5})",
                                          "w.json")
            .at(WavelengthGrid::from_micrometres({0.5}));
    CHECK_THROWS_AS(unpolarised.albedo(Direction::from_degrees(0, 0), 0, Stokes::s_polarised()), hts::Error);
}
