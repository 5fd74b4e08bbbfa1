/// Fits as parts of a validation report.
#pragma once

#include <vector>

#include "validation/fit/fit.hpp"
#include "validation/report/report.hpp"

namespace hts::validation {

/// The He-Torrance model fitted to every set of curves that comes with the program. First the parameters with
/// their uncertainties, what each set leaves open, and fitted beside measured roughness; then, set by set,
/// the fitted model beside the measurement with the criteria that are asked of it. Last what no fit has seen:
/// two coatings predicted from their height maps, and the light into all directions beside measured
/// emissivity.
[[nodiscard]] std::vector<Section> fits_sections(Effort effort);

/// Every model fitted to every set: L2 errors like Table 3 of [Kurt10], and information criteria.
[[nodiscard]] Section models_section(Effort effort);

}  // namespace hts::validation
