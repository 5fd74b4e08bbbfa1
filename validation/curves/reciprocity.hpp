/// What a set of curves says about itself: pairs of points that swap light and viewer must have the same
/// BRDF.
#pragma once

#include <cstddef>

#include "validation/curves/curve.hpp"

namespace hts::validation {

/// Two points of a set.
struct ReciprocalPair {
    CurvePoint there, back;
    double log_ratio;  ///< ln(f there / f back)
};

struct Reciprocity {
    std::size_t pairs = 0;      ///< counted once each; points that are their own partner do not count
    double median_abs_log = 0;  ///< of |log_ratio|; 0 without pairs
    double rms_log = 0;
    ReciprocalPair worst{};  ///< only with pairs

    /// Relative standard deviation of one value that such pairs suggest: median |ln| / (0.6745 sqrt 2), which
    /// is that of normal errors and does not mind a few wild pairs.
    [[nodiscard]] double relative_uncertainty() const noexcept;
};

/// Pairs of the same band whose polar angles swap and whose azimuths differ by the same, left or right, to
/// 1e-6 deg: of an isotropic surface. Values <= 0 do not count.
///   domain   quantities are turned into BRDFs first; Scale::specular has no reciprocity, so gives no pairs
[[nodiscard]] Reciprocity reciprocity(const CurveSet& set);

}  // namespace hts::validation
