#include "validation/fit/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/statistics.hpp"

namespace hts::validation {
namespace {

constexpr std::size_t most_parts = 10;

double angle_of(const Curve& curve, const CurvePoint& point) {
    return curve.sweep == Sweep::scattered ? point.theta_i : curve.fixed_angle();
}

/// The points whose angle is wanted, and no empty curves.
CurveSet with_angles(const CurveSet& set, const std::function<bool(double angle)>& wanted) {
    CurveSet result = set;
    for (Curve& curve : result.curves) {
        const bool scattered = curve.sweep == Sweep::scattered;
        const double fixed = scattered ? 0 : curve.fixed_angle();
        std::erase_if(curve.points,
                      [&](const CurvePoint& point) { return !wanted(scattered ? point.theta_i : fixed); });
    }
    std::erase_if(result.curves, [](const Curve& curve) { return curve.points.empty(); });
    return result;
}

/// First and last angle of each part.
std::vector<LeftOut> parts_of(const CurveSet& set) {
    constexpr double apart = 0.01;  // [deg]
    std::vector<double> angles;
    for (const Curve& curve : set.curves)
        for (const CurvePoint& point : curve.points) angles.push_back(angle_of(curve, point));
    std::ranges::sort(angles);
    std::vector<double> distinct;
    for (const double angle : angles)
        if (distinct.empty() || angle > distinct.back() + apart) distinct.push_back(angle);
    if (distinct.size() < 2)
        throw Error{set.stem + ": one angle of incidence alone: must be two, to leave one out"};
    const std::size_t parts = std::min(distinct.size(), most_parts);
    std::vector<LeftOut> result;
    for (std::size_t i = 0; i < parts; ++i) {
        const std::size_t first = i * distinct.size() / parts, next = (i + 1) * distinct.size() / parts;
        result.push_back({distinct[first], next < distinct.size() ? distinct[next] - apart : 90 + apart, {}});
    }
    return result;
}

/// A point that was left out, and what was predicted of it.
struct Missed {
    double predicted, measured, cos_theta_i;
};

PredictionError error_of(const std::vector<Missed>& points, double noise_floor) {
    std::vector<double> logs, differences, with_cosine;
    for (const Missed& point : points) {
        if (const auto log = log_ratio(point.predicted, point.measured, noise_floor))
            logs.push_back(std::abs(*log));
        differences.push_back(point.predicted - point.measured);
        with_cosine.push_back(differences.back() * point.cos_theta_i);
    }
    return {points.size(), logs.empty() ? 0 : spectral::median(logs), spectral::root_mean_square(logs),
            spectral::root_mean_square(differences), spectral::root_mean_square(with_cosine)};
}

/// The request with searches that start where a fit ended.
FitRequest from(const Fit& fit) {
    FitRequest request = fit.request;
    request.followed_starts = 1;
    for (const FittedParameter& parameter : fit.parameters) {
        const bool moves = parameter.outcome == Outcome::fitted || parameter.outcome == Outcome::at_bound;
        if (moves && parameter.name != "scale" && parameter.name.find('@') == std::string::npos)
            request.starts[parameter.name] = parameter.value;
    }
    return request;
}

}  // namespace

CrossValidation cross_validated(const Fit& fit, std::span<const CurveSet> sets,
                                const FitSelection& selection) {
    const FitSelection chosen = for_residual(selection, fit.request.residual, sets.front());
    const CurveSet whole = selected(sets.front(), chosen);
    FitSelection all = chosen;
    all.most_points = 0;
    const FitRequest request = from(fit);
    const double floor = whole.noise_floor.value_or(0);
    CrossValidation result{parts_of(whole), {}};
    std::vector<Missed> points;
    const spectral::Job job{"leaving out angles", result.parts.size()};
    for (LeftOut& part : result.parts) {
        const auto inside = [&](double angle) {
            return angle >= part.first_angle && angle < part.last_angle;
        };
        std::vector<CurveSet> rest{sets.begin(), sets.end()};
        rest.front() = with_angles(whole, [&](double angle) { return !inside(angle); });
        const CurveSet held = with_angles(whole, inside);
        const Fit without = fitted(request, fit_data(rest, all));
        const auto values = Prediction{held, chosen.nodes}.values(fitted_material(without), chosen.outside);
        const double scale = without.parameter("scale").value;
        std::vector<Missed> of_part;
        std::size_t i = 0;
        double last = part.first_angle;
        for (const Curve& curve : held.curves) {
            for (const CurvePoint& point : curve.points) {
                last = std::max(last, angle_of(curve, point));
                of_part.push_back(
                    {scale * values[i++], point.value, std::cos(point.theta_i * std::numbers::pi / 180)});
            }
        }
        part.last_angle = last;
        part.error = error_of(of_part, floor);
        points.insert(points.end(), of_part.begin(), of_part.end());
        job.done();
    }
    result.all = error_of(points, floor);
    return result;
}

}  // namespace hts::validation
