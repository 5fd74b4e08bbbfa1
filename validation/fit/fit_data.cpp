#include "validation/fit/fit_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

void require(bool good, const std::string& name, std::size_t datum, const std::string& problem) {
    if (!good) throw Error{name + ": sample " + std::to_string(datum + 1) + ": " + problem};
}

}  // namespace

FitData checked(FitData data) {
    const std::size_t count = data.values.size();
    if (count == 0) throw Error{data.name + ": no samples: must be at least one"};
    if (data.cosines.size() != count || data.curves.size() != count ||
        (!data.without_scale.empty() && data.without_scale.size() != count) ||
        (!data.uncertainties.empty() && data.uncertainties.size() != count) ||
        data.channels.size() != data.wavelengths.size()) {
        throw Error{
            data.name +
            ": values, uncertainties, cosines, curves and channels must be as many as they belong to"};
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double value = data.values[i];
        require(std::isfinite(value) && (value >= 0 || data.noise_floor > 0), data.name, i,
                "value " + std::to_string(value) + ": must be a finite number >= 0");
        if (data.uncertainties.empty()) continue;
        const double uncertainty = data.uncertainties[i];
        require(std::isfinite(uncertainty) && uncertainty > 0, data.name, i,
                "uncertainty " + std::to_string(uncertainty) +
                    ": must be a finite number > 0, or 0 for all samples");
    }
    return data;
}

FitData fit_data(std::string name, spectral::WavelengthGrid wavelengths,
                 const std::vector<FitSample>& samples) {
    FitData data{std::move(name), std::move(wavelengths), {}, {}, {}, {}, {}};
    data.channels.resize(data.wavelengths.size());
    std::iota(data.channels.begin(), data.channels.end(), std::size_t{0});
    const bool uncertain =
        std::ranges::any_of(samples, [](const FitSample& s) { return s.uncertainty != 0; });
    std::vector<PairAtWavelength> points;
    std::map<std::tuple<std::size_t, double, double>, std::size_t> curves;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        require(samples[i].wavelength < data.wavelengths.size(), data.name, i,
                "wavelength " + std::to_string(samples[i].wavelength) + ": must be one of the grid's " +
                    std::to_string(data.wavelengths.size()));
        points.push_back({samples[i].pair, samples[i].wavelength});
        data.values.push_back(samples[i].value);
        const Direction& in = samples[i].pair.in;
        data.cosines.push_back(in.cos_theta());
        const std::tuple light{samples[i].wavelength, in.vector().x, in.vector().y};
        data.curves.push_back(curves.emplace(light, curves.size()).first->second);
        if (uncertain) data.uncertainties.push_back(samples[i].uncertainty);
    }
    data.instrument = std::make_shared<const Prediction>(data.wavelengths, points);
    return checked(std::move(data));
}

}  // namespace hts::validation
