// Materials of two correlation lengths: their keys, what they reflect in all, how steep they are, and
// what is refused of them.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <catch2/catch.hpp>

#include "../../energy/tests/hemisphere.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/energy/validity.hpp"
#include "spectral/models/hemisphere.hpp"
#include "spectral/models/material.hpp"
#include "temporary_folder.hpp"

using hts::Direction;
using hts::Surface;
using hts::Wavelength;
using hts::spectral::HemisphericalReflectance;
using hts::spectral::Material;
using hts::spectral::read_material;
using hts::spectral::RoughSurface;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;
const auto one_um = Wavelength::from_micrometres(1);

std::string brushed(const std::string& model, const std::string& lengths, const std::string& more = "") {
    return R"({"model": ")" + model + R"(", "rms_roughness_um": 0.2, "correlation_length_um": )" + lengths +
           R"(, "index": {"n": 1.4, "k": 7.0})" + more + "}";
}

Material material_of(const std::string& text) {
    const TemporaryFolder folder;
    return read_material(folder.write("m.json", text));
}

std::string refusal(const std::string& text) {
    const TemporaryFolder folder;
    return complaint(folder, [&] { static_cast<void>(read_material(folder.write("m.json", text))); });
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Integral of the lobe by panels in polar angle and azimuth that refine towards the mirror direction.
double by_panels(const hts::spectral::Reflectance& of, const Direction& in) {
    using namespace hts::spectral::testing;
    const double theta = std::acos(in.cos_theta());
    const double mirror = std::atan2(in.mirror().sin_phi(), in.mirror().cos_phi());
    std::vector<double> rings = panels_towards(theta, 0, pi / 2, 0.01);
    for (const double end : panels_towards(pi / 2, theta, pi / 2, 1e-4)) rings.push_back(end);
    std::sort(rings.begin(), rings.end());
    // azimuths also evenly, since a long ellipse has ends anywhere
    std::vector<double> sectors = panels_towards(mirror, mirror - pi, mirror + pi, 0.01);
    for (const double end : equal_panels(mirror - pi, mirror + pi, 0.1)) sectors.push_back(end);
    std::sort(sectors.begin(), sectors.end());
    std::vector<double> value(1);
    return panel_sum(rings, [&](double ring) {
        return std::sin(ring) * std::cos(ring) * panel_sum(sectors, [&](double phi) {
                   of.directional_diffuse({in, Direction::from_angles(ring, phi)}, value);
                   return value[0];
               });
    });
}

}  // namespace

TEST_CASE("two correlation lengths are read, with the azimuth of the first") {
    for (const std::string model : {"he", "he_unified"}) {
        const Material read = material_of(brushed(model, "[10, 2.5]", R"(, "azimuth_deg": 30)"));
        const RoughSurface& surface = *read.properties().surface;
        CHECK(surface.correlation_lengths().along == 10);
        CHECK(surface.correlation_lengths().across == 2.5);
        CHECK(surface.azimuth() == Approx(pi / 6).epsilon(1e-15));
        CHECK_FALSE(read.properties().isotropic);
        CHECK_FALSE(read.at(one_um).properties().isotropic);
        CHECK(read.warnings().empty());
        CHECK(material_of(brushed(model, "[3, 3]")).properties().isotropic);
        CHECK(material_of(brushed(model, "[10, 2.5]")).properties().surface->azimuth() == 0);
    }
    CHECK(has(material_of(brushed("he", "[400, 2]")).warnings().at(0),
              "correlation lengths 400 and 2 um: grooves"));
}

TEST_CASE("correlation lengths that cannot be are refused by name") {
    CHECK(has(refusal(brushed("he", "[1]")),
              "key \"correlation_length_um\": must be a number or a list of two"));
    CHECK(has(refusal(brushed("he", "[1, 2, 3]")), "must be a number or a list of two"));
    CHECK(has(refusal(brushed("he", "[1, 0]")),
              "correlation_length_um[2]\": correlation length 0 um: must be > 0"));
    CHECK(has(refusal(brushed("he", "[-1, 1]")), "correlation_length_um[1]\": correlation length -1 um"));
    CHECK(has(refusal(brushed("he", "[\"a\", 1]")), "correlation_length_um[1]\""));
    CHECK(has(refusal(brushed("he", "2", R"(, "azimuth_deg": 30)")),
              "azimuth_deg\": must be left out where correlation_length_um is one number"));
    CHECK(has(refusal(brushed("he", "[1, 2]", R"(, "azimuth_deg": "x")")), "azimuth_deg\""));
    CHECK(has(refusal(brushed("he", "[1, 2]", R"(, "azimuth": 3)")), "\"azimuth\""));
}

