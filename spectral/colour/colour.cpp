#include "spectral/colour/colour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "hts/error.hpp"
#include "spectral/colour/colour_data.hpp"

namespace hts::spectral {
namespace {

// ---- observer under an illuminant

double power(const ColourRow& row, Illuminant illuminant) {
    return illuminant == Illuminant::D65 ? row.d65 : 100;
}

constexpr Xyz matching(const ColourRow& row) {
    return {row.x, row.y, row.z};
}

/// S times the matching functions, joined by straight lines between the nodes.
Xyz weighted_matching(double wavelength, Illuminant illuminant) {
    const auto [left, right, t] = rows_around(wavelength);
    return (1 - t) * power(left, illuminant) * matching(left) +
           t * power(right, illuminant) * matching(right);
}

/// Integral of that over the table [um]: XYZ of the perfect white before k.
Xyz white_integral(Illuminant illuminant) {
    Xyz sum{0, 0, 0};
    for (const ColourRow& row : colour_rows) sum = sum + power(row, illuminant) * matching(row);
    const auto end = [&](const ColourRow& row) { return 0.5 * power(row, illuminant) * matching(row); };
    sum = sum + -1 * (end(colour_rows.front()) + end(colour_rows.back()));
    return colour_step * sum;
}

// ---- integration against a sampled spectrum

void require_increasing(std::span<const double> wavelengths) {
    if (wavelengths.size() < 2) {
        throw out_of_range("number of wavelengths", static_cast<double>(wavelengths.size()), "",
                           "at least 2 for a colour");
    }
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
        if (!std::isfinite(wavelengths[i])) throw out_of_range("wavelength", wavelengths[i], "um", "finite");
        if (i > 0 && !(wavelengths[i] > wavelengths[i - 1])) {
            throw out_of_range("wavelength", wavelengths[i], "um",
                               "above the one before it, " + shortest(wavelengths[i - 1]) + " um");
        }
    }
}

void require_coverage(std::span<const double> wavelengths) {
    constexpr double rounding = 1e-9;  // um
    if (wavelengths.front() <= shortest_coverage + rounding &&
        wavelengths.back() >= longest_coverage - rounding) {
        return;
    }
    throw Error{"wavelengths " + shortest(wavelengths.front()) + " to " + shortest(wavelengths.back()) +
                " um: must cover " + shortest(shortest_coverage) + " to " + shortest(longest_coverage) +
                " um for a colour"};
}

/// Every wavelength within the table at which the spectrum or the table has a corner.
std::vector<double> merged_nodes(std::span<const double> wavelengths) {
    std::vector<double> nodes;
    nodes.reserve(wavelengths.size() + colour_rows.size());
    for (const ColourRow& row : colour_rows) nodes.push_back(row.wavelength());
    const double first = nodes.front(), last = nodes.back();
    std::copy_if(wavelengths.begin(), wavelengths.end(), std::back_inserter(nodes),
                 [&](double um) { return first < um && um < last; });
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// Integrates over consecutive segments, none of which contains a corner, and deals each integral out to the
/// two samples around it in the ratio in which they make up the spectrum there.
class SegmentSum {
  public:
    SegmentSum(std::span<const double> wavelengths, Illuminant illuminant)
        : wavelengths_{wavelengths}, illuminant_{illuminant}, sums_(wavelengths.size(), Xyz{0, 0, 0}) {}

    void add(double begin, double end) {
        const auto above = std::upper_bound(wavelengths_.begin(), wavelengths_.end(), (begin + end) / 2);
        const auto right = static_cast<std::size_t>(above - wavelengths_.begin());
        const Xyz at_begin = weighted_matching(begin, illuminant_),
                  at_end = weighted_matching(end, illuminant_);
        const double length = end - begin;
        const Xyz whole = length / 2 * (at_begin + at_end);
        if (right == 0 || right == wavelengths_.size()) {
            Xyz& held = right == 0 ? sums_.front() : sums_.back();
            held = held + whole;
            return;
        }
        const double b = share(right, begin), e = share(right, end);
        const Xyz to_right = length / 6 * ((2 * b + e) * at_begin + (b + 2 * e) * at_end);
        sums_[right] = sums_[right] + to_right;
        sums_[right - 1] = sums_[right - 1] + whole + -1 * to_right;
    }

    [[nodiscard]] std::vector<Xyz> normalised(double k) && {
        for (Xyz& sum : sums_) sum = k * sum;
        return std::move(sums_);
    }

  private:
    /// How much of the spectrum at a wavelength comes from the sample `right`, the rest from the one before.
    [[nodiscard]] double share(std::size_t right, double um) const {
        return (um - wavelengths_[right - 1]) / (wavelengths_[right] - wavelengths_[right - 1]);
    }

    std::span<const double> wavelengths_;
    Illuminant illuminant_;
    std::vector<Xyz> sums_;
};

}  // namespace

Chromaticity chromaticity(const Xyz& colour) noexcept {
    const double sum = colour.X + colour.Y + colour.Z;
    if (sum == 0) return {0, 0};
    return {colour.X / sum, colour.Y / sum};
}

Illuminant illuminant_named(std::string_view text) {
    for (const Illuminant illuminant : {Illuminant::E, Illuminant::D65}) {
        if (text == name(illuminant)) return illuminant;
    }
    throw Error{"illuminant \"" + std::string{text} + "\": must be one of E, D65"};
}

const char* name(Illuminant illuminant) noexcept {
    return illuminant == Illuminant::D65 ? "D65" : "E";
}

Xyz colour_matching(double wavelength) noexcept {
    if (!in_colour_table(wavelength)) return {0, 0, 0};
    const auto [left, right, t] = rows_around(wavelength);
    return (1 - t) * matching(left) + t * matching(right);
}

double relative_power(double wavelength, Illuminant illuminant) noexcept {
    if (!in_colour_table(wavelength)) return 0;
    const auto [left, right, t] = rows_around(wavelength);
    return (1 - t) * power(left, illuminant) + t * power(right, illuminant);
}

Xyz white_point(Illuminant illuminant) noexcept {
    const Xyz integral = white_integral(illuminant);
    return {integral.X / integral.Y, 1, integral.Z / integral.Y};
}

TristimulusWeights::TristimulusWeights(std::vector<Xyz> weights, Illuminant illuminant) noexcept
    : weights_{std::move(weights)}, illuminant_{illuminant} {}

Xyz TristimulusWeights::operator()(std::span<const double> reflectance) const {
    if (reflectance.size() != weights_.size()) {
        throw out_of_range("number of spectral values", static_cast<double>(reflectance.size()), "",
                           std::to_string(weights_.size()) + ", the number of wavelengths");
    }
    Xyz sum{0, 0, 0};
    for (std::size_t i = 0; i < weights_.size(); ++i) sum = sum + reflectance[i] * weights_[i];
    return sum;
}

Xyz TristimulusWeights::of_brdf(std::span<const double> brdf) const {
    return std::numbers::pi * (*this)(brdf);
}

TristimulusWeights tristimulus_weights(std::span<const double> wavelengths, Illuminant illuminant) {
    require_increasing(wavelengths);
    require_coverage(wavelengths);
    const std::vector<double> nodes = merged_nodes(wavelengths);
    SegmentSum sum{wavelengths, illuminant};
    for (std::size_t i = 1; i < nodes.size(); ++i) sum.add(nodes[i - 1], nodes[i]);
    return {std::move(sum).normalised(1 / white_integral(illuminant).Y), illuminant};
}

Xyz tristimulus(std::span<const double> wavelengths, std::span<const double> reflectance,
                Illuminant illuminant) {
    return tristimulus_weights(wavelengths, illuminant)(reflectance);
}

}  // namespace hts::spectral
