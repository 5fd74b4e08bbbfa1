/// Every model fitted to the same curves, to see which comes closest.
#pragma once

#include <string>
#include <vector>

#include "validation/fit/cross_validation.hpp"
#include "validation/fit/fit.hpp"
#include "validation/fit/fit_curves.hpp"

namespace hts::validation {

/// A model as it takes part in a comparison.
struct ModelChoice {
    std::string model;
    int lobes = 1;

    /// "kurt", "kurt 2 lobes".
    [[nodiscard]] std::string label() const;
    [[nodiscard]] bool operator==(const ModelChoice&) const noexcept = default;
};

/// All of the library but those whose trials take long; Kurt's with 1, 2 and 3 lobes. Anisotropic ones with
/// equal widths.
[[nodiscard]] std::vector<ModelChoice> compared_models();

struct ComparisonRequest {
    Residual residual = Residual::logarithmic;
    FitSelection selection{};
    std::string index{};  ///< JSON, of the models that have one; else their n is fitted, and k is 0
    std::size_t followed_starts = 4;
};

/// A fit per model, in their order.
[[nodiscard]] std::vector<Fit> fits_of(const std::vector<ModelChoice>& models, const CurveSet& set,
                                       const ComparisonRequest& request);

[[nodiscard]] ModelChoice choice_of(const Fit& fit);

/// How each of those fits predicts angles of incidence that it has not seen.
[[nodiscard]] std::vector<CrossValidation> cross_validations(const std::vector<Fit>& fits,
                                                             const CurveSet& set,
                                                             const FitSelection& selection);

}  // namespace hts::validation
