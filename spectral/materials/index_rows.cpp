#include "spectral/materials/index_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hts/error.hpp"
#include "hts/fresnel.hpp"
#include "hts/wavelength.hpp"

namespace hts::spectral {
namespace {

std::optional<Dispersion> curve(const std::vector<PiecewiseLinear::Point>& points) {
    if (points.empty()) return std::nullopt;
    return PiecewiseLinear{points};
}

// "path: n at 0.5 um and 2 more: …", none where no two rows differ.
std::optional<std::string> contradiction(std::vector<PiecewiseLinear::Point> points, const char* quantity,
                                         const std::string& file) {
    std::erase_if(points, [](const auto& point) { return std::isnan(point.value); });  // noted already
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.um < b.um; });
    std::vector<double> differ;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double um = points[i].um;
        if (um == points[i - 1].um && points[i].value != points[i - 1].value &&
            (differ.empty() || differ.back() != um))
            differ.push_back(um);
    }
    if (differ.empty()) return std::nullopt;
    const std::size_t more = differ.size() - 1;
    return file + ": " + quantity + " at " + shortest(differ.front()) + " um" +
           (more == 0 ? "" : " and " + std::to_string(more) + " more") +
           ": rows differ there, and their mean is taken";
}

}  // namespace

void IndexRows::add_n(double um, double n) {
    const RefractiveIndex index{n, 0};
    n_.push_back({Wavelength::from_micrometres(um).micrometres(), index.n()});
}

void IndexRows::add_k(double um, double k) {
    const RefractiveIndex index{1, k};
    k_.push_back({Wavelength::from_micrometres(um).micrometres(), index.k()});
}

void IndexRows::add_if_physical(char quantity, double um, double value, const std::string& place) {
    try {
        quantity == 'n' ? add_n(um, value) : add_k(um, value);
    } catch (const Error& failure) {
        static_cast<void>(Wavelength::from_micrometres(um));  // an error for good
        notes_.push_back(place + ": " + failure.what());
        (quantity == 'n' ? n_ : k_).push_back({um, std::numeric_limits<double>::quiet_NaN()});
    }
}

std::vector<std::string> IndexRows::notes(const std::string& file) const {
    std::vector<std::string> result = notes_;
    for (const auto& found : {contradiction(n_, "n", file), contradiction(k_, "k", file)})
        if (found) result.push_back(*found);
    return result;
}

void IndexRows::require_physical() const {
    for (const auto* points : {&n_, &k_}) {
        const auto unknown = [](const auto& point) { return std::isnan(point.value); };
        if (!points->empty() && std::ranges::all_of(*points, unknown)) throw Error{notes_.front()};
    }
}

std::optional<Dispersion> IndexRows::n() const {
    return curve(n_);
}

std::optional<Dispersion> IndexRows::k() const {
    return curve(k_);
}

}  // namespace hts::spectral
