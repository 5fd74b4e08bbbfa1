#include "validation/pictures/renderer.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "comparison.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/model_evaluator.hpp"
#include "validation/pictures/gallery.hpp"
#include "validation/pictures/picture.hpp"

using namespace hts::validation;
using hts::Direction;
using hts::Vector3;
namespace spectral = hts::spectral;

namespace {

Appearance lambertian(double albedo) {
    return Appearance{spectral::material_of(
        [=](const hts::Wavelength&, spectral::OutsideRange) { return hts::LambertianModel{albedo}; })};
}

spectral::Material rough(double rms_roughness, double correlation_length,
                         const spectral::OpticalConstants& constants, double albedo) {
    return spectral::he_torrance_material("surface", {rms_roughness, correlation_length}, constants,
                                          spectral::DiffuseAlbedo{albedo});
}

Appearance smooth_plastic(double albedo) {
    return Appearance(rough(0, 1, spectral::OpticalConstants::constant({1.5, 0}), albedo));
}

/// One object in ambient light, seen from the front.
Scene in_ambient_light(const Appearance& material, double ambient) {
    return {
        {{Sphere{{0, 0, 0}, 1}, {material}}}, {}, Spectrum::grey(ambient), Camera{{0, -5, 0}, {0, 0, 0}, 30}};
}

double largest_difference(const Spectrum& a, const Spectrum& b) {
    double largest = 0;
    for (std::size_t i = 0; i < bands; ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    return largest;
}

bool same_bits(const Picture& a, const Picture& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(spectral::Xyz)) == 0;
}

}  // namespace

TEST_CASE("furnace: a white sphere in white light cannot be seen, by either method") {
    const Scene scene = in_ambient_light(lambertian(1), 1);
    for (const bool paths : {false, true}) {
        const Picture picture = render(scene, {24, 24, 4, paths, 1});
        for (const auto& [X, Y, Z] : picture.pixels) {
            CHECK(Y == Approx(1).epsilon(1e-12));
            CHECK(X == Approx(spectral::white_point(spectral::Illuminant::D65).X).epsilon(1e-12));
        }
    }
}

