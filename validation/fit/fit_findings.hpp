/// A fit of a curve set, and what it says of surface, instrument and model beyond its numbers.
#pragma once

#include <span>
#include <string>

#include "validation/curves/curve.hpp"
#include "validation/fit/fit.hpp"
#include "validation/fit/fit_curves.hpp"

namespace hts::validation {

/// Which findings are worth their time.
struct Findings {
    bool energy = true;  ///< whether the fitted material reflects more than 1
    /// Fits again with other residuals and up to 60 deg alone, and names what moves by more than its errors.
    bool other_ways = false;
};

/// `fitted` to a curve set. Statements name parameters at bounds first, then whether the specular term was
/// compared and what the fitted one contradicts, then what the data leave open, and after that values that
/// were left out, optical constants held beyond their range, measured roughness, energy, and data that no
/// isotropic surface would show. Where the data exclude the fitted specular term and a surface too rough for
/// one comes nearly as close, only sigma0/tau is told (Fit::slope_alone).
[[nodiscard]] Fit fitted(const FitRequest& request, const CurveSet& set, const FitSelection& selection,
                         const Findings& wanted = {});
/// The same of several sets of one surface, of which the first says what instrument and surface are.
[[nodiscard]] Fit fitted(const FitRequest& request, std::span<const CurveSet> sets,
                         const FitSelection& selection, const Findings& wanted = {});

}  // namespace hts::validation
