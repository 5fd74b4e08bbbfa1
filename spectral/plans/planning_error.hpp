/// How far an evaluator is from the full model on a scene's directions. Private to the planner, whose header
/// defines the errors.
#pragma once

#include <vector>

#include "spectral/plans/plan.hpp"

namespace hts::spectral {

/// The pairs on which a material is measured: `sampling.pairs` random ones and a few at
/// the edges of the domain.
[[nodiscard]] std::vector<DirectionPair> planning_pairs(const Scene& scene, const Material& material,
                                                        const PlanSampling& sampling);

/// Measures evaluators of one material.
class ErrorMeter {
  public:
    /// The scene outlives this.
    ErrorMeter(const Scene& scene, const Material& material, const MaterialForms& forms,
               const PlanSampling& sampling);

    /// The error on all pairs.
    [[nodiscard]] MeasuredError error(const PlannedForm& candidate) const;
    /// Whether the error of one of the first pairs exceeds `enough`: spares most of the work.
    [[nodiscard]] bool fails_early(const PlannedForm& candidate, double enough) const;

  private:
    [[nodiscard]] double diffuse_error(const PlannedForm& candidate, std::size_t pair) const;
    [[nodiscard]] double specular_error(const PlannedForm& candidate, std::size_t pair) const;
    void remember_spectra(const PlannedForm& coarse);
    void remember_colours();

    const Scene& scene_;
    PlannedForm full_;
    std::vector<DirectionPair> pairs_;
    std::vector<double> spectra_, scales_;  // pairs x wavelengths: BRDF, and what its error is relative to
    std::vector<Xyz> colours_, specular_colours_;  // one per pair, for colour differences
    Xyz white_{};
};

}  // namespace hts::spectral
