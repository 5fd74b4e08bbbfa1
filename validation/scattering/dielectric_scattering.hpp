/// How far the model is from exact scattering by a ground that light enters, glass of refractive index 1.5:
/// profiles as in `exact_scattering`, the closed forms times |F(theta_d)|^2.
#pragma once

#include "validation/scattering/exact_scattering.hpp"

namespace hts::validation {

/// Checks of a map and its lobes, the two tables, against what is claimed of them.
[[nodiscard]] std::vector<Check> dielectric_checks(const std::vector<FigureTable>& tables);

/// Solves a few surfaces at 20, 40 and 60 degrees. Quick: 1 surface, 20 short realisations; full: 4 surfaces,
/// 160 realisations.
[[nodiscard]] GroundTruth dielectric_scattering_study(Effort effort, const std::string& unfinished = {});
/// Its section; quick shows the kept results as well.
[[nodiscard]] Section dielectric_scattering_section(Effort effort);

}  // namespace hts::validation