TEST_CASE("anisotropic surfaces reflect in all what panels over the hemisphere add up to") {
    WorstCase worst{"albedo of anisotropic surfaces, relative", 2e-6};
    for (const std::string model : {"he", "he_unified"}) {
        for (const std::string lengths : {"[1.5, 3]", "[8, 1]"}) {
            const auto of = material_of(brushed(model, lengths, R"(, "azimuth_deg": 20)"))
                                .at(one_um, {.tolerance = hts::Tolerance{1e-6}});
            for (const auto& [theta, phi] : {std::pair{0., 0.}, {50., 65.}, {75., 20.}}) {
                const Direction in = Direction::from_degrees(theta, phi);
                const HemisphericalReflectance albedo = of.albedo(in, 0);
                worst.note(std::abs(by_panels(of, in) / albedo.directional_diffuse - 1), [&, theta = theta] {
                    return model + " " + lengths + " at " + std::to_string(theta);
                });
                std::vector<double> mirror(1);
                of.specular_reflectance(in, mirror);
                CHECK(albedo.specular == Approx(mirror[0]).epsilon(1e-6));
                // s and p are halves of unpolarised light
                const double s = of.albedo(in, 0, hts::Stokes::s_polarised()).total();
                const double p = of.albedo(in, 0, hts::Stokes::p_polarised()).total();
                CHECK((s + p) / 2 == Approx(albedo.total()).epsilon(1e-6));
            }
            CHECK_THROWS_WITH(of.albedo(Direction::from_degrees(30, 0), 0, hts::Stokes{1, 0, 1, 0}),
                              Catch::Contains("polarised along s or p"));
        }
    }
    worst.check();
}

TEST_CASE("values of a caller make a surface anisotropic, or isotropic again") {
    const Material plain = material_of(brushed("he", "2"));
    const Material two = material_of(brushed("he", "[8, 1]", R"(, "azimuth_deg": 20)"));
    const hts::DirectionPair pair{Direction::from_degrees(30, 10), Direction::from_degrees(40, 200)};
    const auto value = [&](const Material& of, const hts::spectral::RoughSurfaceValues& given) {
        std::vector<double> f(1);
        of.at(one_um, {.instead = given}).brdf(pair, f);
        return f[0];
    };
    const auto axis = Direction::from_degrees(90, 20);
    CHECK(value(plain, {.correlation_length_x = 8, .correlation_length_y = 1, .axis = axis}) ==
          value(two, {}));
    CHECK(value(two, {.correlation_length = 2}) == value(plain, {}));
    CHECK(value(two, {.axis = Direction::from_degrees(90, 110)}) != Approx(value(two, {})).epsilon(0.01));
}

