/// Derivatives of what the He-Torrance model answers to an instrument. Private to the fits.
#pragma once

#include <span>
#include <vector>

#include "validation/fit/fit_family.hpp"

namespace hts::validation {

/// By sigma_0, tau, a, n and k.
///   numbers   of each of the job's wavelengths, in the order of the family "he"
[[nodiscard]] std::vector<Prediction::Answer> he_torrance_gradient(std::span<const ModelNumbers> numbers,
                                                                   const Prediction::Job& job);

}  // namespace hts::validation