TEST_CASE("a smooth plastic sphere in even light returns Fresnel's share and its albedo, by either method") {
    const Scene scene = in_ambient_light(smooth_plastic(0.3), 2);
    for (const double x : {0.0, 0.4, 0.8, 0.97}) {
        const Ray ray{{x, -5, 0}, {0, 1, 0}};
        const double fresnel =
            spectral::facet_reflectance(hts::RefractiveIndex{1.5, 0}, std::sqrt(1 - x * x));
        const double expected = 2 * (fresnel + 0.3);
        CHECK(largest_difference(radiance(scene, ray, 4), Spectrum::grey(expected)) < 1e-12);
        const double seen = path_radiance(scene, ray, 20000).mean();
        INFO("x = " << x);
        CHECK(seen == Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("the ambient reflectance of a material is that of the model's integral") {
    hts::testing::WorstCase worst{"ambient reflectance", hts::accuracy::rendered_albedo};
    const spectral::Material surfaces[]{rough(0.18, 3, spectral::built_in_optical_constants("Al"), 0),
                                        rough(0.13, 1.2, spectral::built_in_optical_constants("Cu"), 0),
                                        rough(0.2, 2, spectral::OpticalConstants::constant({1.54, 0}), 0.28)};
    for (const auto& surface : surfaces) {
        const Appearance material{surface};
        const std::size_t band = 15;
        const auto statistics = *surface.properties().surface;
        const auto sample = surface.at(picture_wavelengths()[band]).samples()[0];
        const auto exact = spectral::bihemispherical_reflectance(statistics, sample.index, sample.wavelength);
        worst.note(std::abs(material.diffuse_albedo().values[band] - exact.directional_diffuse -
                            std::numbers::pi * sample.uniform_diffuse),
                   [&] { return "sigma0 " + std::to_string(statistics.rms_roughness()); });
    }
    worst.check();
    CHECK(lambertian(0.6).diffuse_albedo().mean() == Approx(0.6).epsilon(1e-12));
}

TEST_CASE("light of a small lamp on a diffuse plane falls with the cosine and the square of the distance") {
    Scene scene{{{Rectangle{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}}, {lambertian(0.5)}}},
                {{Sphere{{0, 0, 3}, 0.05}, Spectrum::grey(100)}},
                Spectrum{},
                Camera{{0, -5, 5}, {0, 0, 0}, 30}};
    for (const double x : {0.0, 1.5, 4.0}) {
        const double distance = std::hypot(x, 3.0);
        const double irradiance = 100 * std::numbers::pi * 0.05 * 0.05 / (distance * distance) * 3 / distance;
        const Ray ray{{x, 0, 2}, {0, 0, -1}};
        CHECK(radiance(scene, ray, 64).mean() == Approx(0.5 * irradiance / std::numbers::pi).epsilon(1e-3));
        CHECK(path_radiance(scene, ray, 4096).mean() ==
              Approx(0.5 * irradiance / std::numbers::pi).epsilon(0.01));
    }
    // the shadow of a ball, and a lamp that shines away
    scene.objects.push_back({Sphere{{0, 0, 1.5}, 0.3}, {lambertian(0)}});
    CHECK(radiance(scene, {{0, -1, 0.5}, normalised({0, 1, -0.5})}, 16).mean() == 0);
    scene.lights = {{Rectangle{{-1, -1, 3}, {2, 0, 0}, {0, 2, 0}}, Spectrum::grey(1)}};
    CHECK(radiance(scene, {{4, 0, 2}, {0, 0, -1}}, 16).mean() == 0);
}

TEST_CASE("rectangular and spherical lamps light as much as their integrals say") {
    // a Lambertian plane under a square lamp that covers everything returns its albedo
    Scene scene{{{Rectangle{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, {lambertian(0.8)}}},
                {{Rectangle{{-500, 500, 1}, {1000, 0, 0}, {0, -1000, 0}}, Spectrum::grey(1)}},
                Spectrum{},
                Camera{{0, -5, 5}, {0, 0, 0}, 30}};
    CHECK(path_radiance(scene, {{0, 0, 0.5}, {0, 0, -1}}, 4096).mean() == Approx(0.8).epsilon(0.01));
    // under a sphere of half angle 30 deg straight above: E = pi L sin^2
    scene.lights = {{Sphere{{0, 0, 2}, 1}, Spectrum::grey(1)}};
    const double expected = 0.8 * 0.25;
    CHECK(radiance(scene, {{0, 0, 0.5}, {0, 0, -1}}, 256).mean() == Approx(expected).epsilon(1e-3));
    CHECK(path_radiance(scene, {{0, 0, 0.5}, {0, 0, -1}}, 4096).mean() == Approx(expected).epsilon(0.01));
}

TEST_CASE("paths and equation (12) agree on rough metal under a lamp alone") {
    const Appearance metal = Appearance(rough(0.28, 1.77, spectral::built_in_optical_constants("Al"), 0));
    const Scene scene{{{Rectangle{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, {metal}}},
                      {{Sphere{{0, 2, 2}, 0.4}, Spectrum::grey(10)}},
                      Spectrum{},
                      Camera{{0, -5, 5}, {0, 0, 0}, 30}};
    for (const double height : {0.6, 1.0, 1.6}) {
        const Ray ray{{0, -1, height}, normalised({0, 1, -height})};
        const double expected = radiance(scene, ray, 1024).mean();
        CHECK(path_radiance(scene, ray, 8192).mean() == Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("a mirror shows the pixel that its normal says") {
    // a smooth metal floor; a bright wall behind shows upside down at equal height
    const Appearance mirror = Appearance(rough(0, 1, spectral::built_in_optical_constants("Al"), 0));
    const Scene scene{{{Rectangle{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}, {mirror}},
                       {Rectangle{{-9, 2, 0}, {18, 0, 0}, {0, 0, 9}},
                        {lambertian(0), lambertian(1)},
                        [](Vector3 point) { return std::size_t{point.z > 1 && point.z < 1.2 ? 1u : 0u}; }}},
                      {},
                      Spectrum::grey(1),
                      Camera{{0, -2, 1}, {0, 2, 0}, 40}};
    for (const double z : {0.95, 1.05, 1.15, 1.25}) {
        const Vector3 image = normalised(Vector3{0, 2, -z} - Vector3{0, -2, 1});
        const double cosine = -image.z;
        const auto index = spectral::built_in_optical_constants("Al").index(picture_wavelengths()[15]);
        const double expected = z > 1 && z < 1.2 ? spectral::facet_reflectance(index, cosine) : 0;
        CHECK(radiance(scene, {{0, -2, 1}, image}, 1).values[15] == Approx(expected).margin(1e-12));
    }
}

TEST_CASE("pictures have the same bits for one thread and two, and others for another seed") {
    const auto& all = galleries();
    const Scene scene = all[2].scenes().front();
    for (const bool paths : {false, true}) {
        RenderSettings settings{40, 30, 2, paths, 1};
        omp_set_num_threads(1);
        const Picture one = render(scene, settings);
        omp_set_num_threads(2);
        CHECK(same_bits(one, render(scene, settings)));
        settings.seed = 2;
        CHECK_FALSE(same_bits(one, render(scene, settings)));
    }
}

TEST_CASE("progress rises to the whole") {
    double last = 0;
    static_cast<void>(render(in_ambient_light(lambertian(0.5), 1), {40, 40, 1, false, 1}, [&](double share) {
        CHECK(share > last);
        last = share;
    }));
    CHECK(last == 1);
}

TEST_CASE("brightness is shown as it is, then ever more softly") {
    CHECK(shown(0.3) == 0.3);
    CHECK(shown(shoulder + 1e-9) == Approx(shoulder + 1e-9).epsilon(1e-12));
    CHECK((shown(shoulder + 1e-6) - shown(shoulder)) / 1e-6 == Approx(1).epsilon(1e-4));
    CHECK(shown(2) < 1);
    CHECK(shown(1e9) == 1);
}

TEST_CASE("panels stand in rows, white between them") {
    const Picture black{2, 1, {{0, 0, 0}, {0, 0, 0}}};
    const Picture row = panels({black, black, black}, 2, 1);
    CHECK(row.width == 5);
    CHECK(row.height == 3);
    CHECK(row.pixels[1].Y == 0);
    CHECK(row.pixels[2].Y == Approx(1));
    CHECK(row.pixels[5 * 2 + 1].Y == 0);
    CHECK(row.pixels[5 * 2 + 3].Y == Approx(1));
    CHECK_THROWS_WITH(panels({}, 1, 0), Catch::Contains("at least one"));
    CHECK_THROWS_WITH(panels({black, Picture{1, 1, {{0, 0, 0}}}}, 2, 0), Catch::Contains("equal size"));
}
