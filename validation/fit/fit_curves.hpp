/// Measured curves as what a fit is made to, band, cones and normalisation included.
#pragma once

#include <span>

#include "validation/curves/curve.hpp"
#include "validation/curves/prediction.hpp"
#include "validation/fit/fit.hpp"

namespace hts::validation {

/// Which points of a curve set are fitted, and how finely averages are taken.
struct FitSelection {
    double largest_theta = 87;    ///< of both polar angles [deg]
    std::size_t most_points = 0;  ///< every so-manieth point, so that at most these are left; 0: all
    AveragingNodes nodes{4, 1};   ///< enough for lobes much wider than the cones
    spectral::OutsideRange outside =
        spectral::OutsideRange::error;  ///< where optical constants are not known
    bool positive_only = true;          ///< leaves out values <= 0
};

/// The selection with values <= 0 left out only where residuals cannot be formed of them.
[[nodiscard]] FitSelection for_residual(FitSelection selection, Residual residual, const CurveSet& set);

/// The points of a set that are selected; each band is a channel. Uncertainties are those of the set.
/// hts::Error "STEM: …" if no point is left.
[[nodiscard]] FitData fit_data(const CurveSet& set, const FitSelection& selection = {});
/// The same of several sets of one surface, so of one material: BRDFs first, then perhaps hemispherical
/// reflectances, whose squares together count as much as those of the first set. Uncertainties where all have
/// them; noise floor and scale are the first set's.
[[nodiscard]] FitData fit_data(std::span<const CurveSet> sets, const FitSelection& selection = {});

/// The set with the selected points alone, in the order of the fit's data.
[[nodiscard]] CurveSet selected(const CurveSet& set, const FitSelection& selection);

}  // namespace hts::validation
