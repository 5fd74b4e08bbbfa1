/// What stands beside a file of another program, FILE.json: what the file holds, and the
/// specular term that it does not.
///
///   {"file", "format", "name", "value", "units", "normalisation", "wavelengths_um",
///   "notes", ["suggested_alpha"],
///    "specular": {"treatment", "theta_i_deg": [...], "reflectance": [[per wavelength] per angle]}}
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"
#include "spectral/text/output.hpp"

namespace hts::tables {

struct Sidecar {
    std::string format;  ///< "RGL tensor file (.bsdf)"
    std::string value;   ///< what a stored number is: "f cos(theta_o)", "Mueller matrix of f"
    std::string units = "1/sr";
    std::string normalisation;                      ///< constants that the reader multiplies by, "none"
    std::string specular = "left out of the file";  ///< or "box of 0.01 sr"
    std::optional<double> suggested_alpha{};        ///< GGX width for readers that sample by one
    std::vector<std::string> notes{};
};

/// The files of a format, and what is in them.
struct Exported {
    std::vector<spectral::TextFile> files;
    Sidecar sidecar;
    double mirror_azimuth = 180;  ///< of the files, where they leave it open [deg]
};

/// As JSON, with the specular reflectance of `brdf` [1] at every 2.5 degrees of its own wavelengths.
[[nodiscard]] std::string sidecar_json(const std::filesystem::path& file, const spectral::Reflectance& brdf,
                                       const Sidecar& sidecar);

/// Writes the files and beside them FILE.json, all of them or none (spectral::write_files); hts::Error
/// where one cannot be written.
///   file   the exported file, whose whole name gets ".json" appended
///   brdf   whose specular reflectance the sidecar tells
void write_with_sidecar(const std::filesystem::path& file, const spectral::Reflectance& brdf,
                        Exported exported);

}  // namespace hts::tables
