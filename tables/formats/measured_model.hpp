/// Tabulated or measured reflectance as a model like any other, and the key "model": "measured" of material files.
///
///     {"model": "measured", "file": "nickel.binary"}
///
/// Between the wavelengths of the data the BRDF is joined by straight lines. Directions are drawn from a table of f cos theta_r over cells
/// of 2 by 4 degrees, for light every 4 degrees, mixed with a tenth of the cosine: the density is exactly that of the draw, and the
/// weights are bounded by 10 pi f. Lobes narrower than the cells are drawn less well, not wrongly.
#pragma once

#include <memory>
#include <vector>

#include "spectral/models/material.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// A tabulated BRDF as a surface at any wavelength within those of the table.
///   brdf   at most most_channels wavelengths, else hts::Error; its specular term is left out
[[nodiscard]] spectral::Material material_of_file(const spectral::Reflectance& brdf,
                                                  std::vector<std::string> notes = {});

/// The models of the library, and "measured": keys "file" (relative to the material file), "format" (see read_brdf) and
/// "wavelengths_um" (what the channels are called), of which only the first is needed.
[[nodiscard]] const std::vector<spectral::ModelEntry>& models_with_files();

}  // namespace hts::tables
