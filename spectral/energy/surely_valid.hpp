/// Most verdicts without the work of one. Not installed.
#pragma once

#include "hts/terms.hpp"
#include "spectral/energy/validity.hpp"

namespace hts::spectral {

/// Whether bounds already tell that `validity` finds nothing outside; where they do not, it must be asked.
///   formula   cos theta_d >= (cos theta_i + cos theta_r) / 2; and with cot theta >= 2 sigma_0/tau on both
///             sides S_1 >= 0.898, so that neither shadowing nor the mirror's loss can pass its limit
///   cost      a tenth of a verdict
[[nodiscard]] bool surely_valid(const Surface& surface, const DirectionPair& pair,
                                const Wavelength& wavelength) noexcept;

}  // namespace hts::spectral
