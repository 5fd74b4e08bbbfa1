/// Sine and cosine of angles in half turns, exact at multiples of a quarter turn. Private to the directions.
///
/// The doubles are those that Boost.Math's values in long double round to, in a third of the time: a table
/// and short series in long double have an error of 2^-63, Boost's of 2^-62, and only where a double's
/// neighbour is as near, once in 200 calls, Boost is asked. Where long double is no longer than double it
/// always is.
#pragma once

namespace hts {

namespace accuracy {

/// Relative error of `sin_half_turns` and `half_turns`.
inline constexpr double half_turns = 1.2e-16;
/// Relative error of cos theta and sin theta of Direction::from_degrees.
inline constexpr double polar_angle_from_degrees = 2.5e-16;
/// Absolute error of its cos phi and sin phi.
inline constexpr double azimuth_from_degrees = 4e-16;

}  // namespace accuracy

/// sin(pi x).
///   domain   |x| <= 1      error   relative, at most accuracy::half_turns      cost   some 20 ns
[[nodiscard]] double sin_half_turns(double x) noexcept;

struct SineCosine {
    double sine, cosine;
};

/// sin(pi x) and cos(pi x), of the same domain and errors.
[[nodiscard]] SineCosine half_turns(double x) noexcept;

}  // namespace hts
