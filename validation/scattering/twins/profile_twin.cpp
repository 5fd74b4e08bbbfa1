#include "validation/scattering/twins/profile_twin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

#include "hts/roughness.hpp"
#include "hts/terms.hpp"
#include "hts/unified/lobe_of_kicks.hpp"
#include "validation/scattering/profile_scattering.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi, k = 2 * pi;  // the wavelength is the unit of length

double square(double x) {
    return x * x;
}

/// The ray on the near or, with theta < 0, on the other side.
Direction towards(double theta, double azimuth) {
    return Direction::from_angles(std::fabs(theta), theta < 0 ? azimuth + pi : azimuth);
}

/// The factors of the lobe that are those of profiles.
UnifiedWave wave_of(const ProfileHeights& heights, const RefractiveIndex& index, double single) {
    UnifiedWave wave{heights.seen(), ReturnFactor{heights.seen().slope_width() / 2},
                     Wavelength::from_micrometres(1), index};
    wave.k_length = k * heights.statistics().correlation_length;
    const double flat = flat_reflectance(index);
    wave.returned = flat * single / (1 - flat * (1 - single));
    return wave;
}

/// Walter et al. 2007: their Lambda of both directions, apart.
double separate_shadowing(double one, double other) {
    return 1 / ((1 + one) * (1 + other));
}

double beckmann_lambda(double theta, double alpha) {
    return Surface{alpha / 2, 1}.rms_roughness() == 0
               ? 0
               : visibility(Surface{alpha / 2, 1}, Direction::from_angles(std::fabs(theta), 0)).masked /
                     std::cos(theta);
}

double ggx_lambda(double theta, double alpha) {
    return (std::hypot(1, alpha * std::tan(theta)) - 1) / 2;
}

}  // namespace

std::string_view name(TwinModel model) noexcept {
    constexpr std::array<std::string_view, 11> names{"he",
                                                     "he_unified",
                                                     "he_unified_mixing",
                                                     "he_unified_shortcut",
                                                     "he_first_order",
                                                     "he_rough_limit",
                                                     "kirchhoff",
                                                     "smith",
                                                     "ssa1",
                                                     "beckmann",
                                                     "ggx"};
    return names[static_cast<std::size_t>(model)];
}

ProfileTwin::ProfileTwin(TwinModel model, const RoughnessStatistics& surface, const RefractiveIndex& index,
                         double alpha)
    : model_{model},
      heights_{surface},
      index_{index},
      alpha_{alpha},
      return_{{surface.rms_roughness, heights_.seen().correlation_length()}},
      wave_{wave_of(heights_, index, return_.single())} {}

ProfileLobe ProfileTwin::lobe(double theta_i, double theta_r) const {
    switch (model_) {
        case TwinModel::he:
            return facets(theta_i, theta_r,
                          profile_lobe(ProfileModel::he_torrance, heights_, theta_i, theta_r));
        case TwinModel::kirchhoff:
            return facets(theta_i, theta_r,
                          profile_lobe(ProfileModel::kirchhoff, heights_, theta_i, theta_r));
        case TwinModel::smith:
            return facets(theta_i, theta_r, profile_lobe(ProfileModel::smith, heights_, theta_i, theta_r));
        case TwinModel::he_first_order:
        case TwinModel::he_rough_limit:
            return facets(theta_i, theta_r, he_limit(theta_i, theta_r));
        case TwinModel::beckmann:
        case TwinModel::ggx:
            return facets(theta_i, theta_r, microfacets(theta_i, theta_r));
        default:
            return unified(theta_i, theta_r);
    }
}

ProfileLobe ProfileTwin::facets(double theta_i, double theta_r, double of_mirrors) const {
    const FresnelAmplitudes amplitudes = fresnel(std::cos((theta_i + theta_r) / 2), index_);
    return {of_mirrors * std::norm(amplitudes.s), of_mirrors * std::norm(amplitudes.p)};
}

double ProfileTwin::he_limit(double theta_i, double theta_r) const {
    const View in = view(heights_.seen(), Direction::from_angles(theta_i, 0));
    const View out = view(heights_.seen(), Direction::from_angles(std::fabs(theta_r), 0));
    const double roughness =
        heights_.seen().rms_roughness() *
        effective_roughness_ratio(in.visibility.obstruction + out.visibility.obstruction);
    const double across = std::sin(theta_r) - std::sin(theta_i), up = std::cos(theta_r) + std::cos(theta_i);
    const double length = heights_.seen().correlation_length();
    const double g = square(k * roughness * up), t = square(k * length * across / 2);
    const double phi =
        model_ == TwinModel::he_first_order ? g * std::exp(-g - t) : std::exp(-t / g) / std::sqrt(g);
    const double geometry = square(across * across + up * up) / (up * up);
    return k * length * geometry * phi * in.visibility.shadowing * out.visibility.shadowing *
           std::numbers::inv_sqrtpi / (8 * std::cos(theta_i));
}

