/// A described surface: roughness, optical constants and uniform-diffuse albedo, as read from a material
/// file.
#pragma once

#include <filesystem>
#include <string>

#include "hts/surface.hpp"
#include "spectral/materials/optical_constants.hpp"
#include "spectral/materials/piecewise_linear.hpp"

namespace hts::spectral {

/// Uniform-diffuse albedo a(lambda), each value 0 ... 1.
class DiffuseAlbedo {
  public:
    /// The same at every wavelength; hts::Error outside 0 ... 1.
    explicit DiffuseAlbedo(double albedo);
    /// Tabulated; hts::Error if a value is outside 0 ... 1.
    explicit DiffuseAlbedo(PiecewiseLinear table);

    /// Albedo at a wavelength; outside a table's range as `policy` says.
    [[nodiscard]] double operator()(const Wavelength& wavelength,
                                    OutsideRange policy = OutsideRange::error) const;

  private:
    Dispersion value_;
};

/// All that the He-Torrance model needs to know of a surface.
struct Reflector {
    std::string name;
    Surface surface;
    Material material;
    DiffuseAlbedo albedo;
};

/// Reads a material file (JSON):
///   {"name": "roughened aluminium", "model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
///    "index": "Al", "diffuse_albedo": 0.0}
/// "index" is a built-in name, {"n": …, "k": …}, {"file": path relative to this file} or {"table": [[um, n,
/// k], …]}; "diffuse_albedo" a number or {"table": [[um, a], …]}, 0 if left out; "name" the file's stem if
/// left out. Throws hts::Error "path: key "…": …" that names the key and the legal range.
[[nodiscard]] Reflector read_reflector(const std::filesystem::path& path);

}  // namespace hts::spectral
