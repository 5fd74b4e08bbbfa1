/// What `hts fit` says of a fit.
#pragma once

#include <optional>
#include <string>

#include "validation/fit/cross_validation.hpp"
#include "validation/fit/fit.hpp"

namespace hts::cli {

/// Parameters with their uncertainties, how close the fit came, and what the data leave open; lines for a
/// reader.
[[nodiscard]] std::string fit_text(const validation::Fit& fit);

/// How the fit predicts angles that it has not seen; lines for a reader.
[[nodiscard]] std::string cross_validation_text(const validation::CrossValidation& result);

/// The same and more as a JSON object: correlation, starts, settings, the material.
[[nodiscard]] std::string fit_json(
    const validation::Fit& fit,
    const std::optional<validation::CrossValidation>& cross_validation = std::nullopt);

/// The fitted material, with the key "fitted" (data and scale) where a factor was fitted beside it, and with
/// "uncertainty" where the standard errors hold.
[[nodiscard]] std::string material_file(const validation::Fit& fit);

}  // namespace hts::cli
