#include "validation/fit/fit_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

/// Wavelengths at which a prediction asks, each with the band it belongs to.
std::map<double, std::size_t> wavelengths(const Prediction& prediction) {
    std::map<double, std::size_t> result;
    for (std::size_t job = 0; job < prediction.jobs().size(); ++job) {
        for (const double um : prediction.jobs()[job].wavelengths.micrometres()) result.emplace(um, job);
    }
    return result;
}

}  // namespace

CurveSet selected(const CurveSet& set, const FitSelection& selection) {
    const auto good = [&](const CurvePoint& point) {
        return (point.value > 0 || !selection.positive_only) &&
               std::max(point.theta_i, point.theta_r) <= selection.largest_theta;
    };
    CurveSet result = set;
    std::size_t count = 0;
    for (Curve& curve : result.curves) {
        std::erase_if(curve.points, [&](const CurvePoint& point) { return !good(point); });
        count += curve.points.size();
    }
    if (count == 0) {
        throw Error{set.stem + (selection.positive_only ? ": no point > 0 up to " : ": no point up to ") +
                    shortest(selection.largest_theta) + " deg: must be at least one"};
    }
    const std::size_t every =
        selection.most_points == 0 ? 1 : (count + selection.most_points - 1) / selection.most_points;
    std::size_t at = 0;
    for (Curve& curve : result.curves) {
        std::erase_if(curve.points, [&](const CurvePoint&) { return at++ % every != 0; });
    }
    std::erase_if(result.curves, [](const Curve& curve) { return curve.points.empty(); });
    return result;
}

FitSelection for_residual(FitSelection selection, Residual residual, const CurveSet& set) {
    selection.positive_only =
        residual == Residual::relative || (residual == Residual::logarithmic && !set.noise_floor);
    return selection;
}

FitData fit_data(const CurveSet& set, const FitSelection& selection) {
    return fit_data(std::span{&set, 1}, selection);
}

FitData fit_data(std::span<const CurveSet> sets, const FitSelection& selection) {
    std::vector<CurveSet> chosen;
    for (const CurveSet& set : sets) chosen.push_back(selected(set, selection));
    const auto prediction =
        std::make_shared<const Prediction>(std::span<const CurveSet>{chosen}, selection.nodes);
    std::vector<double> um;
    std::vector<std::size_t> channels;
    for (const auto& [wavelength, channel] : wavelengths(*prediction)) {
        um.push_back(wavelength);
        channels.push_back(channel);
    }
    FitData data{.name = sets.front().stem,
                 .wavelengths = spectral::WavelengthGrid::from_micrometres(um),
                 .channels = channels,
                 .values = {},
                 .uncertainties = {},
                 .cosines = {},
                 .curves = {},
                 .noise_floor = sets.front().noise_floor.value_or(0),
                 .without_scale = {},
                 .importance = {},
                 .absolute = sets.front().scale == Scale::absolute,
                 .instrument = prediction,
                 .outside = selection.outside};
    const bool uncertain =
        std::ranges::none_of(sets, [](const CurveSet& set) { return set.uncertainty.empty(); });
    std::map<std::tuple<std::size_t, std::size_t, double, double>, std::size_t> curves;
    for (std::size_t s = 0; s < chosen.size(); ++s) {
        const double share =
            static_cast<double>(chosen.front().point_count()) / static_cast<double>(chosen[s].point_count());
        data.importance.resize(data.importance.size() + chosen[s].point_count(), std::sqrt(share));
        for (std::size_t c = 0; c < chosen[s].curves.size(); ++c) {
            const Curve& curve = chosen[s].curves[c];
            for (const CurvePoint& point : curve.points) {
                // scattered pairs: what one incident direction shows
                const bool scattered = curve.sweep == Sweep::scattered;
                const std::tuple key{s, c, scattered ? point.theta_i : 0, scattered ? point.phi_i : 0};
                data.curves.push_back(curves.emplace(key, curves.size()).first->second);
                data.values.push_back(point.value);
                data.cosines.push_back(std::cos(point.theta_i * std::numbers::pi / 180));
                data.without_scale.push_back(chosen[s].quantity == Quantity::hemispherical_reflectance);
                if (uncertain) data.uncertainties.push_back(point.uncertainty);
            }
        }
    }
    for (const CurveSet& set : sets.subspan(1)) data.name += " and " + set.stem;
    return checked(std::move(data));
}

}  // namespace hts::validation
