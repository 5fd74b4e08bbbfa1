#include "spectral/energy/energy.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "comparison.hpp"
#include "hemisphere.hpp"
#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"

using namespace hts::spectral;
using namespace hts::spectral::testing;
using hts::Direction;
using hts::PairFactors;
using hts::RefractiveIndex;
using hts::Surface;
using hts::View;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

namespace bound = hts::spectral::accuracy;

const Wavelength one_um = Wavelength::from_micrometres(1);

struct Setting {
    double slope;      ///< sigma_0/tau
    double roughness;  ///< sigma_0/lambda
    double degrees;    ///< of incidence

    [[nodiscard]] Surface surface() const { return {roughness, roughness / slope}; }
    [[nodiscard]] Direction in() const { return Direction::from_degrees(degrees, 0); }
    [[nodiscard]] std::string text() const {
        return "sigma0/tau " + hts::shortest(slope) + ", sigma0/lambda " + hts::shortest(roughness) +
               ", theta " + hts::shortest(degrees);
    }
    /// Some of the narrowest detail of the lobe [rad].
    [[nodiscard]] double detail() const {
        const double core = slope / roughness / std::numbers::pi;
        return std::min(0.1, 0.2 * std::max(core, 4 * slope * std::cos(degrees * std::numbers::pi / 180)));
    }
};

std::vector<Setting> settings() {
    const bool all = hts::testing::exhaustive();
    std::vector<Setting> result;
    for (const double slope : {0.005, 0.1, 1.0}) {
        for (const double roughness :
             all ? std::vector{0.02, 0.05, 0.2, 0.5, 2.0, 5.0} : std::vector{0.05, 2.0}) {
            for (const double degrees :
                 all ? std::vector{0.0, 30.0, 60.0, 75.0, 85.0, 89.0} : std::vector{0.0, 50.0, 85.0}) {
                result.push_back({slope, roughness, degrees});
            }
        }
    }
    return result;
}

double lobe(const Setting& at, const RefractiveIndex& index, const Direction& in, const Direction& out) {
    const Surface surface = at.surface();
    const PairFactors pair{surface, view(surface, in), view(surface, out)};
    return directional_diffuse(pair, one_um, index).brdf;
}

double total(const Setting& at) {
    return directional_hemispherical_reflectance(at.surface(), PerfectMirror{}, one_um, at.in()).total();
}

const Surface smooth{0, 1};

RefractiveIndex index_of(const char* name, const Wavelength& wavelength) {
    return built_in_optical_constants(name).index(wavelength);
}

}  // namespace

TEST_CASE(
    "directional-hemispherical reflectance is the plain integral over outgoing directions, and by "
    "reciprocity over incident ones") {
    WorstCase outgoing{"rho_dh, directional diffuse", bound::hemispherical_reflectance};
    WorstCase incident{"rho_hd against rho_dh", bound::hemispherical_reflectance};
    const RefractiveIndex aluminium{0.77, 6.08};
    for (const Setting& at : settings()) {
        const Direction fixed = at.in();
        const double theta = at.degrees * std::numbers::pi / 180;
        const double computed =
            directional_hemispherical_reflectance(at.surface(), aluminium, one_um, fixed).directional_diffuse;
        const auto text = [&] { return at.text(); };
        outgoing.note(relative_error(computed, hemisphere_integral(theta, at.detail(),
                                                                   [&](const Direction& out) {
                                                                       return lobe(at, aluminium, fixed, out);
                                                                   })),
                      text);
        if (at.slope < 0.1) continue;  // one narrow lobe is enough for the plain way
        incident.note(relative_error(computed, hemisphere_integral(theta, at.detail(),
                                                                   [&](const Direction& in) {
                                                                       return lobe(at, aluminium, in, fixed);
                                                                   })),
                      text);
    }
    outgoing.check();
    incident.check();
}

TEST_CASE("total reflection on the facets has a kink that the quadrature meets") {
    const Setting at{0.25, 0.3, 40};
    const RefractiveIndex thinner{0.7, 0};  // critical angle 44.4 degrees
    const double computed =
        directional_hemispherical_reflectance(at.surface(), thinner, one_um, at.in()).directional_diffuse;
    constexpr double finest = 0.02;  // panels as wide everywhere
    const double plain = 2 * panel_sum(equal_panels(0, std::numbers::pi / 2, finest), [&](double theta) {
                             return std::sin(theta) * std::cos(theta) *
                                    panel_sum(equal_panels(0, std::numbers::pi, finest), [&](double phi) {
                                        return lobe(at, thinner, at.in(), Direction::from_angles(theta, phi));
                                    });
                         });
    CHECK(relative_error(computed, plain) < bound::totally_reflecting_facets);
}

