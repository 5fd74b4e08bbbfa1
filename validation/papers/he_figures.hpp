/// Figures 7 to 11 of He et al. 1991 computed anew, in the paper's axes: theory only, since its measured
/// curves are not available.
///
/// Figs 7 to 10 are polar, the radius normalised to the specular direction [He91 (11)]; Fig. 11 is the BRDF
/// itself, on a logarithmic axis. Peaks are averaged over source and receiver of pi/1024 sr each, in Fig. 11
/// too, whose optics the paper does not give. What it leaves open is chosen: the index of sandpaper (Al2O3)
/// and of the plastic (1.54, whose |F|^2 is the 0.195 - 0.15 of the paper).
#pragma once

#include <vector>

#include "spectral/models/material.hpp"
#include "validation/papers/polar_curves.hpp"
#include "validation/report/report.hpp"

namespace hts::validation {

/// What a figure shows.
struct HeFigure {
    int number;
    spectral::Material material;
    double wavelength;            ///< [um]
    std::vector<double> theta_i;  ///< [deg]
    PolarRadius radius;

    [[nodiscard]] spectral::Reflectance reflectance() const;
    [[nodiscard]] PolarCurve curve(double degrees) const;
};

/// One of 7 ... 11.
[[nodiscard]] HeFigure he_figure(int number);

/// All of them drawn.
[[nodiscard]] std::vector<Figure> he_figures();

/// The figures, and what the paper's text says of them, claim by claim.
[[nodiscard]] Section paper_figures_section(Effort effort);

}  // namespace hts::validation
