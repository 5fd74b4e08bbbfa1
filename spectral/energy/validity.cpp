#include "spectral/energy/validity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double poor_correlation_length =
    0.35;  // in wavelengths: the shortest compared with exact scattering
constexpr double best_correlation_length = 2;
constexpr double loss_of_0_3_db = 0.066746;  // 1 - 10^-0.03
constexpr double loss_of_1_db = 0.20567;     // 1 - 10^-0.1

double least_shadowing(const View& in, const View& out) {
    return std::fmin(in.visibility.shadowing, out.visibility.shadowing);
}

double mirror_loss(const Surface& surface, const View& in, const Wavelength& wavelength) {
    if (in.visibility.shadowing == 1) return 0;
    const View mirrored{in.direction.mirror(), in.visibility};
    const double g = PairFactors{surface, in, mirrored}.phase_variance(wavelength);
    const double lit = in.visibility.shadowing;
    return std::exp(-g) * (1 - lit) * (1 + lit);
}

double total_reflectance(const View& in, const SpectralSample& sample) {
    return sample.uniform_diffuse * std::numbers::pi +
           sample.index.amplitudes(in.direction.cos_theta()).unpolarised_reflectance();
}

bool leaves_what_was_measured(const Finding& finding) {
    return finding.criterion != Criterion::correlation_length && finding.severity() == Severity::outside;
}

/// Energy is not asked about: it is the albedo's error, not scattering's.
bool at_its_best(const Validity& validity) {
    return std::all_of(validity.findings.begin(), validity.findings.end(), [](const Finding& finding) {
        return finding.criterion == Criterion::energy || finding.severity() == Severity::fine;
    });
}

ModelError model_error(const Surface& surface, const Validity& validity) {
    if (surface.rms_roughness() == 0) return ModelError::none;
    if (std::any_of(validity.findings.begin(), validity.findings.end(), leaves_what_was_measured)) {
        return ModelError::unknown;
    }
    const double length = validity[Criterion::correlation_length].measured;
    if (length <= poor_correlation_length) return ModelError::poor;
    if (length < limits(Criterion::correlation_length).caution) return ModelError::between;
    return length >= best_correlation_length && at_its_best(validity) ? ModelError::best : ModelError::good;
}

/// slope_width along the axis of the shorter correlation length.
double steepest_width(const Surface& surface) {
    return 2 * surface.rms_roughness() / surface.shortest_correlation_length();
}

}  // namespace

double rms_slope(const Surface& surface) noexcept {
    return steepest_width(surface) / std::numbers::sqrt2;
}

RmsSlopes rms_slopes(const Surface& surface) noexcept {
    const auto& [along, across] = surface.correlation_lengths();
    const double height = std::numbers::sqrt2 * surface.rms_roughness();
    return {height / along, height / across};
}

double share_beyond_45_degrees(const Surface& surface) noexcept {
    const double width = steepest_width(surface);
    if (surface.isotropic()) return std::exp(-1 / (width * width));
    const auto& [along, across] = surface.correlation_lengths();
    const double height = 2 * surface.rms_roughness();
    constexpr int azimuths = 256;  // of a quarter turn, which all others repeat
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const double azimuth = std::numbers::pi / 2 * (i + 0.5) / azimuths;
        const double slope =
            std::hypot(height / along * std::cos(azimuth), height / across * std::sin(azimuth));
        sum += std::exp(-1 / (slope * slope));
    }
    return sum / azimuths;
}

double curvature_radius(const Surface& surface) noexcept {
    return surface.shortest_correlation_length() / (std::numbers::sqrt3 * steepest_width(surface));
}

Regime regime(double phase_variance) noexcept {
    if (phase_variance <= most_smooth_g) return Regime::smooth;
    if (phase_variance <= most_first_order_g) return Regime::first_order;
    return phase_variance < least_rough_g ? Regime::full : Regime::rough;
}

std::string_view name(Regime regime) noexcept {
    constexpr std::array<std::string_view, 4> names{"smooth", "first order", "full", "rough limit"};
    return names[static_cast<std::size_t>(regime)];
}

std::string_view name(Criterion criterion) noexcept {
    constexpr std::array<std::string_view, criterion_count> names{
        "correlation length", "curvature", "slope", "shadowing", "mirror", "energy"};
    return names[static_cast<std::size_t>(criterion)];
}

std::string_view quantity(Criterion criterion) noexcept {
    constexpr std::array<std::string_view, criterion_count> quantities{
        "tau/lambda", "k R cos^3(theta_d)", "sigma0/tau", "S_1", "exp(-g) (1 - S)", "a + |F|^2"};
    return quantities[static_cast<std::size_t>(criterion)];
}

