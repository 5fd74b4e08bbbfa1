/// Materials of the He-Torrance model and of its successor he_unified: roughness, optical constants
/// and uniform-diffuse albedo.
#pragma once

#include <string>

#include "spectral/energy/rough_surface.hpp"
#include "spectral/materials/coated_constants.hpp"
#include "spectral/materials/piecewise_linear.hpp"
#include "spectral/models/material.hpp"

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

/// A rough surface of a substance: what a file with "model": "he" says, or "he_unified" where the
/// surface is one of that theory.
///
///     const Material aluminium = he_torrance_material("rough aluminium", {0.28, 1.77},
///     built_in_optical_constants("Al"));
[[nodiscard]] Material he_torrance_material(const std::string& name, const RoughSurface& surface,
                                            const CoatedConstants& constants,
                                            const DiffuseAlbedo& albedo = DiffuseAlbedo{0});

/// A rough surface with what it is at each wavelength given.
///   samples   one per wavelength, of which the wavelengths are
///   lobe      a limit where the surface needs no more
[[nodiscard]] Reflectance he_torrance_reflectance(const std::string& name, const RoughSurface& surface,
                                                  std::vector<SpectralSample> samples,
                                                  Tolerance tolerance = {},
                                                  DiffuseLobe lobe = DiffuseLobe::full);

/// Reads
///   {"name": "roughened aluminium", "model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
///    "index": "Al", "diffuse_albedo": 0.0}
/// "correlation_length_um" may be [along, across] of two axes, with "azimuth_deg" of the first from x, 0 if
/// left out; "index" is a built-in name, {"n": …, "k": …}, {"file": path relative to this file} or {"table":
/// [[um, n, k], …]}; "diffuse_albedo" a number or {"table": [[um, a], …]}, 0 if left out. "films" may cover
/// it: coated_constants.hpp.
[[nodiscard]] Material read_he_torrance(const MaterialFile& file);
/// Reads the same keys of "model": "he_unified", and
///   "mirror": "closed" or "second_order", "polarisation_mixing" and "conductor_shortcut": true or false
///   "closed" and false if left out
[[nodiscard]] Material read_he_unified(const MaterialFile& file);

}  // namespace hts::spectral
