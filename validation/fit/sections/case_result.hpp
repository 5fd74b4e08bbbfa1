/// A fit of the list with what it was made to. Private to the sections.
#pragma once

#include <vector>

#include "validation/fit/sections/fit_cases.hpp"
#include "validation/report/report.hpp"

namespace hts::validation {

struct CaseResult {
    FitCase asked;
    CurveSet set;
    Fit fit;
};

/// What the fitted materials reflect into all directions beside 1 less the emissivity that was measured of
/// the same surfaces, which no fit has seen.
[[nodiscard]] Section emissivity_section(const std::vector<CaseResult>& results);

/// What two coatings scatter as their height maps say, without a fit, beside the fits.
[[nodiscard]] Section predicted_section(const std::vector<CaseResult>& results);

}  // namespace hts::validation
