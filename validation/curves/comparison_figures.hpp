/// Pictures of a comparison: measured points and computed lines, on a logarithmic axis and in polar form, and
/// what is between them. Each says by whom its points were measured.
#pragma once

#include <string>
#include <vector>

#include "validation/curves/comparison.hpp"
#include "validation/curves/prediction.hpp"

namespace hts::validation {

/// The curves of a set at every half degree, with the model's values: what is drawn as lines. Those of
/// scattered pairs are without points, and there are no lines at all if none has any.
[[nodiscard]] std::vector<Curve> model_lines(const CurveSet& set, const spectral::Material& material,
                                             const AveragingNodes& nodes, spectral::OutsideRange policy,
                                             double scale = 1);

/// What a comparison is drawn from.
struct ComparisonPicture {
    const CurveSet& set;
    const Comparison& result;
    const std::vector<Curve>& lines;  ///< of `model_lines`
    std::string model;                ///< what the lines are: "He-Torrance, sigma_0 = 0.3 um, …"
    std::string stem;                 ///< of all files

    /// "measured by …", "digitised by …" or "computed by …".
    [[nodiscard]] std::string by() const;
};

/// A panel per curve, logarithmic; scattered pairs against the tilt of the facet that would mirror them.
[[nodiscard]] Figure log_overlay(const ComparisonPicture& picture);
/// Up to five of the in-plane curves; logarithmic over four decades where the values span more than
/// thirtyfold.
[[nodiscard]] Figure polar_overlay(const ComparisonPicture& picture);
/// ln(model / measured) of every point.
[[nodiscard]] Figure residual_plot(const ComparisonPicture& picture);

}  // namespace hts::validation
