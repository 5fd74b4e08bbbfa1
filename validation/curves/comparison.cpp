#include "validation/curves/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/statistics.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

/// Adds up figures point by point.
class Sums {
  public:
    explicit Sums(const CurveSet& set) : floor_{set.noise_floor.value_or(0)} {}

    void add(const CurvePoint& point, double model) {
        const double difference = model - point.value;
        differences_.push_back(difference);
        measured_.push_back(point.value);
        if (point.uncertainty > 0) normalised_.push_back(difference / point.uncertainty);
        if (const auto log = log_ratio(model, point.value, floor_)) logs_.push_back(*log);
    }
    [[nodiscard]] FiguresOfMerit figures(int free_parameters) const {
        FiguresOfMerit result;
        result.points = differences_.size();
        result.without_log = differences_.size() - logs_.size();
        std::vector<double> magnitudes;
        for (const double x : logs_) {
            magnitudes.push_back(std::abs(x));
            result.mean_log += x / static_cast<double>(logs_.size());
        }
        result.median_abs_log = spectral::median(std::move(magnitudes));
        result.rms_log = spectral::root_mean_square(logs_);
        result.rms = spectral::root_mean_square(differences_);
        const double size = spectral::root_mean_square(measured_);
        result.relative_rms = size > 0 ? result.rms / size : 0;
        const double n = static_cast<double>(normalised_.size()), freedom = n - free_parameters;
        if (!normalised_.empty() && freedom > 0)
            result.reduced_chi_squared = std::pow(spectral::root_mean_square(normalised_), 2) * n / freedom;
        return result;
    }

  private:
    double floor_;
    std::vector<double> differences_, measured_, normalised_, logs_;
};

/// Calls `visit(curve, point, model)` for every point.
template <class Visit>
void for_points(const CurveSet& set, std::span<const double> model, const Visit& visit) {
    std::size_t i = 0;
    for (const Curve& curve : set.curves)
        for (const CurvePoint& point : curve.points) visit(curve, point, model[i++]);
}

double common_scale(const CurveSet& set, std::span<const double> model) {
    std::vector<double> logs;
    for_points(set, model, [&](const Curve&, const CurvePoint& point, double value) {
        if (value > 0 && point.value > 0) logs.push_back(std::log(point.value / value));
    });
    return std::exp(spectral::median(std::move(logs)));
}

