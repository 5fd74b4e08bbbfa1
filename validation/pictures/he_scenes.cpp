// The scenes of He et al. 1991, section 5. The paper gives materials and parameters; places, lights and
// camera are chosen here.

#include <array>
#include <cmath>
#include <numbers>

#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "validation/pictures/scene_builders.hpp"

namespace hts::validation {
namespace {

using spectral::built_in_optical_constants;

Appearance he_torrance(const char* name, const Surface& surface, const spectral::OpticalConstants& constants,
                       double albedo) {
    return Appearance{
        spectral::he_torrance_material(name, surface, constants, spectral::DiffuseAlbedo{albedo})};
}

Appearance aluminium(double rms_roughness, double correlation_length) {
    return he_torrance("aluminium", {rms_roughness, correlation_length}, built_in_optical_constants("Al"), 0);
}

Appearance plastic(double rms_roughness) {
    // |F|^2 = 0.195 - 0.15 at the normal, from Fig. 11
    return he_torrance("plastic", {rms_roughness, 2}, spectral::OpticalConstants::constant({1.54, 0}), 0.28);
}

/// A wall of bricks in rows of half a unit, every other row moved by half a brick.
std::size_t brick(Vector3 point) {
    constexpr double row_height = 0.36, brick_length = 1.0, joint = 0.045;
    const double row = std::floor(point.z / row_height);
    const double along = point.x / brick_length + (std::fmod(std::abs(row), 2) == 1 ? 0.5 : 0);
    const double number = std::floor(along);
    if (point.z - row * row_height < joint || (along - number) * brick_length < joint) return 0;
    const double tone = std::sin(12.9898 * number + 78.233 * row) * 43758.5453;
    return 1 + static_cast<std::size_t>(3 * (tone - std::floor(tone)));
}

std::vector<Appearance> bricks() {
    return {matt({0.55, 0.53, 0.50}), matt({0.42, 0.17, 0.11}), matt({0.50, 0.22, 0.14}),
            matt({0.34, 0.13, 0.09})};
}

/// A cylinder before a brick wall, a softbox in front, low, whose image stands on the front face.
Scene cylinder_scene(const Appearance& material) {
    static const std::vector<Appearance> wall = bricks();
    static const Appearance floor = matt({0.20, 0.20, 0.21});
    Scene scene{{}, {}, Spectrum::grey(0.15), Camera{{0, -9.6, 4.15}, {0, 0, 1.32}, 25}};
    scene.objects.push_back({Cylinder{{0, 0, 0}, cylinder_radius, cylinder_height}, {material}});
    scene.objects.push_back({Rectangle{{-30, -30, 0}, {60, 0, 0}, {0, 60, 0}}, {floor}});
    scene.objects.push_back({Rectangle{{-30, 3.2, 0}, {60, 0, 0}, {0, 0, 14}}, wall, brick});
    scene.lights.push_back({Sphere{{-1.3, -3.8, 0.5}, 0.3}, Spectrum::grey(25)});
    scene.lights.push_back({Sphere{{5.5, -7.5, 9.5}, 1.2}, Spectrum::grey(85)});
    return scene;
}

std::vector<Scene> six_cylinders() {
    std::vector<Scene> scenes;
    for (const double rms_roughness : {0.18, 0.28, 0.38, 0.48, 0.58}) {
        scenes.push_back(cylinder_scene(aluminium(rms_roughness, 3)));
    }
    scenes.push_back(cylinder_scene(aluminium(2.5, 16)));
    return scenes;
}

std::vector<Scene> limiting_cylinders() {
    return {cylinder_scene(aluminium(2.5, 16)), cylinder_scene(aluminium(0, 16)),
            cylinder_scene(matt({0.7, 0.7, 0.7}))};
}

std::vector<Scene> still_life() {
    const Appearance cylinder = aluminium(0.18, 3);
    const Appearance sphere = he_torrance("copper", {0.13, 1.2}, built_in_optical_constants("Cu"), 0);
    Scene scene{{}, {}, Spectrum::grey(0.06), Camera{{0, -9.2, 2.75}, {0, 0, 0.62}, 31}};
    scene.objects.push_back({Cylinder{{-1.25, 1.0, 0}, 0.74, 2.0}, {cylinder}});
    scene.objects.push_back({Sphere{{-0.15, -1.25, 0.62}, 0.62}, {sphere}});
    scene.objects.push_back({Box{{1.35, 0.2, 0}, {1.3, 1.3, 1.3}, 0.95}, {plastic(0)}});
    scene.objects.push_back({Rectangle{{-5, -7, 0}, {10, 0, 0}, {0, 11, 0}}, {plastic(0.20)}});
    scene.objects.push_back({Rectangle{{-12, 4, -3}, {24, 0, 0}, {0, 0, 12}}, {matt({0.20, 0.24, 0.32})}});
    scene.lights.emplace_back(softbox({-5, -4.5, 2.6}, {0, 0, 0.8}, 1.5, 1.5), Spectrum::grey(45));
    scene.lights.push_back({Sphere{{4.2, -4.6, 5.5}, 0.6}, Spectrum::grey(60)});
    return {scene};
}

}  // namespace

std::vector<Gallery> he_galleries() {
    return {{"fig12",
             "Aluminium cylinders before a brick wall, after Fig. 12 of He et al. 1991: (a) to (e) rms "
             "roughness 0.18, 0.28, 0.38, 0.48, 0.58 um at correlation length 3 um, (f) 2.5 um at 16 um.",
             3, 1, six_cylinders},
            {"fig13",
             "The three terms alone, after Fig. 13 of He et al. 1991: (a) directional diffuse, aluminium of "
             "2.5 um at 16 um; (b) ideal specular, smooth aluminium; (c) uniform diffuse.",
             3, 1, limiting_cylinders},
            {"fig14",
             "After Fig. 14 of He et al. 1991: aluminium cylinder (0.18 um, 3 um), copper sphere (0.13 um, "
             "1.2 um), smooth plastic cube and rough plastic table (0.20 um, 2 um, albedo 0.28).",
             1, 1, still_life}};
}

}  // namespace hts::validation