std::string_view reason(Criterion criterion) noexcept {
    constexpr std::array<std::string_view, criterion_count> reasons{
        "heights change within a wavelength, so no point reflects like its tangent plane",
        "the surface curves within a wavelength, so facets diffract instead of mirroring",
        "slopes are not gentle, so light is scattered more than once, which the model neglects",
        "shadowed light is lost in the model, where a real surface scatters it again",
        "the specular term is shadowed, where a surface this smooth would mirror all at grazing",
        "mirror and uniform-diffuse terms together may return more light than falls in"};
    return reasons[static_cast<std::size_t>(criterion)];
}

std::string_view name(Severity severity) noexcept {
    constexpr std::array<std::string_view, 3> names{"fine", "caution", "outside"};
    return names[static_cast<std::size_t>(severity)];
}

Severity Limits::severity(double measured) const noexcept {
    const auto beyond = [&](double limit) { return least() ? measured < limit : measured > limit; };
    if (beyond(outside)) return Severity::outside;
    return beyond(caution) ? Severity::caution : Severity::fine;
}

Limits limits(Criterion criterion) noexcept {
    constexpr std::array<Limits, criterion_count> all{{{1, 0.5},
                                                       {2 * std::numbers::pi, 1},
                                                       {0.25, std::numbers::sqrt2 / 2},
                                                       {0.95, 0.75},
                                                       {loss_of_0_3_db, loss_of_1_db},
                                                       {1, infinity}}};
    return all[static_cast<std::size_t>(criterion)];
}

std::optional<Decibels> decibels(ModelError error) noexcept {
    constexpr std::array<Decibels, 5> known{{{0, 0}, {0, 1.1}, {0.1, 2.1}, {0.2, 1}, {1, 1}}};
    if (error == ModelError::unknown) return std::nullopt;
    return known[static_cast<std::size_t>(error)];
}

Severity Validity::severity() const noexcept {
    Severity worst = Severity::fine;
    for (const Finding& finding : findings) worst = std::max(worst, finding.severity());
    return worst;
}

Validity validity(const Surface& surface, const DirectionPair& pair, const SpectralSample& sample) noexcept {
    const Surface seen = surface.seen_by(sample.wavelength);
    return validity(seen, view(seen, pair.in), view(seen, pair.out), sample);
}

Validity validity(const Surface& surface, const View& in, const View& out,
                  const SpectralSample& sample) noexcept {
    const PairFactors factors{surface, in, out};
    const Wavelength& wavelength = sample.wavelength;
    const bool mirror = surface.rms_roughness() == 0;  // without a lobe, tau means nothing
    const double length =
        mirror ? infinity : surface.shortest_correlation_length() / wavelength.micrometres();
    const double cosine = factors.cos_theta_d();
    const double curvature =
        mirror ? infinity : wavelength.wave_number() * curvature_radius(surface) * (cosine * cosine * cosine);
    Validity result{factors.phase_variance(wavelength),
                    {{{Criterion::correlation_length, length},
                      {Criterion::curvature, curvature},
                      {Criterion::slope, surface.rms_roughness() / surface.shortest_correlation_length()},
                      {Criterion::shadowing, least_shadowing(in, out)},
                      {Criterion::mirror, mirror_loss(surface, in, wavelength)},
                      {Criterion::energy, total_reflectance(in, sample)}}},
                    ModelError::none,
                    length < 0.5 && surface.rms_roughness() < wavelength.micrometres() / 10};
    result.error = model_error(surface, result);
    return result;
}

MaterialValidity::MaterialValidity(const Surface& surface, std::span<const SpectralSample> samples,
                                   std::span<const Direction> incidence) {
    if (incidence.empty()) throw Error{"angles of incidence: none given: must be at least one"};
    points_.reserve(samples.size() * incidence.size());
    for (const SpectralSample& sample : samples) {
        for (const Direction& in : incidence) {
            points_.push_back({sample, in, validity(surface, {in, in.mirror()}, sample)});
        }
    }
}

const MaterialValidity::Point& MaterialValidity::worst(Criterion criterion) const noexcept {
    const bool least = limits(criterion).least();
    return *std::max_element(points_.begin(), points_.end(), [&](const Point& a, const Point& b) {
        const double first = a.validity[criterion].measured;
        const double second = b.validity[criterion].measured;
        return least ? first > second : first < second;
    });
}

Severity MaterialValidity::severity() const noexcept {
    Severity worst = Severity::fine;
    for (const Point& point : points_) worst = std::max(worst, point.validity.severity());
    return worst;
}

ModelError MaterialValidity::error() const noexcept {
    ModelError worst = ModelError::none;
    for (const Point& point : points_) worst = std::max(worst, point.validity.error);
    return worst;
}

bool MaterialValidity::perturbation_advised() const noexcept {
    return std::any_of(points_.begin(), points_.end(),
                       [](const Point& point) { return point.validity.perturbation_advised; });
}

}  // namespace hts::spectral
