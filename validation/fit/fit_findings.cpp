#include "validation/fit/fit_findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "spectral/text/text.hpp"
#include "validation/curves/comparison.hpp"
#include "validation/curves/isotropy.hpp"

namespace hts::validation {
namespace {

using Statements = std::vector<std::string>;

std::string rounded_text(double value) {
    return spectral::brief(value, 3);
}

std::string with_error(const Ratio& ratio) {
    return rounded_text(ratio.value) + " +- " + rounded_text(ratio.standard_error);
}

// ---- the specular term

/// A specular term that would stand out of the data.
struct MirrorPeak {
    double theta_i;      // [deg]
    double reflectance;  // of the fitted specular term
    double solid_angle;  // of the detector in which it would be as large as what was measured [sr]
};

/// The peak that the largest detector would still show; none where no point lies in a mirror direction.
std::optional<MirrorPeak> most_visible_peak(const Fit& fit, const CurveSet& chosen,
                                            spectral::OutsideRange outside) {
    constexpr double in_mirror_direction = 0.3;  // [deg]
    const auto material = fitted_material(fit);
    const double scale = fit.parameter("scale").value;
    std::optional<MirrorPeak> result;
    for (const Curve& curve : chosen.curves) {
        const auto reflectance = material.at(
            Wavelength::from_micrometres((curve.band.first + curve.band.last) / 2), {.outside = outside});
        for (const CurvePoint& point : curve.points) {
            const DirectionPair pair = point.pair();
            const double cosine = dot(pair.in.mirror().vector(), pair.out.vector());
            if (cosine < std::cos(in_mirror_direction * std::numbers::pi / 180) || !(point.value > 0))
                continue;
            const double mirror = reflectance.specular_reflectance(pair.in)[0].value();
            const double cone = scale * mirror / (pair.in.cos_theta() * point.value);
            if (!result || cone > result->solid_angle) result = MirrorPeak{point.theta_i, mirror, cone};
        }
    }
    return result;
}

/// The best fit without a specular term comes nearly as close.
bool rough_is_as_good(const Fit& fit) {
    constexpr double nearly = 2;
    return fit.rough && fit.rough->cost <= nearly * fit.statistics.cost;
}

/// Only sigma0/tau is told, as by the best surface too rough for a specular term.
void tell_slope_alone(Fit& fit) {
    fit.slope = fit.rough->slope;
    fit.slope_alone = true;
    for (FittedParameter& parameter : fit.parameters) {
        if (parameter.outcome == Outcome::fitted && (parameter.name == "sigma0" || parameter.name == "tau"))
            parameter.standard_error = std::numeric_limits<double>::infinity();
    }
}

Statements of_mirror_term(Fit& fit, const CurveSet& chosen, const FitSelection& selection) {
    const bool has_term = fitted_material(fit).properties().specular_term;
    if (!has_term || chosen.source_solid_angle || chosen.detector_solid_angle) return {};
    Statements result{
        "the specular term was not compared: no solid angle of source or detector is stated, so that sigma0 "
        "and tau are not separable but by the shape of the lobe"};
    constexpr double small_detector = 1e-3;  // [sr]; goniometers have smaller ones
    const auto peak = most_visible_peak(fit, chosen, selection.outside);
    if (!peak || peak->solid_angle < small_detector || chosen.scale != Scale::absolute) return result;
    std::string text =
        "the fitted specular term, " + rounded_text(peak->reflectance) + " at " +
        rounded_text(peak->theta_i) + " deg, would stand out of the data in any detector below " +
        rounded_text(std::min(peak->solid_angle, 2 * std::numbers::pi)) + " sr, and they show none: ";
    if (fit.slope_alone) {
        text += "sigma0 is larger";
    } else if (rough_is_as_good(fit)) {
        tell_slope_alone(fit);
        text += "sigma0 and tau apart: only sigma0/tau = " + with_error(*fit.slope) +
                ", of a surface too rough for a specular term";
    } else {
        text += "either the data leave it out, or sigma0 is larger";
    }
    result.push_back(text);
    return result;
}

// ---- what was fitted to

Statements of_values(const Fit& fit, const CurveSet& set, const FitSelection& selection) {
    std::size_t without = 0;
    for (const Curve& curve : set.curves) {
        without += static_cast<std::size_t>(std::ranges::count_if(curve.points, [&](const CurvePoint& point) {
            return std::max(point.theta_i, point.theta_r) <= selection.largest_theta && !(point.value > 0);
        }));
    }
    if (without == 0 || !selection.positive_only) return {};
    return {std::to_string(without) + " values that are not > 0 left out, which " +
            name(fit.request.residual) + " residuals cannot take without a noise floor"};
}

Statements of_index(const Fit& fit, const FitData& data) {
    if (fit.request.index.empty() || data.outside == spectral::OutsideRange::error) return {};
    const auto um = data.wavelengths.micrometres();
    try {
        const FitModel exact{fit.request.model,
                             {1, {um.begin(), um.end()}, data.channels, fit.request.index}};
        return {};
    } catch (const Error& error) {
        return {"optical constants held at the end of their range: " + std::string{error.what()}};
    }
}

Statements of_roughness(const Fit& fit, const CurveSet& set) {
    if (!set.roughness || !fit.slope) return {};
    return {roughness_statement(fit.parameter("sigma0").value, *set.roughness) +
            (fit.slope_alone ? "; the fit leaves sigma0 open" : "")};
}

// ---- what the fitted surface would do

Statements of_energy(const Fit& fit, const FitData& data) {
    const auto material = fitted_material(fit);
    const double scale = data.absolute ? fit.parameter("scale").value : 1;
    const auto um = data.wavelengths.micrometres();
    double most = 0, at_um = 0, at_deg = 0;
    for (const std::size_t w : {std::size_t{0}, um.size() / 2, um.size() - 1}) {
        const auto reflectance = material.at(data.wavelengths[w], {.outside = data.outside});
        for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
            const double all = reflectance.albedo(Direction::from_degrees(theta, 0), 0).total();
            if (all <= most) continue;
            most = all;
            at_um = um[w];
            at_deg = theta;
        }
    }
    constexpr double allowed = 1.001;
    Statements result;
    const std::string where = " of the light at " + rounded_text(at_deg) + " deg and " +
                              spectral::brief(at_um) + " um: more than all";
    if (most > allowed) result.push_back("the fitted material reflects " + spectral::brief(most) + where);
    if (most * scale > allowed && scale > 1)
        result.push_back("with the factor scale the surface reflects " + spectral::brief(most * scale) +
                         where);
    return result;
}

Statements of_isotropy(const CurveSet& chosen) {
    const auto worst = brightest_if_isotropic(chosen);
    constexpr double allowed = 1.2;
    if (!worst || worst->reflectance <= allowed) return {};
    return {
        "not isotropic: the curve at " + rounded_text(worst->fixed_angle) + " deg would reflect " +
        rounded_text(worst->reflectance) +
        " of the light if its lobe were as wide out of the plane as in it; the fitted material is isotropic"};
}

// ---- other ways to fit

struct OtherWay {
    std::string words;
    FitRequest request;
    FitSelection selection;
};

std::vector<OtherWay> other_ways(const Fit& fit, const FitSelection& selection) {
    FitRequest again = fit.request;
    again.followed_starts = 1;
    for (const FittedParameter& parameter : fit.parameters) {
        if (parameter.outcome == Outcome::fitted || parameter.outcome == Outcome::at_bound)
            again.starts[parameter.name] = parameter.value;
    }
    std::vector<OtherWay> result;
    for (const Residual residual : {Residual::logarithmic, Residual::relative, Residual::cosine}) {
        if (residual == fit.request.residual) continue;
        result.push_back({std::string{"with "} + name(residual) + " residuals", again, selection});
        result.back().request.residual = residual;
    }
    constexpr double steep = 60;
    if (selection.largest_theta > steep) {
        result.push_back({"up to 60 deg alone", again, selection});
        result.back().selection.largest_theta = steep;
    }
    return result;
}

/// "sigma0 0.119 +- 0.004 um" where it is further from the fit's than the errors of both.
std::string moved(const std::string& name, const Ratio& here, const Ratio& there, const std::string& unit) {
    const double apart = std::abs(here.value - there.value);
    const double error = std::hypot(here.standard_error, there.standard_error);
    if (!std::isfinite(error) || apart <= 2 * error || apart <= 0.05 * std::abs(here.value)) return "";
    return name + " " + with_error(there) + (unit == "1" ? "" : " " + unit);
}

Statements of_other_ways(const Fit& fit, std::span<const CurveSet> sets, const FitSelection& selection) {
    Statements result;
    for (const OtherWay& way : other_ways(fit, selection)) {
        std::string text;
        const auto add = [&](const std::string& more) {
            if (!more.empty()) text += (text.empty() ? "" : ", ") + more;
        };
        try {
            const Fit other = fitted(
                way.request, fit_data(sets, for_residual(way.selection, way.request.residual, sets.front())));
            if (fit.slope && other.slope) add(moved("sigma0/tau", *fit.slope, *other.slope, "1"));
            for (const FittedParameter& here : fit.parameters) {
                const FittedParameter& there = other.parameter(here.name);
                if (here.outcome == Outcome::fitted && there.outcome == Outcome::fitted)
                    add(moved(here.name, {here.value, here.standard_error},
                              {there.value, there.standard_error}, here.unit));
            }
        } catch (const Error&) {
            continue;  // fewer points than parameters, or values of 0
        }
        if (!text.empty())
            result.push_back(way.words + " " + text + ": further from this fit than the errors");
    }
    return result;
}

}  // namespace

