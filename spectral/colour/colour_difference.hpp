/// How different two colours look: CIELAB coordinates of a colour and the CIEDE2000 difference of two.
///
/// Source: CIELAB of CIE 015:2018 [CIE15]; CIEDE2000 as written out by Sharma, Wu and Dalal, Color Res. Appl.
/// 30, 21 (2005) [Sharma05].
///
/// Conventions: XYZ as in spectral/colour/colour.hpp; L* from 0 to 100, although the white has Y = 1.
#pragma once

#include "spectral/colour/colour.hpp"

namespace hts::spectral {

/// CIELAB coordinates.
struct Lab {
    double L, a, b;  ///< L* (0 black, 100 white), a* (towards red), b* (towards yellow)
};

/// CIELAB of a colour relative to the white it is seen with.
///   formula   116 f(Y/Yn) - 16, 500 (f(X/Xn) - f(Y/Yn)), 200 (f(Y/Yn) - f(Z/Zn)) [CIE15]; f is the cube root
///             down to (24/116)^3 and goes on below as a straight line
///   white     Xn, Yn, Zn, all > 0; as a rule the `white_point` of the illuminant
[[nodiscard]] Lab cielab(const Xyz& colour, const Xyz& white) noexcept;

/// Colour difference CIEDE2000, with k_L = k_C = k_H = 1.
///   formula   [Sharma05 (2) to (22)]; symmetric; two hues exactly opposite take the branch of 180 deg
///   range     >= 0; about 1 is just noticeable side by side
///   error     rounding; the 34 pairs of [Sharma05] come out to all four decimals printed
[[nodiscard]] double colour_difference(const Lab& a, const Lab& b) noexcept;

}  // namespace hts::spectral
