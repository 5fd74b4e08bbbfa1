#include "validation/scattering/profile_scattering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/roughness.hpp"
#include "hts/terms.hpp"

namespace hts::validation {
namespace {

constexpr double k = 2 * std::numbers::pi;  // the wavelength is the unit of length

/// 1 + Lambda from S_1 = (1 - erfc(c)/2)/(1 + Lambda).
double one_plus_lambda(const Surface& surface, const View& view) {
    const double c = view.direction.cos_theta() / (surface.slope_width() * view.direction.sin_theta());
    return (1 - std::erfc(c) / 2) / view.visibility.shadowing;
}

struct RoughnessAndShadowing {
    double roughness, shadowing;
};

RoughnessAndShadowing seen(ProfileModel model, const RoughnessStatistics& statistics, double theta_i,
                           double theta_r) {
    const Surface surface{statistics.rms_roughness, statistics.correlation_length};
    const View in = view(surface, Direction::from_angles(theta_i, 0));
    const View out = view(surface, Direction::from_angles(std::fabs(theta_r), 0));
    const double sigma = surface.rms_roughness();
    switch (model) {
        case ProfileModel::he_torrance:
            return {sigma * effective_roughness_ratio(in.visibility.obstruction + out.visibility.obstruction),
                    in.visibility.shadowing * out.visibility.shadowing};
        case ProfileModel::smith:
            return {sigma, 1 / (one_plus_lambda(surface, in) + one_plus_lambda(surface, out) - 1)};
        default:
            return {sigma, 1};
    }
}

double square(double x) {
    return x * x;
}

}  // namespace

ProfileKicks profile_kicks(double g, double t) noexcept {
    if (g == 0) return {0, 1, 0};
    // below its first the terms are less than exp(-40) of the largest: those of exp(-g) g^m/m!
    // are, and exp(-t/m) rises
    const double first = std::max(1.0, std::floor(g - 9 * std::sqrt(g) - 5)), log_g = std::log(g);
    double sum = 0, kicks = 0, rest = 0, before = 0;
    for (double m = first;; ++m) {
        const double term = std::exp(m * log_g - std::lgamma(m + 1) - g - t / m) / std::sqrt(m);
        sum += term;
        kicks += term / m;
        rest += term * (1 - 1 / m);
        if (m > g && term <= before && term <= 1e-17 * sum)
            return sum > 0 ? ProfileKicks{sum, kicks / sum, rest / sum} : ProfileKicks{0, 1, 0};
        before = term;
    }
}

double profile_phi(double g, double t) noexcept {
    return profile_kicks(g, t).phi;
}

const char* name(ProfileModel model) noexcept {
    constexpr std::array names{"kirchhoff", "he_torrance", "smith"};
    return names[static_cast<std::size_t>(model)];
}

double profile_lobe(ProfileModel model, const RoughnessStatistics& surface, double theta_i, double theta_r) {
    const auto [roughness, shadowing] = seen(model, surface, theta_i, theta_r);
    const double across = std::sin(theta_r) - std::sin(theta_i), up = std::cos(theta_r) + std::cos(theta_i);
    const double phi =
        profile_phi(square(k * roughness * up), square(k * surface.correlation_length * across / 2));
    const double geometry = square(across * across + up * up) / (up * up);
    return k * surface.correlation_length * geometry * phi * shadowing * std::numbers::inv_sqrtpi /
           (8 * std::cos(theta_i));
}

double profile_mirror(ProfileModel model, const RoughnessStatistics& surface, double theta_i) {
    const auto [roughness, shadowing] = seen(model, surface, theta_i, theta_i);
    return std::exp(-square(2 * k * roughness * std::cos(theta_i))) * shadowing;
}

}  // namespace hts::validation
