/// Rays through explicit surfaces as a study: shadowing, light reflected once and more often, and where it
/// goes.
#pragma once

#include "validation/scattering/ground_truth.hpp"

namespace hts::validation {

/// Quick: sigma_0/tau 0.1 and 0.25, 4 surfaces; full: 0.05 to 1, 24 surfaces of 24 tau by 24 tau.
[[nodiscard]] GroundTruth rays_study(Effort effort);
[[nodiscard]] Section rays_section(Effort effort);

}  // namespace hts::validation
