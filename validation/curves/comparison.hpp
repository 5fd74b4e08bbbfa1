/// How far a model is from a set of curves: residuals in log and linear, chi squared, where the maxima lie,
/// and the criteria that are asked of some sets.
///
///     const Prediction prediction{set};
///     const Comparison result = comparison(set, prediction.values(reflector));
///     std::cout << result.figures.median_abs_log;
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/curves/curve.hpp"
#include "validation/report/report.hpp"

namespace hts::validation {

/// Averages over points; those of logarithms are of `log_ratio`, over points where there is one.
struct FiguresOfMerit {
    std::size_t points = 0;
    std::size_t without_log = 0;  ///< points where one of both is 0 and no noise floor is stated
    double median_abs_log = 0;    ///< of |ln(model / measured)|
    double rms_log = 0;           ///< of ln(model / measured)
    double mean_log = 0;          ///< of ln(model / measured): the model's bias
    double rms = 0;               ///< of model - measured, in the unit of the values
    double relative_rms = 0;      ///< rms over the root mean square of the measured values
    /// Sum of ((model - measured)/uncertainty)^2 over points - free parameters; none without uncertainties or
    /// points to spare.
    std::optional<double> reduced_chi_squared{};
};

/// The largest value of a curve, as measured and as computed, among the points that were measured.
struct CurveMaximum {
    double fixed_angle;                     ///< of the direction that stands still [deg]
    double measured_angle, computed_angle;  ///< swept [deg]
    bool at_end;  ///< measured at an end of the curve, so the maximum may lie beyond

    [[nodiscard]] double off() const noexcept { return computed_angle - measured_angle; }
};

struct Comparison {
    std::vector<double> model;  ///< at each point of all curves in order, times `scale`
    double scale = 1;           ///< of a set of unknown scale: the median of measured / model
    FiguresOfMerit figures;
    std::vector<FiguresOfMerit> of_curves;
    std::vector<CurveMaximum> maxima;  ///< of the in-plane curves
};

/// Which points count.
struct PointRange {
    double largest_theta_i = 90, largest_theta_r = 90;  ///< [deg]
    double least_from_mirror = 0;                       ///< of the viewer and the mirror direction [deg]

    [[nodiscard]] bool holds(const CurvePoint& point) const;
};

///   model             values of all points in order, as `Prediction::values` gives them; else hts::Error
///   free_parameters   fitted to this set
[[nodiscard]] Comparison comparison(const CurveSet& set, std::vector<double> model, int free_parameters = 0);

/// The figures of some of the points.
///   model   as in Comparison::model
[[nodiscard]] FiguresOfMerit figures_of_merit(const CurveSet& set, std::span<const double> model,
                                              const PointRange& range, int free_parameters = 0);

/// The middle of measured and of computed values far from the mirror direction: what is left of a diffuse
/// plateau.
struct Plateau {
    double measured, computed;
};

/// Medians over the points in a range.
[[nodiscard]] Plateau plateau(const CurveSet& set, std::span<const double> model, const PointRange& range);

/// "sigma0 0.26 um is 4.7 times below the rms roughness measured, 1.222 um (optical profiler, 50x)".
[[nodiscard]] std::string roughness_statement(double rms_um, const MeasuredRoughness& measured);

/// What is asked of a set by name: of "mwir-aluminium-sandblasted" the median deviation and the maxima, of
/// "blue-acrylic" the plateau; nothing of others.
///   of_every_surface   the median deviation of all, as a report asks it
[[nodiscard]] std::vector<Check> criteria(const CurveSet& set, const Comparison& result,
                                          bool of_every_surface = false);

}  // namespace hts::validation