TEST_CASE("what the mirror direction loses, the lobe gains, however narrow it is") {
    for (const double slope : {0.005, 1e-4, 1e-7}) {
        for (const double roughness : {0.02, 0.1, 0.5, 5.0}) {
            for (const double degrees : {0.0, 20.0, 50.0, 65.0}) {
                const Setting at{slope, roughness, degrees};
                INFO(at.text());
                CHECK(total(at) == Approx(1).epsilon(slope == 0.005 ? 2e-3 : 1e-5));
            }
        }
    }
}

TEST_CASE("the furnace's known extremes") {
    CHECK(total({0.1, 0.05, 70}) == Approx(1.04).margin(0.005));
    CHECK(total({0.1, 2, 85}) == Approx(0.60).margin(0.005));
}

TEST_CASE("the terms of a reflector are those of the model") {
    const Surface surface{0.05, 0.5};
    const auto green = Wavelength::from_micrometres(0.55);
    const Direction in = Direction::from_degrees(35, 110);
    const auto aluminium =
        he_torrance_material("test", surface, built_in_optical_constants("Al"), DiffuseAlbedo{0.1});
    const auto terms = aluminium.at(green).albedo(in, 0);
    const RefractiveIndex index = index_of("Al", green);
    CHECK(terms.uniform_diffuse == Approx(0.1).epsilon(1e-15));
    CHECK(terms.specular ==
          Approx(specular_reflectance(surface, view(surface, in), green, index).value()).epsilon(1e-14));
    CHECK(terms.directional_diffuse ==
          Approx(directional_hemispherical_reflectance(surface, index, green, Direction::from_degrees(35, 0))
                     .directional_diffuse)
              .epsilon(1e-12));
    CHECK(terms.total() < 1);
    CHECK(terms.total() > 0.9);
}

TEST_CASE("bihemispherical reflectance of a smooth dielectric has a closed form") {
    WorstCase worst{"mean Fresnel reflectance", bound::bihemispherical_reflectance};
    for (const double n : {1.2, 1.5, 2.5}) {
        const double n2 = n * n, n4 = n2 * n2;  // Walsh 1926, Duntley 1942
        const double expected = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                                n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
                                2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
                                8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
        const auto mean = bihemispherical_reflectance(smooth, RefractiveIndex{n, 0}, one_um);
        worst.note(std::abs(mean.specular - expected), [&] { return "n " + hts::shortest(n); });
        CHECK(mean.directional_diffuse == 0);
        CHECK(mean.uniform_diffuse == 0);
    }
    worst.check();
}

TEST_CASE("bihemispherical reflectance of a rough metal is the mean over angles") {
    const Surface surface{0.3, 1.5};
    const RefractiveIndex aluminium = index_of("Al", one_um);
    const auto mean = bihemispherical_reflectance(surface, aluminium, one_um);
    const auto term_mean = [&](auto term) {
        return panel_sum(panels_towards(0, 0, 1, 0.01), [&](double cosine) {
            const Direction in = Direction::from_angles(std::acos(cosine), 0);
            return 2 * cosine * directional_hemispherical_reflectance(surface, aluminium, one_um, in).*term;
        });
    };
    CHECK(std::abs(mean.specular - term_mean(&HemisphericalReflectance::specular)) <
          bound::bihemispherical_reflectance);
    CHECK(std::abs(mean.directional_diffuse - term_mean(&HemisphericalReflectance::directional_diffuse)) <
          bound::bihemispherical_reflectance);
}

TEST_CASE("the paper's plastic: 0.195 measured at the normal gives an albedo of 0.15") {
    const auto blue = Wavelength::from_micrometres(0.46);
    const Direction normal = Direction::from_degrees(0, 0);
    const RefractiveIndex plastic{1.5, 0};
    const double albedo = diffuse_albedo_from(0.195, smooth, plastic, blue, normal);
    CHECK(albedo == Approx(0.155).epsilon(1e-12));  // 0.195 - (0.5/2.5)^2
    CHECK(he_torrance_material("plastic", smooth, OpticalConstants::constant(plastic), DiffuseAlbedo{albedo})
              .at(blue)
              .albedo(normal, 0)
              .total() == Approx(0.195).epsilon(1e-12));
    for (const char* name : {"PMMA", "polycarbonate", "polystyrene"}) {
        const double a = diffuse_albedo_from(0.195, smooth, index_of(name, blue), blue, normal);
        std::printf("albedo from 0.195 with the index of %s: %.4f\n", name, a);
        CHECK(a == Approx(0.15).margin(0.011));
    }
    CHECK_THROWS_WITH(
        diffuse_albedo_from(0.02, smooth, plastic, blue, normal),
        Catch::Contains("measured reflectance 0.02: must be from 0.04") && Catch::Contains("to 1"));
    CHECK_THROWS_AS(diffuse_albedo_from(1.5, smooth, plastic, blue, normal), hts::Error);
    CHECK_THROWS_AS(diffuse_albedo_from(std::nan(""), smooth, plastic, blue, normal), hts::Error);
}

