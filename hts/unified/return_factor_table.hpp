// Coefficients of return_factor.hpp, written by hts/unified/generate_return_factor.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "hts/unified/return_factor.hpp"

namespace hts {

/// Chebyshev polynomials of 2 sigma_0/tau - 1.
inline constexpr std::size_t return_factor_slopes = 32;
/// m: by slope polynomials, then by those of 2 y - 1.
extern const std::array<std::array<double, ReturnFactor::terms>, return_factor_slopes> return_factor_table;
/// The single reflection of uniform light, by slope polynomials.
extern const std::array<double, return_factor_slopes> single_reflection_table;

}  // namespace hts
