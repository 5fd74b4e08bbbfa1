/// Whether a value of a rough surface can be believed, by what is known of its own theory: one rule for
/// every answer. Not installed.
///
///   he           its assumptions: `validity` at the pair of directions
///   he_unified   makes fewer of them, and is judged by its expected distance from exact scattering
///                (expected_distance.hpp) of unpolarised light at the angle of incidence: fine up to
///                `fine_distance`, outside above `greatest_distance` and where nothing like it was solved
#pragma once

#include <optional>

#include "spectral/energy/expected_distance.hpp"
#include "spectral/energy/rough_surface.hpp"
#include "spectral/energy/validity.hpp"

namespace hts::spectral {

inline constexpr double fine_distance = 0.5, greatest_distance = 1;  ///< [dB]

/// Whether a surface's theory is judged by its distance from exact scattering.
[[nodiscard]] bool judged_by_distance(const RoughSurface& surface) noexcept;

struct Judgement {
    Severity severity;
    std::optional<Decibels> error;  ///< expected, of unpolarised light; none where it is unknown
};
///   cost   of he_unified some 3 microseconds, which do not depend on the view
[[nodiscard]] Judgement judgement(const RoughSurface& surface, const DirectionPair& pair,
                                  const SpectralSample& sample);
/// The same of a surface that is judged by distance, from what is expected of it.
[[nodiscard]] Judgement judgement(const ExpectedDistance& expected) noexcept;

}  // namespace hts::spectral
