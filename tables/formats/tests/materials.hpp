/// Reflectances that the tests of the tables share.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/material.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::tables::testing {

inline constexpr Tolerance exactly{hts::accuracy::finest_tolerance};

/// A material of cli/data.
inline spectral::Material material(const std::string& file) {
    return spectral::read_material(std::filesystem::path{HTS_SOURCE_DIR} / "cli/data" / file);
}

inline spectral::Reflectance brdf_of(const std::string& file, const spectral::WavelengthGrid& wavelengths) {
    return material(file).at(wavelengths, {.tolerance = exactly});
}

/// A He-Torrance surface of a built-in material.
inline spectral::Reflectance rough_surface(const std::string& index, double rms_roughness,
                                           double correlation_length, double albedo,
                                           const spectral::WavelengthGrid& wavelengths) {
    return spectral::he_torrance_material(
               index + " " + std::to_string(rms_roughness), {rms_roughness, correlation_length},
               spectral::built_in_optical_constants(index), spectral::DiffuseAlbedo{albedo})
        .at(wavelengths, {.tolerance = exactly});
}

}  // namespace hts::tables::testing
