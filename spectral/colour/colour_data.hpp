/// The CIE tables behind spectral/colour/colour.hpp, for who needs the raw figures: one row per 5 nm.
///
/// Source: CIE 1931 standard colorimetric observer (2 degrees) and CIE standard illuminant D65, as tabulated
/// in CIE 015:2018 Colorimetry (ISO/CIE 11664-1, -2). Numerical facts, transcribed from Mitsuba 3 (the
/// observer from src/core/spectrum.cpp, D65 from its spectrum test) and then compared by program: all 380
/// values are the same doubles in ArgyllCMS 2.3.1 (every fifth value of its 1 nm observer; its 5 nm D65), and
/// the observer at 10 nm is the same in python-colormath 3.0.
#pragma once

#include <array>

namespace hts::spectral {

/// What the observer and D65 are at one wavelength.
struct ColourRow {
    double nanometres;
    double x, y, z;  ///< colour-matching functions x_bar, y_bar, z_bar [1]; y_bar is 1 at 555 nm
    double d65;      ///< relative spectral power [1], 100 at 560 nm

    /// [um]
    [[nodiscard]] double wavelength() const noexcept { return nanometres / 1000; }
};

/// Rows from 360 to 830 nm in steps of 5 nm.
extern const std::array<ColourRow, 95> colour_rows;

inline constexpr double shortest_colour_wavelength = 0.360;  // um
inline constexpr double longest_colour_wavelength = 0.830;   // um
inline constexpr double colour_step = 0.005;                 // um

/// True from 0.36 to 0.83 um, both included.
[[nodiscard]] constexpr bool in_colour_table(double wavelength) noexcept {
    return shortest_colour_wavelength <= wavelength && wavelength <= longest_colour_wavelength;
}

/// Two neighbouring rows with a wavelength `fraction` of the way from the left to the right one.
struct RowsAround {
    const ColourRow& left;
    const ColourRow& right;
    double fraction;  ///< 0 ... 1
};

/// Rows around a finite wavelength [um] inside the table; those at the nearer end for one outside, fraction 0
/// or 1.
[[nodiscard]] RowsAround rows_around(double wavelength) noexcept;

}  // namespace hts::spectral
