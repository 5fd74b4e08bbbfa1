/// Tabulated or measured reflectance as a model like any other, and the key "model":
/// "measured" of material files.
///
///     {"model": "measured", "file": "nickel.binary"}
///
/// Where directions or wavelengths were not measured, EvaluationOptions::outside says what is reflected: an
/// hts::Error at single pairs, and where less than 98 % of the hemisphere (of pairs, to draw from it) was
/// measured; the value at the nearer end; or nothing. Between the wavelengths of the data the BRDF is joined
/// by straight lines, and so are Mueller matrices where the file has them. Directions are drawn from a table
/// of f cos theta_r over cells of 2 by 4 degrees, for light every 4 degrees, mixed with a tenth of the
/// cosine: the density is exactly that of the draw, and the weights are bounded by 10 pi f. Lobes narrower
/// than the cells are drawn less well, not wrongly.
#pragma once

#include <memory>
#include <vector>

#include "spectral/models/material.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// A tabulated BRDF as a surface at any wavelength within those of the table.
///   brdf       at most most_channels wavelengths, else hts::Error; its specular term is left out
///   channels   what its wavelengths stand for (Properties::channels)
[[nodiscard]] spectral::Material material_of_file(const spectral::Reflectance& brdf,
                                                  std::vector<std::string> notes = {},
                                                  std::vector<std::string> channels = {});

/// The models of the library, and "measured": keys "file" (relative to the material file), "format",
/// "wavelengths_um" (what the channels are called) and "mirror_azimuth_deg" (see BrdfReading), of which
/// only the first is needed.
[[nodiscard]] const std::vector<spectral::ModelEntry>& models_with_files();

}  // namespace hts::tables
