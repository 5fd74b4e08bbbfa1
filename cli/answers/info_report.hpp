/// What `hts info` says of a material: as text, as JSON, and as a table of its points.
#pragma once

#include <string>
#include <vector>

#include "cli/io/table_writer.hpp"
#include "spectral/energy/validity.hpp"
#include "spectral/models/material.hpp"

namespace hts::cli {

/// A material over wavelengths and angles of incidence.
struct MaterialInfo {
    /// Throws hts::Error if an angle is out of range, or a wavelength out of the material's and `policy` is
    /// error.
    ///   of   a rough surface
    MaterialInfo(const spectral::Material& of, const spectral::WavelengthGrid& wavelengths,
                 std::vector<double> theta_deg, spectral::OutsideRange policy);

    spectral::Material material;
    spectral::RoughSurface surface;
    std::vector<double> theta;  ///< [deg]
    spectral::MaterialValidity validity;
    std::size_t prepared_bytes;   ///< of the reflectance at these wavelengths
    std::size_t phi_table_bytes;  ///< shared by all materials

  private:
    MaterialInfo(spectral::Material of, std::vector<double> theta_deg, const spectral::Reflectance& prepared);
};

/// For people; lines of at most 120 characters or so.
[[nodiscard]] std::string info_text(const MaterialInfo& info);
[[nodiscard]] std::string info_json(const MaterialInfo& info);
/// A row per wavelength and angle.
void write_info_table(Output& output, const MaterialInfo& info);

}  // namespace hts::cli
