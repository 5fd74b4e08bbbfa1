// he_unified as a material: its keys, its terms, and that it goes where he goes.

#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/unified/he_unified.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "temporary_folder.hpp"

using hts::Direction;
using hts::Wavelength;
using hts::spectral::EnergyCompensation;
using hts::spectral::Material;
using hts::spectral::PerfectMirror;
using hts::spectral::read_material;
using hts::spectral::RoughSurface;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;
using hts::testing::WorstCase;

namespace {

const auto green = Wavelength::from_micrometres(0.55);

std::string file_with(const std::string& more = "") {
    return R"({"model": "he_unified", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": )"
           R"("Al", )"
           R"("diffuse_albedo": 0.1)" +
           more + "}";
}

Material material_of(const std::string& text) {
    const TemporaryFolder folder;
    return read_material(folder.write("m.json", text));
}

std::string complaint_about(const std::string& text) {
    const TemporaryFolder folder;
    const auto path = folder.write("m.json", text);
    return complaint(folder, [&path] { static_cast<void>(read_material(path)); });
}

RoughSurface unified(double sigma, double tau) {
    return {hts::Surface{sigma, tau}, hts::UnifiedChoices{}};
}

}  // namespace

TEST_CASE("a file of he_unified is read with its choices") {
    using Mirror = hts::UnifiedChoices::Mirror;
    const auto choices = [](const std::string& more) {
        return material_of(file_with(more)).properties().surface->unified().value();
    };
    CHECK(choices("").mirror == Mirror::closed);
    CHECK_FALSE(choices("").polarisation_mixing);
    CHECK(choices(R"(, "mirror": "closed")").mirror == Mirror::closed);
    CHECK(choices(R"(, "mirror": "second_order", "polarisation_mixing": true)").mirror ==
          Mirror::second_order);
    CHECK(choices(R"(, "polarisation_mixing": true)").polarisation_mixing);
    CHECK(material_of(file_with()).model_name() == "he_unified");

    CHECK_THAT(complaint_about(file_with(R"(, "mirror": "third")")),
               Catch::Contains("closed or second_order"));
    CHECK_THAT(complaint_about(file_with(R"(, "mirror": 2)")), Catch::Contains("mirror"));
    CHECK_THAT(complaint_about(file_with(R"(, "polarisation_mixing": 0.2)")),
               Catch::Contains("polarisation_mixing"));
    CHECK_THAT(complaint_about(file_with(R"(, "alpha": 0.2)")), Catch::Contains("alpha"));
    CHECK_THAT(complaint_about(R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
                                  "index": "Al", "mirror": "closed"})"),
               Catch::Contains("mirror"));
}

TEST_CASE("a reflectance of he_unified is that of the model at one wavelength") {
    const auto reflectance = material_of(file_with()).at(green, {.tolerance = hts::Tolerance{1e-12}});
    const auto index = hts::spectral::built_in_optical_constants("Al").index(green);
    const hts::HeUnifiedSpectrum model{
        {0.28, 1.77}, {{green, index, hts::uniform_diffuse(0.1)}}, hts::Tolerance{1e-12}};
    const Direction in = Direction::from_degrees(30, 10), out = Direction::from_degrees(50, 170);
    double expected = 0;
    model.brdf({in, out}, {&expected, 1});
    CHECK(reflectance.brdf({in, out}).front() == expected);
    model.specular_reflectance(in, {&expected, 1});
    CHECK(reflectance.specular_reflectance(in).front().value() == expected);
    hts::Mueller matrix;
    model.specular_mueller(in, {&matrix, 1});
    CHECK(reflectance.specular_mueller(in).front().elements() == matrix.elements());
    CHECK(matrix(0, 0) == Approx(expected).epsilon(1e-14));
    const auto mueller = reflectance.mueller({in, out}).front();
    CHECK(mueller(0, 0) == Approx(reflectance.brdf({in, out}).front()).epsilon(1e-14));
}

TEST_CASE("mixing of the polarisations leaves unpolarised light alone") {
    const auto plain = material_of(file_with()).at(green);
    const auto mixed = material_of(file_with(R"(, "polarisation_mixing": true)")).at(green);
    const double share = 0.2 * std::pow(0.28 / 1.77, 2);
    const Direction in = Direction::from_degrees(56, 0), out = Direction::from_degrees(50, 180);
    CHECK(mixed.brdf({in, out}).front() == Approx(plain.brdf({in, out}).front()).epsilon(1e-14));
    const auto one = plain.directional_diffuse_mueller({in, out}).front(),
               other = mixed.directional_diffuse_mueller({in, out}).front();
    CHECK(other(0, 0) == Approx(one(0, 0)).epsilon(1e-14));
    CHECK(other(0, 1) == Approx((1 - 2 * share) * one(0, 1)).epsilon(1e-10));
    CHECK(other(1, 1) == Approx(one(1, 1)).epsilon(1e-10));
}

