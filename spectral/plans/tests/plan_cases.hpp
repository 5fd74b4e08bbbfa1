/// Scenes that the tests of plans plan.
#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/plans/plan.hpp"

namespace hts::spectral::testing {

inline constexpr double degree = std::numbers::pi / 180;
inline const std::filesystem::path examples = HTS_SOURCE_DIR "/cli/data";

inline Material metal(const std::string& name, double rms_roughness, double correlation_length,
                      double albedo = 0) {
    return he_torrance_material(name, Surface{rms_roughness, correlation_length},
                                built_in_optical_constants("Al"), DiffuseAlbedo{albedo});
}

inline Scene spectral_scene(const std::vector<Material>& materials, double tolerance) {
    return {"scene.json",
            materials,
            WavelengthGrid::linear(0.4, 0.7, 4),
            OutsideRange::error,
            60 * degree,
            60 * degree,
            false,
            std::nullopt,
            ErrorMeasure::relative_brdf_error,
            tolerance,
            std::nullopt};
}

inline Scene rgb_scene(const std::vector<Material>& materials, double delta_e) {
    Scene scene = spectral_scene(materials, delta_e);
    scene.wavelengths = WavelengthGrid::linear(0.4, 0.7, 31);
    scene.illuminant = Illuminant::D65;
    scene.measure = ErrorMeasure::delta_e_2000;
    return scene;
}

inline Plan plan_of(const Scene& scene, std::size_t pairs = 1000) {
    return make_plan(scene, {1, pairs}, scene.tolerance);
}

/// A pair within a scene, drawn otherwise than the planner draws: every other one within 6 degrees
/// of the mirror direction.
inline DirectionPair random_pair(Random& random, const Scene& scene, bool near_mirror) {
    const double theta_i = random.uniform(0, scene.largest_theta_i), phi_i = random.uniform(0, 6.3);
    const double theta_r =
        near_mirror ? theta_i + random.uniform(-0.1, 0.1) : random.uniform(0, scene.largest_theta_r);
    const double phi_r =
        near_mirror ? phi_i + std::numbers::pi + random.uniform(-0.1, 0.1) : random.uniform(0, 6.3);
    return {Direction::from_angles(theta_i, phi_i),
            Direction::from_angles(std::clamp(theta_r, 0., scene.largest_theta_r), phi_r)};
}

/// `text` with the first `what` replaced; it must be there.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto position = text.find(what);
    REQUIRE(position != std::string::npos);
    return text.replace(position, what.size(), by);
}

}  // namespace hts::spectral::testing