CurveMaximum maximum(const Curve& curve, std::span<const double> model) {
    const auto& points = curve.points;
    const auto measured =
        std::max_element(points.begin(), points.end(),
                         [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
    const auto computed = std::max_element(model.begin(), model.end());
    const bool at_end = measured == points.begin() || measured + 1 == points.end();
    const CurvePoint& of_model = points[static_cast<std::size_t>(computed - model.begin())];
    return {curve.fixed_angle(), curve.swept_angle(*measured), curve.swept_angle(of_model), at_end};
}

// ---- criteria

/// Between machines the minimum of a fit is found a little elsewhere.
constexpr double of_fits = 0.05;

Check median_criterion(const CurveSet& set, const Comparison& result) {
    constexpr double bound = 0.25, largest = 80;
    const FiguresOfMerit figures = figures_of_merit(set, result.model, {.largest_theta_i = largest});
    return {"median |ln(model / measured)| at most " + brief(bound) + " up to " + brief(largest) +
                " deg incidence",
            brief(figures.median_abs_log, 3) + " (" + std::to_string(figures.points) + " points)",
            figures.median_abs_log <= bound && figures.points > figures.without_log &&
                std::ranges::all_of(result.model, [](double value) { return value > 0; }),
            "", of_fits};
}

Check maxima_criterion(const Comparison& result) {
    constexpr double bound = 6;
    constexpr std::array cameras{20.0, 30.0, 40.0, 45.0, 50.0, 60.0, 70.0};
    std::string measured;
    double worst = 0;
    for (const CurveMaximum& m : result.maxima) {
        if (std::find(cameras.begin(), cameras.end(), m.fixed_angle) == cameras.end()) continue;
        worst = std::max(worst, std::abs(m.off()));
        if (!measured.empty()) measured += "; ";
        measured +=
            brief(m.fixed_angle) + ": " + brief(m.computed_angle) + ", measured " + brief(m.measured_angle);
    }
    return {
        "off-specular maxima within " + brief(bound) + " deg of the measured ones, cameras at 20 ... 70 deg",
        "worst " + brief(worst) + " deg (" + measured + ")", worst <= bound && !measured.empty(), "",
        of_fits};
}

Check plateau_criterion(const CurveSet& set, const Comparison& result) {
    constexpr double expected = 0.030, bound = 0.05;
    const Plateau found = plateau(set, result.model, {60, 60, 10});
    return {"plateau within " + brief(100 * bound) + " % of " + brief(expected) + " 1/sr at 460 nm",
            brief(found.computed) + " 1/sr, measured " + brief(found.measured),
            std::abs(found.computed / expected - 1) <= bound,
            "medians up to 60 deg, at least 10 deg from the mirror direction", of_fits};
}

}  // namespace

bool PointRange::holds(const CurvePoint& point) const {
    if (point.theta_i > largest_theta_i || point.theta_r > largest_theta_r) return false;
    if (least_from_mirror == 0) return true;
    const DirectionPair pair = point.pair();
    return dot(pair.in.mirror().vector(), pair.out.vector()) <=
           std::cos(least_from_mirror * std::numbers::pi / 180);
}

FiguresOfMerit figures_of_merit(const CurveSet& set, std::span<const double> model, const PointRange& range,
                                int free_parameters) {
    Sums sums{set};
    for_points(set, model, [&](const Curve&, const CurvePoint& point, double value) {
        if (range.holds(point)) sums.add(point, value);
    });
    return sums.figures(free_parameters);
}

Comparison comparison(const CurveSet& set, std::vector<double> model, int free_parameters) {
    if (model.size() != set.point_count())
        throw Error{"model values " + std::to_string(model.size()) + ": must be " +
                    std::to_string(set.point_count()) + ", one for each point"};
    Comparison result;
    if (set.scale == Scale::unknown) result.scale = common_scale(set, model);
    for (double& value : model) value *= result.scale;
    result.model = std::move(model);
    Sums all{set};
    std::size_t first = 0;
    for (const Curve& curve : set.curves) {
        const std::span of_curve{result.model.data() + first, curve.points.size()};
        Sums sums{set};
        for (std::size_t i = 0; i < of_curve.size(); ++i) {
            sums.add(curve.points[i], of_curve[i]);
            all.add(curve.points[i], of_curve[i]);
        }
        result.of_curves.push_back(sums.figures(0));
        if (curve.sweep != Sweep::scattered) result.maxima.push_back(maximum(curve, of_curve));
        first += curve.points.size();
    }
    result.figures = all.figures(free_parameters);
    return result;
}

Plateau plateau(const CurveSet& set, std::span<const double> model, const PointRange& range) {
    std::vector<double> measured, computed;
    for_points(set, model, [&](const Curve&, const CurvePoint& point, double value) {
        if (!range.holds(point)) return;
        measured.push_back(point.value);
        computed.push_back(value);
    });
    return {spectral::median(std::move(measured)), spectral::median(std::move(computed))};
}

std::string roughness_statement(double rms_um, const MeasuredRoughness& measured) {
    const double factor = rms_um / measured.rms_um;
    const std::string relation = std::abs(std::log(factor)) < 0.05 ? "as large as"
                                 : factor < 1                      ? brief(1 / factor, 2) + " times below"
                                                                   : brief(factor, 2) + " times above";
    return "sigma0 " + brief(rms_um, 3) + " um is " + relation + " the rms roughness measured, " +
           brief(measured.rms_um) + " um (" + measured.method + ")";
}

std::vector<Check> criteria(const CurveSet& set, const Comparison& result, bool of_every_surface) {
    const bool sandblasted = set.stem == "mwir-aluminium-sandblasted";
    std::vector<Check> checks;
    if (sandblasted || of_every_surface) checks.push_back(median_criterion(set, result));
    if (sandblasted) checks.push_back(maxima_criterion(result));
    if (set.stem == "blue-acrylic") checks.push_back(plateau_criterion(set, result));
    return checks;
}

}  // namespace hts::validation
