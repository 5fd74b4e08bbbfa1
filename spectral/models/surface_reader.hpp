/// Surfaces as material files describe them: roughness, correlation lengths, shape of
/// correlation. Not installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spectral/energy/rough_surface.hpp"
#include "spectral/text/json_value.hpp"

namespace hts::spectral {

/// The keys that surface_from reads.
[[nodiscard]] const std::vector<std::string>& surface_keys();

/// Reads
///   "rms_roughness_um": 0.28, "correlation_length_um": 1.77 or [along, across] with "azimuth_deg": 30
///   "correlation": "gaussian", "exponential", {"type": "matern", "nu": 1.5},
///                  {"type": "k_correlation", "B_um": 5.0, "C": 2.5, "psd": "1d one-sided" or "2d"}, without
///                  length; with "A" [um^3, um^4] also without rms roughness
///                  {"type": "sum", "of": [[weight, {"type": …, "length_um": …}], …]}, without length
///                  {"type": "psd", "file": "psd.csv"} or {"type": "psd", "psd": "2d", "table": [[f, S2],
///                  …]}, without length and rms roughness
///                  {"type": "autocorrelation", "file": "acf.csv"}, without length
///   "rms_band_um": [shortest period, longest period or "infinity"] that the rms roughness holds for
/// hts::Error of a key that is missing, unknown, out of range or does not belong beside
/// another, and of rows of files.
[[nodiscard]] RoughSurface surface_from(const JsonValue& file, const std::filesystem::path& folder);

}  // namespace hts::spectral
