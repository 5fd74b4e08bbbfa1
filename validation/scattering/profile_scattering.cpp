#include "validation/scattering/profile_scattering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

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

RoughnessAndShadowing seen(ProfileModel model, const Surface& surface, double theta_i, double theta_r) {
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

// of the lags at which a K-correlated profile's C is kept
constexpr double lag = 0.05;
constexpr std::size_t period = 2048;

/// tau of a Gaussian correlation with the slopes that frequencies up to 1 give.
double seen_length(const RoughnessStatistics& of) {
    if (!of.nu) return of.correlation_length;
    const auto spectrum = [&of](double frequency) {
        return std::pow(1 + square(k * frequency * of.correlation_length), -*of.nu - 0.5);
    };
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double variance = Rule::integrate(spectrum, 0.0, most_frequency);
    const double slopes = Rule::integrate([&](double f) { return square(k * f) * spectrum(f); }, 0.0, 1.0);
    return std::sqrt(2 * variance / slopes);
}

/// Sum of y^m/(m! m), m >= 1.
double kicks_sum(double y) {
    double term = y, sum = y;
    for (int m = 2; std::fabs(term) > 1e-17 * std::fabs(sum); ++m) {
        term *= y / m;
        sum += term / m;
    }
    return sum;
}

}  // namespace

ProfileHeights::ProfileHeights(const RoughnessStatistics& of)
    : statistics_{of}, seen_{of.rms_roughness, seen_length(of)} {
    if (of.nu) correlation_ = profile_correlation(of, lag, period);
}

/// By the trapezoidal rule over a period: C and what is made of it are smooth.
template <class Kernel>
double ProfileHeights::integral(double across, const Kernel& kernel) const noexcept {
    const double turn = across * lag, two_cosine = 2 * std::cos(turn);
    double before = std::cos(turn), cosine = 1, sum = 0;
    for (std::size_t i = 0; i < correlation_.size(); ++i) {
        const bool end = i == 0 || i + 1 == correlation_.size();
        sum += (end ? 1 : 2) * cosine * kernel(correlation_[i]);
        const double next = two_cosine * cosine - before;
        before = cosine;
        cosine = next;
    }
    return sum * lag * std::numbers::inv_sqrtpi / statistics_.correlation_length;
}

double ProfileHeights::phi(double g, double across) const noexcept {
    if (!statistics_.nu) return profile_phi(g, square(across * statistics_.correlation_length / 2));
    return std::exp(-g) * integral(across, [g](double c) { return std::expm1(g * c); });
}

ProfileKicks ProfileHeights::kicks(double g, double across) const noexcept {
    if (!statistics_.nu) return profile_kicks(g, square(across * statistics_.correlation_length / 2));
    const double all = phi(g, across);
    if (!(all > 0)) return {0, 1, 0};
    const double mean =
        std::min(1.0, std::exp(-g) * integral(across, [g](double c) { return kicks_sum(g * c); }) / all);
    return {all, mean, 1 - mean};
}

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

double profile_lobe(ProfileModel model, const ProfileHeights& surface, double theta_i, double theta_r) {
    const auto [roughness, shadowing] = seen(model, surface.seen(), theta_i, theta_r);
    const double across = std::sin(theta_r) - std::sin(theta_i), up = std::cos(theta_r) + std::cos(theta_i);
    const double phi = surface.phi(square(k * roughness * up), k * across);
    const double geometry = square(across * across + up * up) / (up * up);
    return k * surface.statistics().correlation_length * geometry * phi * shadowing *
           std::numbers::inv_sqrtpi / (8 * std::cos(theta_i));
}

double profile_mirror(ProfileModel model, const ProfileHeights& surface, double theta_i) {
    const auto [roughness, shadowing] = seen(model, surface.seen(), theta_i, theta_i);
    return std::exp(-square(2 * k * roughness * std::cos(theta_i))) * shadowing;
}

}  // namespace hts::validation