TEST_CASE("the largest diffuse albedo is what the brightest angle leaves") {
    const double steepest = std::numbers::pi / 3;
    const auto limit = largest_diffuse_albedo(smooth, RefractiveIndex{1.5, 0}, one_um, steepest);
    const double fresnel_60 = hts::fresnel(0.5, {1.5, 0}).unpolarised_reflectance();
    CHECK(limit.albedo == Approx(1 - fresnel_60).epsilon(1e-12));
    CHECK(limit.theta == steepest);
    CHECK(limit.reflectance == Approx(fresnel_60).epsilon(1e-12));
    CHECK(largest_diffuse_albedo(smooth, RefractiveIndex{1.5, 0}, one_um, std::numbers::pi / 2).albedo <
          1e-12);
    CHECK(largest_diffuse_albedo(smooth, RefractiveIndex{1.5, 0}, one_um, 0).albedo ==
          Approx(0.96).epsilon(1e-12));
    CHECK_THROWS_AS(largest_diffuse_albedo(smooth, RefractiveIndex{1.5, 0}, one_um, 2), hts::Error);
    CHECK_THROWS_AS(largest_diffuse_albedo(smooth, RefractiveIndex{1.5, 0}, one_um, -0.1), hts::Error);
}

TEST_CASE("a maximum between the normal and grazing is found") {
    const Surface surface{0.05, 0.5};
    const RefractiveIndex silver = index_of("Ag", one_um);
    const auto limit = largest_diffuse_albedo(surface, silver, one_um, std::numbers::pi / 2);
    CHECK(limit.albedo == 0);  // the lobes alone reflect more than falls in
    CHECK(limit.reflectance > 1.02);
    CHECK(limit.theta > 1);
    CHECK(limit.theta < 1.4);
    for (double theta = 1; theta < 1.4; theta += 0.02) {
        CHECK(directional_hemispherical_reflectance(surface, silver, one_um, Direction::from_angles(theta, 0))
                  .total() <= limit.reflectance + 1e-6);
    }
}

TEST_CASE("finite for every surface, wavelength and angle") {
    Random random{11};
    const int cases = hts::testing::exhaustive() ? 3000 : 150;
    double highest = 0;
    for (int i = 0; i < cases; ++i) {
        const Surface surface{random.logarithmic(1e-6, 1e6), random.logarithmic(1e-6, 1e6)};
        const double theta =
            i % 3 == 0 ? std::numbers::pi / 2 - random.logarithmic(1e-17, 1) : random.uniform(0, 1.5707);
        const auto terms = directional_hemispherical_reflectance(surface, PerfectMirror{}, one_um,
                                                                 Direction::from_angles(theta, 0));
        INFO("sigma0 " << surface.rms_roughness() << ", tau " << surface.correlation_length() << ", theta "
                       << theta);
        CHECK(terms.specular >= 0);
        CHECK(terms.directional_diffuse >= 0);
        CHECK(terms.total() <= 1.2);
        highest = std::max(highest, terms.total());
    }
    std::printf("highest total of %d random surfaces: %.4f\n", cases, highest);
    for (const double length : {hts::shortest_length, hts::longest_length}) {
        for (const double other : {hts::shortest_length, hts::longest_length}) {
            const double value = directional_hemispherical_reflectance({length, other}, PerfectMirror{},
                                                                       one_um, Direction::from_degrees(45, 0))
                                     .total();
            CHECK(value >= 0);
            CHECK(value <= 1.2);
        }
    }
    const auto horizon = Direction::from_degrees(90, 0);
    CHECK(directional_hemispherical_reflectance({0.1, 1}, PerfectMirror{}, one_um, horizon).total() == 0);
    CHECK(directional_hemispherical_reflectance({0, 1}, PerfectMirror{}, one_um, horizon).total() == 1);
}
