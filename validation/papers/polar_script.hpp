/// The gnuplot script of a half-circle polar plot.
#pragma once

#include <string>
#include <vector>

#include "spectral/output/script.hpp"
#include "validation/papers/polar_curves.hpp"

namespace hts::validation {

struct PolarStyle {
    std::string title;
    std::vector<std::string> captions;  ///< lines below that say what the radius is
    std::string data_file;              ///< CSV with view_angle_deg in column 2 and radius in the last, 6
    bool logarithmic = false;           ///< radius from `decades` below the outermost circle
    int decades = 4;
};

/// The variables theta_i[], first[] and last[] of curves that stand in a CSV one after the other, a row per
/// point.
output::Script& set_curves(output::Script& script, const std::vector<PolarCurve>& curves);

/// Surface normal up, light from the left: view angles from -90 deg (left) to 90 deg (right).
[[nodiscard]] std::string polar_script(const std::vector<PolarCurve>& curves, const PolarStyle& style);

/// Log BRDF over log |beta - beta_0|, both sides of the mirror direction, from a CSV with |beta - beta_0| in
/// column 4 and the BRDF in column 7, the side beyond the mirror direction of each curve before the side
/// within. hts::Error for a curve that is 0.
[[nodiscard]] std::string sine_script(const std::vector<SineCurve>& curves, const std::string& title,
                                      const std::string& data_file);

}  // namespace hts::validation