Fit fitted(const FitRequest& request, const CurveSet& set, const FitSelection& selection,
           const Findings& wanted) {
    return fitted(request, std::span{&set, 1}, selection, wanted);
}

Fit fitted(const FitRequest& request, std::span<const CurveSet> sets, const FitSelection& selection,
           const Findings& wanted) {
    const CurveSet& set = sets.front();
    const FitSelection chosen = for_residual(selection, request.residual, set);
    const FitData data = fit_data(sets, chosen);
    Fit fit = fitted(request, data);
    const CurveSet points = selected(set, chosen);
    const auto first_after_bounds = std::ranges::find_if(
        fit.statements, [](const std::string& text) { return !text.ends_with(": ended at its bound"); });
    const auto place = first_after_bounds - fit.statements.begin();
    const Statements mirror = of_mirror_term(fit, points, chosen);
    fit.statements.insert(fit.statements.begin() + place, mirror.begin(), mirror.end());
    const auto add = [&](const Statements& more) {
        fit.statements.insert(fit.statements.end(), more.begin(), more.end());
    };
    add(of_values(fit, set, chosen));
    add(of_index(fit, data));
    add(of_roughness(fit, set));
    if (wanted.energy) add(of_energy(fit, data));
    add(of_isotropy(points));
    if (wanted.other_ways) add(of_other_ways(fit, sets, chosen));
    return fit;
}

}  // namespace hts::validation
