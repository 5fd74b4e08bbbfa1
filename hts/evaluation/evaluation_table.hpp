// Coefficients of the lane kernel, written by hts/evaluation/generate_evaluation_tables.cpp.
#pragma once

#include <array>
#include <cstddef>

namespace hts::evaluation_detail {

/// 2^f on [-1/2, 1/2] in powers of f.
///   error   relative, at most 6e-11
extern const std::array<double, 8> exp2_coefficients;

/// exp(c^2) erfc(c) / y with y = erfcx_centre / (erfcx_centre + c), in powers of a position from -1/2 to 1/2
/// in y; 0 <= c <= erfcx_far, beyond which erfc(c) < 4e-20.
///   error   relative, at most 3e-11
extern const std::array<double, 12> erfcx_coefficients;
inline constexpr double erfcx_centre = 2.5;
inline constexpr double erfcx_far = 6.5;

/// 1 + W_0(x) in pieces of octaves of v = 1 + e x, since W_0 branches at v = 0 and octaves of v converge
/// alike; in powers of the position from -1/2 to 1/2 within a piece.
///   domain  1 <= v < 2^lambert_octaves      error   relative, at most 5e-12
inline constexpr int lambert_octaves = 32;
inline constexpr int lambert_log2_pieces = 2;  // per octave
inline constexpr std::size_t lambert_coefficients_per_piece = 8;
extern const std::array<double, std::size_t{lambert_octaves} * 4 * 8> lambert_coefficients;

// The same for lanes of single precision.

/// error   relative, at most 4e-7
extern const std::array<float, 8> single_erfcx_coefficients;
/// 1 + W_0 and its reciprocal, interleaved, in pieces as above, twice as many.
///   error   relative, at most 5e-7
inline constexpr int single_lambert_log2_pieces = 3;
inline constexpr std::size_t single_lambert_row = 8;  // four powers of each
extern const std::array<float, std::size_t{lambert_octaves} * 8 * 8> single_lambert_coefficients;

}  // namespace hts::evaluation_detail
