#include "validation/fit/fit_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

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
        return point.value > 0 && std::max(point.theta_i, point.theta_r) <= selection.largest_theta;
    };
    CurveSet result = set;
    std::size_t count = 0;
    for (Curve& curve : result.curves) {
        std::erase_if(curve.points, [&](const CurvePoint& point) { return !good(point); });
        count += curve.points.size();
    }
    if (count == 0) {
        throw Error{set.stem + ": no point > 0 up to " + std::to_string(selection.largest_theta) +
                    " deg: must be at least one"};
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

FitData fit_data(const CurveSet& set, const FitSelection& selection) {
    const CurveSet chosen = selected(set, selection);
    const auto prediction = std::make_shared<const Prediction>(chosen, selection.nodes);
    std::vector<double> um;
    std::vector<std::size_t> channels;
    for (const auto& [wavelength, channel] : wavelengths(*prediction)) {
        um.push_back(wavelength);
        channels.push_back(channel);
    }
    FitData data{.name = set.stem,
                 .wavelengths = spectral::WavelengthGrid::from_micrometres(um),
                 .channels = channels,
                 .values = {},
                 .uncertainties = {},
                 .cosines = {},
                 .instrument = prediction,
                 .outside = spectral::OutsideRange::hold};
    for (const Curve& curve : chosen.curves) {
        for (const CurvePoint& point : curve.points) {
            data.values.push_back(point.value);
            data.cosines.push_back(std::cos(point.theta_i * std::numbers::pi / 180));
            if (!set.uncertainty.empty()) data.uncertainties.push_back(point.uncertainty);
        }
    }
    return checked(std::move(data));
}

}  // namespace hts::validation
