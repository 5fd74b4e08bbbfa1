/// What `hts fit` says of a fit.
#pragma once

#include <string>

#include "validation/fit/fit.hpp"

namespace hts::cli {

/// Parameters with their uncertainties, how close the fit came, and what the data leave open; lines for a
/// reader.
[[nodiscard]] std::string fit_text(const validation::Fit& fit);

/// The same and more as a JSON object: correlation, starts, settings, the material.
[[nodiscard]] std::string fit_json(const validation::Fit& fit);

/// The fitted material, with the key "fitted" (data and scale) where a factor was fitted beside it.
[[nodiscard]] std::string material_file(const validation::Fit& fit);

}  // namespace hts::cli
