/// What stands beside a file of another program, FILE.json: what the file holds, and the specular delta that it does not.
///
///   {"file", "format", "name", "value", "units", "normalisation", "wavelengths_um", "notes", ["suggested_alpha"],
///    "specular": {"treatment", "theta_i_deg": [...], "reflectance": [[per wavelength] per angle]}}
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tables/spectral_brdf.hpp"

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

/// As JSON, with the specular reflectance of `brdf` [1] at every 2.5 degrees of its own wavelengths.
[[nodiscard]] std::string sidecar_json(const std::filesystem::path& file, const SpectralBrdf& brdf,
                                       const Sidecar& sidecar);

/// Writes FILE.json, whole or not at all; hts::Error where it cannot be written.
///   file   the exported file, whose whole name gets ".json" appended
void write_sidecar(const std::filesystem::path& file, const SpectralBrdf& brdf, const Sidecar& sidecar);

}  // namespace hts::tables
