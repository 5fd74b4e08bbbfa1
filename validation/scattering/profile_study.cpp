#include "validation/scattering/profile_study.hpp"

#include <cmath>
#include <numbers>

#include "spectral/parallel.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi, degree = pi / 180, k = wave_number;

/// Middles of the angular steps from -90 to 90 degrees, so that sums are integrals.
std::vector<double> scattering_angles() {
    constexpr int count = bin_count * angles_per_bin;
    std::vector<double> angles;
    angles.reserve(count);
    for (int i = 0; i < count; ++i) angles.push_back((i + 0.5) * pi / count - pi / 2);
    return angles;
}

/// The middle of a period, by every so-many-th sample.
Contour contour_of(const RandomProfile& profile, std::size_t nodes, std::size_t every) {
    const std::size_t first = (profile.height.size() - nodes * every) / 2;
    const auto middle = [&](const std::vector<double>& all) {
        std::vector<double> chosen(nodes);
        for (std::size_t i = 0; i < nodes; ++i) chosen[i] = all[first + i * every];
        return chosen;
    };
    Contour contour{profile.step * static_cast<double>(every),
                    std::vector<double>(nodes),
                    middle(profile.height),
                    std::vector<double>(nodes, 1),
                    middle(profile.slope),
                    std::vector<double>(nodes, 0),
                    middle(profile.second_derivative)};
    for (std::size_t i = 0; i < nodes; ++i)
        contour.x[i] = contour.step * (static_cast<double>(i) - (static_cast<double>(nodes) - 1) / 2);
    return contour;
}

/// The incident beams' fields at the nodes.
SurfaceFields incident_fields(const Contour& contour, const std::vector<TaperedBeam>& beams) {
    SurfaceFields result;
    for (const TaperedBeam& beam : beams) {
        SurfaceField field, derivative;
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const double x = contour.x[i], z = contour.z[i];
            field.push_back(beam.field(x, z));
            derivative.push_back(beam.derivative(x, z, -contour.dz[i], contour.dx[i]));
        }
        result.psi.push_back(std::move(field));
        result.u.push_back(std::move(derivative));
    }
    return result;
}

std::vector<SurfaceField> combined(double a, const std::vector<SurfaceField>& first, double b,
                                   const std::vector<SurfaceField>& second) {
    std::vector<SurfaceField> result = first;
    for (std::size_t column = 0; column < first.size(); ++column) {
        for (std::size_t i = 0; i < first[column].size(); ++i)
            result[column][i] = a * first[column][i] + b * second[column][i];
    }
    return result;
}

SurfaceFields combined(double a, const SurfaceFields& first, double b, const SurfaceFields& second) {
    return {combined(a, first.psi, b, second.psi), combined(a, first.u, b, second.u)};
}

/// Power that enters the ground, per beam: integral -Im(psi* u)/k dl.
std::vector<double> transmitted_power(const SurfaceFields& fields, double step) {
    std::vector<double> powers;
    for (std::size_t beam = 0; beam < fields.psi.size(); ++beam) {
        double sum = 0;
        for (std::size_t i = 0; i < fields.psi[beam].size(); ++i)
            sum -= std::imag(std::conj(fields.psi[beam][i]) * fields.u[beam][i]);
        powers.push_back(sum * step / k);
    }
    return powers;
}

/// Power in far fields at even angles that fill half a circle, per beam.
std::vector<double> far_power(const std::vector<SurfaceField>& amplitudes) {
    std::vector<double> powers;
    for (const SurfaceField& beam : amplitudes) {
        double sum = 0;
        for (const Complex amplitude : beam) sum += std::norm(amplitude);
        powers.push_back(sum * pi / static_cast<double>(beam.size()) / (8 * pi * k));
    }
    return powers;
}

/// A number for the surface, so that each has seeds of its own.
std::uint64_t surface_number(const RoughnessStatistics& surface) {
    return static_cast<std::uint64_t>(std::lround(100 * surface.nu.value_or(0))) * 1000000000000U +
           static_cast<std::uint64_t>(std::lround(1e4 * surface.rms_roughness)) * 1000000U +
           static_cast<std::uint64_t>(std::lround(1e4 * surface.correlation_length));
}

}  // namespace

ProfileStudy::ProfileStudy(const RoughnessStatistics& surface, const std::vector<double>& theta_i_deg,
                           const MomentSettings& settings)
    : surface_{surface}, settings_{settings}, angles_{scattering_angles()} {
    for (const double angle : angles_) below_.push_back(pi + angle);
    for (const double theta : theta_i_deg) beams_.emplace_back(theta * degree, settings.length / 4, k);
    nodes_ = static_cast<std::size_t>(std::lround(settings.length * settings.points_per_wavelength));
    const double margin = 8 * surface.correlation_length * settings.points_per_wavelength;
    while (static_cast<double>(period_) < static_cast<double>(nodes_) + margin) period_ *= 2;
}

PolarisedFields ProfileStudy::solved(const Contour& contour,
                                     const std::vector<SurfaceField>& incident) const {
    if (!settings_.index) return surface_fields(contour, k, incident);
    return surface_fields(contour, k, incident, {settings_.index->n(), settings_.index->k()});
}

Realisation ProfileStudy::realisation(std::size_t number) const {
    const auto seed = seed_of(settings_.study, surface_number(surface_), number);
    const auto every = static_cast<std::size_t>(settings_.drawn_between);
    const double step = 1.0 / settings_.points_per_wavelength;
    const Contour contour = contour_of(
        random_profile(surface_, step / settings_.drawn_between, period_ * every, seed), nodes_, every);
    const SurfaceFields light = incident_fields(contour, beams_);
    const PolarisedFields fields = solved(contour, light.psi);
    const std::vector<SurfaceField> dark(beams_.size(), SurfaceField(contour.size()));
    const FarField above{contour, k, angles_}, below{contour, k, below_};
    const auto scattered = [&](const SurfaceFields& exact, const SurfaceFields& kirchhoff) {
        return Scattered{above.amplitudes(exact), above.amplitudes(kirchhoff),
                         far_power(below.amplitudes(combined(1, exact, -1, light))),
                         transmitted_power(exact, step)};
    };
    return {scattered(fields.te, {dark, combined(2, light.u, 0, light.u)}),
            scattered(fields.tm, {combined(2, light.psi, 0, light.psi), dark})};
}

std::vector<Realisation> ProfileStudy::realisations() const {
    std::vector<Realisation> all(static_cast<std::size_t>(settings_.realisations));
    spectral::parallel_for(all.size(), [&](std::size_t i) { all[i] = realisation(i); });
    return all;
}

}  // namespace hts::validation
