#include "hts/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "hts/wavelength.hpp"

namespace hts {
namespace {

double checked_length(double length) {
    if (length >= shortest_length && length <= longest_length) return length;
    throw out_of_range("correlation length", length, "um", "> 0 (from 1e-24 to 1e+24 um)");
}

}  // namespace

Surface::Surface(double rms_roughness, double correlation_length)
    : rms_roughness_{rms_roughness},
      correlation_length_{correlation_length},
      lengths_{correlation_length, correlation_length} {
    const bool rough = rms_roughness >= shortest_length && rms_roughness <= longest_length;
    if (!rough && rms_roughness != 0) {
        throw out_of_range("rms roughness", rms_roughness, "um", ">= 0 (0, or from 1e-24 to 1e+24 um)");
    }
    checked_length(correlation_length);
}

Surface Surface::anisotropic(double rms_roughness, const CorrelationLengths& lengths, const Direction& axis) {
    Surface surface{rms_roughness, lengths.along};
    if (checked_length(lengths.across) == lengths.along) return surface;
    surface.correlation_length_ = std::sqrt(lengths.along * lengths.across);
    surface.lengths_ = lengths;
    surface.axis_ = axis;
    return surface;
}

Surface Surface::correlated(const Correlation& shape) const {
    Surface surface = *this;
    surface.correlation_ = shape;
    return surface;
}

Surface Surface::seen_by(const Wavelength& wavelength) const noexcept {
    if (!correlation_) return *this;
    const auto gaussian_length = [&](double length) {
        const double slopes =
            correlation_->slope_variance_below(2 * std::numbers::pi * length / wavelength.micrometres());
        return std::clamp(length * std::sqrt(2 / slopes), shortest_length, longest_length);
    };
    Surface surface{rms_roughness_, gaussian_length(lengths_.along)};
    if (isotropic()) return surface;
    surface.lengths_.across = gaussian_length(lengths_.across);
    surface.correlation_length_ = std::sqrt(surface.lengths_.along * surface.lengths_.across);
    surface.axis_ = axis_;
    return surface;
}

double Surface::variance_share(double from, double to) const noexcept {
    const auto below = [&](double q) {
        return correlation_ ? correlation_->variance_below(q) : -std::expm1(-q * q / 4);
    };
    const auto share = [&](double length) {
        const double angular = 2 * std::numbers::pi * length;
        return below(angular * to) - below(angular * from);
    };
    if (isotropic()) return share(correlation_length_);
    // the mean over azimuths of the stretched plane, where a circle of frequencies is an ellipse
    constexpr int azimuths = 256;
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const double angle = std::numbers::pi / 2 * (i + 0.5) / azimuths;
        sum += share(1 / std::hypot(std::cos(angle) / lengths_.along, std::sin(angle) / lengths_.across));
    }
    return sum / azimuths;
}

double Surface::shortest_correlation_length() const noexcept {
    return std::min(lengths_.along, lengths_.across);
}

double Surface::azimuth() const noexcept {
    return std::atan2(axis_.sin_phi(), axis_.cos_phi());
}

double Surface::correlation_length(const Direction& along) const noexcept {
    if (isotropic()) return correlation_length_;
    const double x = along.cos_phi() * axis_.cos_phi() + along.sin_phi() * axis_.sin_phi();
    const double y = along.sin_phi() * axis_.cos_phi() - along.cos_phi() * axis_.sin_phi();
    return 1 / std::hypot(x / lengths_.along, y / lengths_.across);
}

double Surface::slope_width(const Direction& along) const noexcept {
    return isotropic() ? slope_width() : 2 * rms_roughness_ / correlation_length(along);
}

double Surface::stretched(const HorizontalChange& change) const noexcept {
    if (isotropic()) return std::hypot(change.x, change.y);
    const double x = change.x * axis_.cos_phi() + change.y * axis_.sin_phi();
    const double y = change.y * axis_.cos_phi() - change.x * axis_.sin_phi();
    return std::hypot(x * (lengths_.along / correlation_length_),
                      y * (lengths_.across / correlation_length_));
}

ByAxes log_slope_by_axes(const Surface& surface, const Direction& along) noexcept {
    const auto& [tau_x, tau_y] = surface.correlation_lengths();
    const Direction& axis = surface.axis();
    const double c = along.cos_phi() * axis.cos_phi() + along.sin_phi() * axis.sin_phi();
    const double s = along.sin_phi() * axis.cos_phi() - along.cos_phi() * axis.sin_phi();
    const double x = c * (surface.correlation_length() / tau_x);
    const double y = s * (surface.correlation_length() / tau_y);
    const double sum = x * x + y * y;
    const double turned =
        x * s * (surface.correlation_length() / tau_x) - y * c * (surface.correlation_length() / tau_y);
    return {-x * x / sum, -y * y / sum, surface.isotropic() ? 0 : turned / sum};
}

CorrelationLengths seen_by_lengths(const Surface& surface, const Wavelength& wavelength) noexcept {
    const auto& shape = surface.correlation();
    if (!shape) return {1, 1};
    // tau = length (2/v)^(1/2), v the variance of slopes below q = 2 pi length/lambda, half that of W q^3 dq
    const auto along = [&](double length) {
        const double q = 2 * std::numbers::pi * length / wavelength.micrometres();
        return 1 - std::exp(shape->log_spectrum(q) + 4 * std::log(q)) / (4 * shape->slope_variance_below(q));
    };
    return {along(surface.correlation_lengths().along), along(surface.correlation_lengths().across)};
}

double stretched_horizontal(const Surface& surface, const Direction& in, const Direction& out) noexcept {
    return surface.isotropic() ? wave_vector_change(in, out).horizontal
                               : surface.stretched(horizontal_change(in, out));
}

}  // namespace hts