double ProfileTwin::microfacets(double theta_i, double theta_r) const {
    const double slope = std::tan((theta_r - theta_i) / 2) / alpha_;
    const bool gaussian = model_ == TwinModel::beckmann;
    const double density = gaussian ? std::exp(-slope * slope) * std::numbers::inv_sqrtpi / alpha_
                                    : 1 / (2 * alpha_ * std::pow(1 + slope * slope, 1.5));
    const auto lambda = gaussian ? beckmann_lambda : ggx_lambda;
    return facet_lobe(density, theta_i, theta_r) *
           separate_shadowing(lambda(theta_i, alpha_), lambda(theta_r, alpha_));
}

/// The library's own lobe, from Phi and beta of a profile: its (k tau)^2 Phi/(4 pi up^2 c_i c_r) [1/sr] is on
/// a profile k tau Phi_1/(2 sqrt(pi) up^2 c_i) [1/rad].
ProfileLobe ProfileTwin::unified(double theta_i, double theta_r) const {
    const ReturnFactor none{0};
    UnifiedView in{heights_.seen(), none, towards(theta_i, pi)},
        out{heights_.seen(), none, towards(theta_r, 0)};
    in.return_factor = return_(theta_i);
    out.return_factor = return_(theta_r);
    const double across = std::sin(theta_r) - std::sin(theta_i), up = std::cos(theta_r) + std::cos(theta_i);
    const auto& [roughness, length, nu] = heights_.statistics();
    const double g = square(k * roughness * up), t = square(k * length * across / 2);
    const ProfileKicks of_profile = heights_.kicks(g, k * across);
    Kicks kicks{of_profile.phi, of_profile.inverse_mean, of_profile.rest, PhiMethod::sum};
    UnifiedWave wave = wave_;
    if (model_ == TwinModel::ssa1) {
        kicks.beta = 1;
        kicks.rest = 0;
        wave.lift = 0;
    }
    double facet = 1;
    if (model_ == TwinModel::he_unified_shortcut) {
        facet = fresnel(std::cos((theta_i + theta_r) / 2), index_).unpolarised_reflectance();
        wave.index = CoatedIndex{perfect_conductor()};
    }
    const UnifiedLobe lobe = lobe_of_kicks(in, out, wave, g, t, kicks);
    const double cosine = std::cos(theta_r);
    double scale = facet * 2 * std::sqrt(pi) * cosine / (k * length);
    if (model_ == TwinModel::ssa1) scale /= 1 + in.masked / std::cos(theta_i) + out.masked / cosine;
    const double te = scale * std::norm(lobe.jones.ss), tm = scale * std::norm(lobe.jones.pp);
    const double mixed = model_ == TwinModel::he_unified_mixing ? mixed_share(heights_.seen()) : 0;
    return {(1 - mixed) * te + mixed * tm, (1 - mixed) * tm + mixed * te};
}

ProfileLobe second_order_mirror(const RoughnessStatistics& surface, double theta_i) {
    const double k_tau = k * surface.correlation_length, c = std::cos(theta_i), s = std::sin(theta_i);
    using Rule = boost::math::quadrature::gauss<double, 60>;
    double te = 0, tm = 0;
    constexpr int panels = 20;  // of the angle of q = sin(angle), so that the root at the ends is smooth
    for (int panel = 0; panel < panels; ++panel) {
        const double from = pi * panel / panels - pi / 2, to = pi * (panel + 1) / panels - pi / 2;
        const auto of = [&](auto factor) {
            return Rule::integrate(
                [&](double angle) {
                    const double q = std::sin(angle);
                    return factor(q, std::cos(angle)) * std::exp(-square(k_tau * (q - s) / 2));
                },
                from, to);
        };
        te += of([](double, double cosine) { return cosine * cosine; });
        tm += of([s](double q, double) { return square(1 - s * q); });
    }
    const double scale = 4 * square(k * surface.rms_roughness) * k_tau * std::numbers::inv_sqrtpi / 2;
    return {std::exp(-scale * c * te), std::exp(-scale / c * tm)};
}

}  // namespace hts::validation
