/// The lobe of he_unified from Phi and beta of the caller's: those of surfaces that are no Gaussian ones in
/// two dimensions, as of profiles. Not installed.
#pragma once

#include "hts/unified/unified_terms.hpp"

namespace hts {

/// `unified_lobe`, which is this with `kicks(g, t)`.
///   g, t   that the result says
[[nodiscard]] UnifiedLobe lobe_of_kicks(const UnifiedView& in, const UnifiedView& out,
                                        const UnifiedWave& wave, double g, double t,
                                        const Kicks& kicks) noexcept;

}  // namespace hts