TEST_CASE("slopes of anisotropic surfaces are those of each axis") {
    const Surface s = Surface::anisotropic(0.3, {1, 4}, Direction::from_degrees(90, 25));
    CHECK(hts::spectral::rms_slopes(s).along == Approx(0.3 * std::numbers::sqrt2));
    CHECK(hts::spectral::rms_slopes(s).across == Approx(0.3 / 4 * std::numbers::sqrt2));
    CHECK(hts::spectral::rms_slope(s) == Approx(hts::spectral::rms_slopes(s).along).epsilon(1e-15));
    CHECK(hts::spectral::curvature_radius(s) == hts::spectral::curvature_radius({0.3, 1}));
    // the share beyond 45 degrees by counting slopes drawn from two normal distributions
    hts::Random random{3};
    const auto normal = [&] {
        return std::sqrt(-2 * std::log1p(-random.uniform())) * std::cos(2 * pi * random.uniform());
    };
    const auto [along, across] = hts::spectral::rms_slopes(s);
    int steep = 0;
    constexpr int draws = 400'000;
    for (int i = 0; i < draws; ++i) steep += std::hypot(along * normal(), across * normal()) > 1;
    const double share = hts::spectral::share_beyond_45_degrees(s);
    CHECK(std::abs(steep - share * draws) < 4 * std::sqrt(share * draws));
    CHECK(hts::spectral::share_beyond_45_degrees(
              Surface::anisotropic(0.3, {1, 1 + 1e-9}, Direction::from_degrees(90, 0))) ==
          Approx(hts::spectral::share_beyond_45_degrees({0.3, 1})).epsilon(1e-7));
    // validity is asked of the worse axis
    const auto verdict = [](const Surface& of) {
        return hts::spectral::validity(of, {Direction::from_degrees(0, 0), Direction::from_degrees(0, 0)},
                                       {one_um, {1.5, 0}, 0});
    };
    CHECK(verdict(s)[hts::spectral::Criterion::slope].measured == Approx(0.3));
    CHECK(verdict(s)[hts::spectral::Criterion::correlation_length].measured == Approx(1));
}

TEST_CASE("uniform light on an anisotropic model: the mean over azimuths") {
    const auto of =
        material_of(R"({"model": "ward", "kd": 0.1, "lobes": [{"ks": 0.2, "mx": 0.1, "my": 0.3}]})")
            .at(one_um);
    // brute force: Gauss's rule over the root of cos theta, azimuths off the axes
    const double brute = boost::math::quadrature::gauss<double, 16>::integrate(
        [&](double x) {
            constexpr int azimuths = 12;
            double sum = 0;
            for (int i = 0; i < azimuths; ++i) {
                const double azimuth = 2 * pi * (i + 0.3) / azimuths;
                sum += of.albedo(Direction::from_angles(std::acos(x * x), azimuth), 0).total();
            }
            return 4 * x * x * x * sum / azimuths;
        },
        0.0, 1.0);
    WorstCase worst{"reflectance of uniform light, absolute",
                    hts::spectral::accuracy::bihemispherical_reflectance};
    const double mean = bihemispherical_reflectance(of, 0).total();
    CHECK(mean > 0.1);
    worst.note(std::abs(mean - brute), [&] { return of.name(); });
    worst.check();
}

TEST_CASE("uniform light on an anisotropic surface: terms and model agree", "[.][exhaustive]") {
    for (const char* const model : {"he", "he_unified"}) {
        const auto of = material_of(brushed(model, "[4, 1]")).at(one_um);
        const auto& at = of.samples()[0];
        const double direct = bihemispherical_reflectance(*of.properties().surface, at.index, one_um).total();
        const double mean = bihemispherical_reflectance(of, 0).total();
        std::printf("%s: by terms %.9g, by the model %.9g\n", model, direct, mean);
        CHECK(mean == Approx(direct).margin(2e-5));
        // neither axis alone has it
        const auto along = [&](double azimuth) {
            return of.albedo(Direction::from_angles(1, azimuth), 0).total();
        };
        CHECK(std::abs(along(0) - along(pi / 2)) > 1e-3);
    }
}

TEST_CASE("what needs one correlation length is refused of two, by name") {
    const Material two = material_of(brushed("he", "[8, 1]"));
    const TemporaryFolder folder;
    const auto message = [&](auto&& f) { return complaint(folder, f); };
    CHECK(has(message([&] { static_cast<void>(two.at(one_um, {.compensate_energy = true})); }),
              "energy compensation of a surface of two correlation lengths"));
    CHECK(
        has(message([&] {
                static_cast<void>(
                    material_of(brushed("he_unified", "[8, 1]", R"(, "mirror": "second_order")")).at(one_um));
            }),
            "second-order mirror"));
    CHECK(has(
        message([&] {
            static_cast<void>(
                material_of(brushed("he_unified", "[8, 1]", R"(, "polarisation_mixing": true)")).at(one_um));
        }),
        "polarisation mixing"));
}
