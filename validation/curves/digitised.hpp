/// Values of a printed figure from the pixels where its curves run.
///
/// The file is JSON:
///
///     {"axes": {"type": "cartesian",                                   or  {"type": "polar",
///               "angle": [[px, py, deg], [px, py, deg]],         "centre": [px, py], "centre_value": 0,
///               "value": [[px, py, value], [px, py, value]],     "reference": [px, py, deg, value],
///               "value_scale": "linear" | "log"},                "value_scale": "linear" | "log"},
///      "reading_px": 0.5,
///      "curves": [{"wavelength_um": 0.5, "theta_i_deg": 10, "pixels": [[px, py], …]}, …]}
///
/// Angles are those of the viewer in the plane of incidence. Of a cartesian figure two points on (or parallel
/// to) each axis are enough, the page may lie askew. Of a polar one the radius is the value, the centre where
/// the radius is zero (0 on a linear scale, the smallest value on a logarithmic one) and the reference a
/// point of known angle and value; angles grow clockwise, as in the figures of He et al. 1991 with the light
/// on the left. Pixels count right and down.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/curves/curve.hpp"

namespace hts::validation {

struct Pixel {
    double x, y;
};

/// What an axis calibration makes of a pixel.
struct FigureReading {
    double angle;  ///< of the viewer [deg]
    double value;
};

class FigureAxes {
  public:
    /// A pixel of known position on one axis.
    struct Mark {
        Pixel at;
        double value;
    };

    /// hts::Error if the marks of an axis coincide, in place or value, if the axes are parallel, or if a
    /// value on a logarithmic axis is not > 0.
    [[nodiscard]] static FigureAxes cartesian(const Mark& angle_1, const Mark& angle_2, const Mark& value_1,
                                              const Mark& value_2, bool logarithmic);
    [[nodiscard]] static FigureAxes polar(const Mark& centre, Pixel reference,
                                          const FigureReading& at_reference, bool logarithmic);

    [[nodiscard]] FigureReading operator()(Pixel pixel) const noexcept;
    /// Change of the value for one pixel along the value's axis there.
    [[nodiscard]] double value_per_pixel(Pixel pixel) const noexcept;

  private:
    [[nodiscard]] double value_at(double position) const noexcept;

    bool polar_ = false, logarithmic_ = false;
    Mark angle_1_{}, angle_2_{}, value_1_{},
        value_2_{};  // polar: the centre is value_1_, the reference value_2_ and angle_1_
};

/// The curves in such a file: digitised points with the uncertainty of `reading_px`. hts::Error "path: key
/// "…": …".
[[nodiscard]] std::vector<Curve> digitised_curves(const std::filesystem::path& path);

}  // namespace hts::validation
