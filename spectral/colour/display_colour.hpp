/// Colours on a screen: CIE XYZ adapted to the white of sRGB, as linear and as display sRGB, and back.
///
/// Source: sRGB of IEC 61966-2-1 [IEC61966]; chromatic adaptation by the linear Bradford transform (Lam 1985)
/// [Lam85].
///
/// Conventions: XYZ as in spectral/colour/colour.hpp, Y = 1 for the perfect white; linear components are 1
/// for it. Colours out of gamut keep their values; only `DisplayRgb` clips, and says so.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "spectral/colour/colour.hpp"

namespace hts::accuracy {
/// Of decoding what was encoded, absolute, largest at the joint of the two branches of [IEC61966].
inline constexpr double srgb_round_trip = 4e-9;
}  // namespace hts::accuracy

namespace hts::spectral {

/// The colour that looks under one white as `colour` does under another.
///   formula   M^-1 diag(cone response of `to` / of `from`) M, M of Bradford [Lam85]
///   domain    whites with positive cone responses, as every illuminant has
[[nodiscard]] Xyz bradford_adaptation(const Xyz& colour, const Xyz& from_white, const Xyz& to_white) noexcept;

/// Red, green and blue proportional to light, of the sRGB primaries and white; no invariant: outside 0 ... 1
/// the colour is out of gamut.
struct LinearRgb {
    double red, green, blue;
};

/// Linear sRGB of a colour seen under an illuminant.
///   formula   Bradford adaptation from the illuminant's white to that of sRGB (x = 0.3127, y = 0.3290), then
///             the matrix that follows from the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and that
///             white, unrounded; [IEC61966] prints it with four decimals. For D65 the adaptation only removes
///             the 1e-4 between the table's white and the rounded (0.3127, 0.3290)
///   limits    the perfect white is (1, 1, 1) under both illuminants, to rounding
[[nodiscard]] LinearRgb linear_srgb(const Xyz& colour, Illuminant illuminant) noexcept;

/// Inverse of `linear_srgb`.
[[nodiscard]] Xyz tristimulus(const LinearRgb& rgb, Illuminant illuminant) noexcept;

/// sRGB as sent to a screen: each component 0 ... 1, encoded by the transfer function of [IEC61966].
class DisplayRgb {
  public:
    /// Encodes 12.92 v up to v = 0.0031308, 1.055 v^(1/2.4) - 0.055 above. A component outside 0 ... 1 is
    /// clipped, NaN to 0; then `in_gamut` is false, unless it lies outside by rounding only (1e-9).
    [[nodiscard]] static DisplayRgb from_linear(const LinearRgb& rgb) noexcept;

    [[nodiscard]] double red() const noexcept { return red_; }
    [[nodiscard]] double green() const noexcept { return green_; }
    [[nodiscard]] double blue() const noexcept { return blue_; }
    /// False if the colour had to be clipped.
    [[nodiscard]] bool in_gamut() const noexcept { return in_gamut_; }

    /// Decodes; what `from_linear` was given, if that was in gamut.   error   accuracy::srgb_round_trip
    [[nodiscard]] LinearRgb linear() const noexcept;
    /// Red, green, blue as 0 ... 255, rounded to nearest.
    [[nodiscard]] std::array<std::uint8_t, 3> eight_bit() const noexcept;
    /// "#rrggbb" in small letters.
    [[nodiscard]] std::string hex() const;

  private:
    DisplayRgb(double red, double green, double blue, bool in_gamut) noexcept
        : red_{red}, green_{green}, blue_{blue}, in_gamut_{in_gamut} {}

    double red_, green_, blue_;
    bool in_gamut_;
};

}  // namespace hts::spectral