TEST_CASE(
    "the albedo of he_unified is that of its draws, and real materials reflect no more than flat ones") {
    const auto reflectance = material_of(file_with()).at(green);
    for (const double degrees : {0.0, 60.0, 85.0}) {
        const Direction in = Direction::from_degrees(degrees, 0);
        const auto terms = reflectance.albedo(in, 0);
        const auto sampler = reflectance.sampler(0);
        hts::testing::Random random{1};
        double sum = 0, squares = 0;
        constexpr int count = 20000;
        for (int i = 0; i < count; ++i) {
            const double weight = sampler.sample(in, random.uniforms()).weight;
            sum += weight, squares += weight * weight;
        }
        const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
        INFO(degrees);
        CHECK(std::abs(mean - terms.total()) < 5 * error + 1e-5);
    }
    // the largest totals of a study: silver 0.0005 above flat silver's 0.99, glass 0.0005 above flat glass
    for (const auto& [sigma, tau] : {std::pair{0.1, 1.0}, {0.25, 1.0}, {0.5, 2.0}}) {
        for (const double degrees : {0.0, 45.0, 75.0, 85.0}) {
            const Direction in = Direction::from_degrees(degrees, 0);
            const auto one_um = Wavelength::from_micrometres(1);
            for (const hts::RefractiveIndex index :
                 {hts::RefractiveIndex{0.06, 4}, hts::RefractiveIndex{1.5, 0}}) {
                const double total =
                    directional_hemispherical_reflectance(unified(sigma, tau), index, one_um, in).total();
                const double flat = hts::fresnel(in.cos_theta(), index).unpolarised_reflectance();
                INFO(sigma << ' ' << tau << ' ' << degrees << ' ' << index.n());
                CHECK(total < (index.k() > 0 ? 0.993 : flat + 1e-3));
                CHECK(total > 0.02);
            }
        }
    }
}

TEST_CASE("a perfect conductor of he_unified returns its light, and all of it with compensation") {
    const auto one_um = Wavelength::from_micrometres(1);
    WorstCase worst{"compensated reflectance of he_unified from 1", 2e-4};
    for (const auto& [sigma, tau] : {std::pair{0.05, 1.0}, {0.25, 1.0}, {0.5, 2.0}, {1.0, 4.0}}) {
        const RoughSurface surface = unified(sigma, tau);
        const EnergyCompensation compensation{surface, one_um};
        for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0}) {
            const Direction in = Direction::from_degrees(degrees, 0);
            const double alone =
                directional_hemispherical_reflectance(surface, PerfectMirror{}, one_um, in).total();
            INFO(sigma << ' ' << tau << ' ' << degrees);
            CHECK(alone > 0.91);
            CHECK(alone < (degrees <= 75 ? 1.03 : 1.13));
            const double total =
                directional_hemispherical_reflectance(compensation, surface, PerfectMirror{}, one_um, in)
                    .total();
            worst.note(std::abs(total - 1), [s = sigma] { return "sigma0 " + std::to_string(s); });
        }
    }
    worst.check();
}

TEST_CASE("what a perfect conductor of he_unified returns is what its formulas say") {
    // hts/unified/tests/reference/furnace.py 0.25 1
    const auto one_um = Wavelength::from_micrometres(1);
    for (const auto& [degrees, expected] : {std::pair{30.0, 0.9436}, {60.0, 0.9186}, {85.0, 1.1194}}) {
        INFO(degrees);
        CHECK(directional_hemispherical_reflectance(unified(0.25, 1), PerfectMirror{}, one_um,
                                                    Direction::from_degrees(degrees, 0))
                  .total() == Approx(expected).margin(3e-4));
    }
}

TEST_CASE(
    "the albedo of unpolarised light by the shortcut is that of its lobe, of polarised light the whole") {
    const auto whole = material_of(file_with()).at(green),
               quick = material_of(file_with(R"(, "conductor_shortcut": true)")).at(green);
    const Direction in = Direction::from_degrees(50, 0);
    const auto s = hts::Stokes::s_polarised(), p = hts::Stokes::p_polarised();
    CHECK(quick.albedo(in, 0, s).total() == whole.albedo(in, 0, s).total());
    CHECK(quick.albedo(in, 0, p).total() == whole.albedo(in, 0, p).total());
    const double unpolarised = quick.albedo(in, 0).total();
    CHECK(unpolarised != whole.albedo(in, 0).total());
    CHECK(unpolarised == Approx(whole.albedo(in, 0).total()).epsilon(0.05));
    const auto sampler = quick.sampler(0);
    hts::testing::Random random{3};
    double sum = 0, squares = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const double weight = sampler.sample(in, random.uniforms()).weight;
        sum += weight, squares += weight * weight;
    }
    const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
    CHECK(std::abs(mean - unpolarised) < 5 * error + 1e-5);
    CHECK_THAT(complaint_about(file_with(R"(, "conductor_shortcut": 1)")),
               Catch::Contains("conductor_shortcut"));
    CHECK_THROWS_WITH(
        material_of(R"({"model": "he_unified", "rms_roughness_um": 0.1, "correlation_length_um": 1, )"
                    R"("index": {"n": 1.5, "k": 0}, "conductor_shortcut": true})")
            .at(green),
        Catch::Contains("conductor_shortcut at 0.55 um") && Catch::Contains("0.04"));
}
