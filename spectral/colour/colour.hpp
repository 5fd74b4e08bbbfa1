/// The colour of a spectrum: CIE XYZ of a sampled reflectance or BRDF under an illuminant.
///
/// Source: observer and illuminants CIE 015:2018 [CIE15], tables in spectral/colour/colour_data.hpp.
///
/// Conventions: wavelengths in micrometres; X, Y and Z relative to the perfect white reflector, whose Y is 1
/// (not 100). A reflecting surface is coloured by its radiance factor, and for a BRDF f [1/sr] that is pi f:
/// the perfect diffuser has f = 1/pi and comes out white, a gloss peak may exceed Y = 1. Nothing is clipped.
/// For a screen go on with spectral/colour/display_colour.hpp, to compare with
/// spectral/colour/colour_difference.hpp.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace hts::accuracy {
/// Of X, Y and Z of a reflectance 0 ... 1, absolute, against the CIE's sum at 1 nm: what remains of joining
/// the 5 nm tables by straight lines. The sampling of the reflectance itself comes on top.
inline constexpr double tristimulus = 2e-3;
/// Of the chromaticities of the two whites against the published figures, absolute.
inline constexpr double white_chromaticity = 1e-4;
}  // namespace hts::accuracy

namespace hts::spectral {

/// CIE 1931 tristimulus values; no invariant.
struct Xyz {
    double X, Y, Z;
};

[[nodiscard]] constexpr Xyz operator+(const Xyz& a, const Xyz& b) noexcept {
    return {a.X + b.X, a.Y + b.Y, a.Z + b.Z};
}
[[nodiscard]] constexpr Xyz operator*(double s, const Xyz& a) noexcept {
    return {s * a.X, s * a.Y, s * a.Z};
}

/// Colour without its luminance [1]; no invariant.
struct Chromaticity {
    double x, y;
};

/// Chromaticity x = X/(X + Y + Z), y = Y/(X + Y + Z); (0, 0) for black, which has none.
[[nodiscard]] Chromaticity chromaticity(const Xyz& colour) noexcept;

enum class Illuminant {
    E,    ///< equal power at every wavelength
    D65,  ///< CIE standard daylight of 6500 K
};

/// Illuminant from its name, "E" or "D65", else hts::Error `illuminant "F2": must be one of E, D65`.
[[nodiscard]] Illuminant illuminant_named(std::string_view text);
/// "E" or "D65".
[[nodiscard]] const char* name(Illuminant illuminant) noexcept;

/// Colour-matching functions (x_bar, y_bar, z_bar) of the 2-degree observer at a wavelength.
///   wavelength   [um]; linear between the 5 nm nodes, 0 outside 0.36 ... 0.83 um
[[nodiscard]] Xyz colour_matching(double wavelength) noexcept;

/// Relative spectral power of an illuminant, 100 at 0.56 um.
///   wavelength   [um]; linear between the 5 nm nodes, 0 outside 0.36 ... 0.83 um
[[nodiscard]] double relative_power(double wavelength, Illuminant illuminant) noexcept;

/// XYZ of the perfect white reflector, Y = 1.
///   error   accuracy::white_chromaticity of (0.31272, 0.32903) for D65, of (1/3, 1/3) for E
[[nodiscard]] Xyz white_point(Illuminant illuminant) noexcept;

/// What each sample of a spectrum adds to X, Y and Z: made once by `tristimulus_weights` for all spectra on a
/// wavelength grid.
///   formula   X = k integral S(l) x_bar(l) R(l) dl, likewise Y and Z; k from Y = 1 for R = 1 [CIE15]
///   rule      R is joined by straight lines between its samples and constant beyond the first and last;
///             S x_bar is joined by straight lines between the 5 nm nodes. The product is integrated exactly
///             over 0.36 ... 0.83 um, so the grid may be as irregular or fine as it likes
///   error     accuracy::tristimulus for samples that straight lines join well
class TristimulusWeights {
  public:
    /// XYZ of a reflectance or radiance factor R, one value per wavelength of the grid; hts::Error if their
    /// numbers differ. Values are not checked: any finite R goes, the result is linear in it.
    [[nodiscard]] Xyz operator()(std::span<const double> reflectance) const;
    /// XYZ of a BRDF [1/sr]: that of its radiance factor, pi times the BRDF.
    [[nodiscard]] Xyz of_brdf(std::span<const double> brdf) const;
    /// Luminance factor of a BRDF [1/sr], the Y of `of_brdf`: 1 for the perfect diffuser.
    [[nodiscard]] double luminance_factor(std::span<const double> brdf) const { return of_brdf(brdf).Y; }

    /// One triple per wavelength; they add up to the white point.
    [[nodiscard]] std::span<const Xyz> weights() const noexcept { return weights_; }
    [[nodiscard]] Illuminant illuminant() const noexcept { return illuminant_; }

  private:
    friend TristimulusWeights tristimulus_weights(std::span<const double> wavelengths, Illuminant illuminant);
    TristimulusWeights(std::vector<Xyz> weights, Illuminant illuminant) noexcept;

    std::vector<Xyz> weights_;
    Illuminant illuminant_;
};

/// A spectrum must reach this far to have a colour [um]. Beyond lie, of the white under D65 and E, at most
/// 0.06 % of Y, 0.3 % of X and 0.6 % of Z, small enough to hold the end values there.
inline constexpr double shortest_coverage = 0.40;
inline constexpr double longest_coverage = 0.70;

/// Weights of a wavelength grid under an illuminant, by the rule of `TristimulusWeights`.
///   wavelengths   [um]  at least two, finite, strictly increasing, from <= `shortest_coverage` to
///                 >= `longest_coverage` (to within 1e-9), else hts::Error that says which of these fails
///   cost          a few microseconds, and up to about 0.1 more per wavelength
[[nodiscard]] TristimulusWeights tristimulus_weights(std::span<const double> wavelengths,
                                                     Illuminant illuminant);

/// XYZ of one reflectance or radiance factor: `tristimulus_weights(wavelengths, illuminant)(reflectance)`,
/// with the domain, errors and cost of both steps.
[[nodiscard]] Xyz tristimulus(std::span<const double> wavelengths, std::span<const double> reflectance,
                              Illuminant illuminant);

}  // namespace hts::spectral
