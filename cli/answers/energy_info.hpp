/// What `hts info` says of a material that is no rough surface: how much light it reflects in all.
#pragma once

#include <string>
#include <vector>

#include "cli/io/table_writer.hpp"
#include "spectral/models/material.hpp"

namespace hts::cli {

/// Directional-hemispherical reflectance of a material over wavelengths and angles of incidence, azimuth 0.
struct EnergyInfo {
    struct Point {
        double wavelength;  ///< [um]
        double theta;       ///< [deg]
        spectral::HemisphericalReflectance reflectance;
    };

    /// Throws hts::Error if an angle is out of range, or a wavelength out of the material's and `policy` is
    /// error.
    EnergyInfo(spectral::Material of, const spectral::WavelengthGrid& wavelengths,
               const std::vector<double>& theta_deg, spectral::OutsideRange policy);

    spectral::Material material;
    std::vector<Point> points;  ///< all angles of the first wavelength, then of the next
};

[[nodiscard]] std::string info_text(const EnergyInfo& info);
[[nodiscard]] std::string info_json(const EnergyInfo& info);
/// A row per wavelength and angle.
void write_info_table(Output& output, const EnergyInfo& info);

}  // namespace hts::cli
