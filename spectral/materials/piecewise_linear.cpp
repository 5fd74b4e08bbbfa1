#include "spectral/materials/piecewise_linear.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

using Point = PiecewiseLinear::Point;

void require_usable(const Point& point) {
    static_cast<void>(Wavelength::from_micrometres(point.um));
    if (std::isinf(point.value)) throw out_of_range("tabulated value", point.value, "", "finite");
}

// Points of equal wavelength, which stand together, become one with their mean.
std::vector<Point> merged(const std::vector<Point>& sorted) {
    std::vector<Point> result;
    double count = 0;
    for (const Point& point : sorted) {
        if (result.empty() || result.back().um != point.um) {
            result.push_back(point);
            count = 1;
        } else {
            result.back().value = std::lerp(result.back().value, point.value, 1 / ++count);
        }
    }
    return result;
}

}  // namespace

const char* name(OutsideRange policy) noexcept {
    constexpr std::array names{"error", "hold", "zero"};
    return names[static_cast<std::size_t>(policy)];
}

OutsideRange outside_range_named(std::string_view text) {
    if (text == "clamp") return OutsideRange::hold;
    for (const OutsideRange policy : {OutsideRange::error, OutsideRange::hold, OutsideRange::zero})
        if (text == name(policy)) return policy;
    throw Error{"\"" + std::string{text} + "\": must be error, hold or zero"};
}

double WavelengthRange::admit(const Wavelength& wavelength, OutsideRange policy,
                              const std::string& what) const {
    const double um = wavelength.micrometres();
    if (policy != OutsideRange::hold && !contains(um)) {
        throw out_of_range(
            "wavelength", um, "um",
            "from " + hts::shortest(shortest) + " to " + hts::shortest(longest) + " um (range of " + what +
                ")" + (policy == OutsideRange::zero ? "; outside zero is for measured data alone" : ""));
    }
    return clamp(um);
}

PiecewiseLinear::PiecewiseLinear(std::vector<Point> points) {
    if (points.empty()) throw Error{"table without a row: must have at least one"};
    for (const Point& point : points) require_usable(point);
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.um < b.um; });
    points_ = merged(points);
}

WavelengthRange PiecewiseLinear::range() const noexcept {
    return {points_.front().um, points_.back().um};
}

double PiecewiseLinear::operator()(double um) const noexcept {
    const auto right = std::upper_bound(points_.begin(), points_.end(), um,
                                        [](double x, const Point& p) { return x < p.um; });
    if (right == points_.begin()) return points_.front().value;
    if (right == points_.end()) return points_.back().value;
    const auto left = right - 1;
    if (um == left->um || std::isnan(left->value)) return left->value;
    return std::lerp(left->value, right->value, (um - left->um) / (right->um - left->um));
}

}  // namespace hts::spectral
