/// What the evaluators of a plan cost, and where the time goes.
#pragma once

#include <span>
#include <vector>

#include "spectral/plans/plan.hpp"

namespace hts::tables {

/// Nanoseconds of processor time on one core: medians, with the clock's and the machine's scatter.
struct PlanCost {
    double
        diffuse;  ///< both diffuse terms at all wavelengths, a pair of directions (scalar: in batches of 256)
    double mirror;  ///< the specular term at all wavelengths, a direction of light; 0 where it is dropped
    double colour;  ///< from a spectrum to its colour; 0 for spectra
    // What `diffuse` is made of:
    double directions;  ///< what the wavelengths share: shadowing, effective roughness
    double phi;         ///< the full Phi instead of one exponential
    double
        rest;  ///< Fresnel, the rest of the lobe, the uniform term; of other models, and of tables, all of it
    double interpolation;  ///< from the rung's wavelengths to the scene's; not spent on colours
};

/// Measures an evaluator on random pairs.
///   forms   of the material, to tell where the time goes
[[nodiscard]] PlanCost plan_cost(const spectral::Scene& scene, const spectral::MaterialForms& forms,
                                 const spectral::PlannedForm& form);

}  // namespace hts::tables
