#include "spectral/energy/band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

constexpr double second_radiation_constant = 14387.76877;  // [um K]

template <class Function>
double quadrature(const Function& f, double from, double to) {
    constexpr unsigned levels = 10;
    constexpr double enough = accuracy::band_weight / 100;
    return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, from, to, levels, enough);
}

/// The same in ln(lambda), over which Planck's law is smooth at any distance.
template <class Function>
double over_wavelengths(const Function& f, double first, double last) {
    return quadrature([&](double u) { return std::exp(u) * f(std::exp(u)); }, std::log(first),
                      std::log(last));
}

}  // namespace

double planck_shape(double um, double kelvin) noexcept {
    const double x = second_radiation_constant / (um * kelvin);
    const double below = std::expm1(x);
    return std::isfinite(below) ? x * x * x * x * (x / below) : 0;
}

Band::Band(std::optional<PiecewiseLinear> response, std::optional<double> temperature)
    : response_{std::move(response)}, temperature_{temperature} {
    if (!response_ && !temperature_) throw Error{"band: must have a response or a temperature"};
    if (temperature_ && !(*temperature_ >= coldest && *temperature_ <= hottest))
        throw out_of_range("temperature", *temperature_, "K", "from 1 to 1e+06 K");
    if (!response_) return;
    const auto points = response_->points();
    for (const auto& point : points)
        if (!(point.value >= 0)) throw out_of_range("response", point.value, "", ">= 0");
    if (points.size() < 2 || std::ranges::all_of(points, [](const auto& p) { return p.value == 0; }))
        throw Error{"response: must be > 0 somewhere between two wavelengths"};
}

double Band::weight(double um) const noexcept {
    if (response_ && !response_->range().contains(um)) return 0;
    return (response_ ? (*response_)(um) : 1) * (temperature_ ? planck_shape(um, *temperature_) : 1);
}

/// Ends of the pieces of an interval in which w is smooth.
std::vector<double> Band::pieces(double first, double last) const {
    std::vector<double> ends{first};
    if (response_) {
        for (const auto& point : response_->points())
            if (point.um > first && point.um < last) ends.push_back(point.um);
    }
    ends.push_back(last);
    return ends;
}

double Band::integral(double first, double last) const {
    const auto ends = pieces(first, last);
    double sum = 0;
    for (std::size_t i = 1; i < ends.size(); ++i)
        sum += over_wavelengths([&](double um) { return weight(um); }, ends[i - 1], ends[i]);
    return sum;
}

std::vector<double> Band::weights(const WavelengthGrid& wavelengths) const {
    const auto um = wavelengths.micrometres();
    if (um.size() < 2) throw Error{"mean over a band: must have at least two wavelengths"};
    std::vector<double> result(um.size());
    for (std::size_t i = 1; i < um.size(); ++i) {
        const double a = um[i - 1], b = um[i];
        const auto ends = pieces(a, b);
        for (std::size_t j = 1; j < ends.size(); ++j) {
            const auto part = [&](auto&& share) {
                return over_wavelengths([&](double at) { return weight(at) * share(at); }, ends[j - 1],
                                        ends[j]);
            };
            result[i - 1] += part([&](double at) { return (b - at) / (b - a); });
            result[i] += part([&](double at) { return (at - a) / (b - a); });
        }
    }
    double sum = 0;
    for (const double value : result) sum += value;
    if (!(sum > 0)) {
        throw Error{"mean over a band: nothing of it lies at the wavelengths, " + shortest(um.front()) +
                    " to " + shortest(um.back()) + " um"};
    }
    for (double& value : result) value /= sum;
    return result;
}

double Band::covered(const WavelengthGrid& wavelengths) const {
    const auto um = wavelengths.micrometres();
    double first = um.front(), last = um.back();
    if (!response_) {  // of all that a black body radiates, x^3/(exp(x) - 1) over x
        const double whole = second_radiation_constant / *temperature_ * std::pow(std::numbers::pi, 4) / 15;
        return std::min(1.0, integral(first, last) / whole);
    }
    const auto range = response_->range();
    first = std::max(first, range.shortest);
    last = std::min(last, range.longest);
    if (!(last > first)) return 0;
    return std::min(1.0, integral(first, last) / integral(range.shortest, range.longest));
}

PiecewiseLinear read_response(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    table.require_known_columns({"wavelength_um", "wavelength_nm", "response"});
    const WavelengthColumn wavelength = table.wavelength();
    const std::size_t response = table.column("response");
    std::vector<PiecewiseLinear::Point> points;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const double value = table.number(row, response);
        if (!(value >= 0)) throw table.error(row, response, shortest(value) + ": must be >= 0");
        const double um = wavelength.micrometres(table.number(row, wavelength.place));
        located(table.where(table.line(row)) + "column " + in_quotes(wavelength.name()), [&] {
            points.push_back({Wavelength::from_micrometres(um).micrometres(), value});
        });
    }
    if (points.empty()) throw Error{table.name() + ": must have a row for each wavelength"};
    return PiecewiseLinear{std::move(points)};
}

}  // namespace hts::spectral
