#include "validation/papers/polar_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

constexpr int steps_per_degree = 4;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// -90 … 90 deg in equal steps, and the specular direction itself.
std::vector<double> view_angles(double theta_i) {
    std::vector<double> angles{theta_i};
    for (int i = -90 * steps_per_degree; i <= 90 * steps_per_degree; ++i) {
        angles.push_back(static_cast<double>(i) / steps_per_degree);
    }
    std::sort(angles.begin(), angles.end());
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

/// A reflectance at its first wavelength, in one plane of incidence.
struct Plane {
    const spectral::Reflectance& reflectance;
    double theta_i, phi_i;  // [deg]
    const std::optional<EqualCones>& cones;

    [[nodiscard]] PolarPoint at(double view_angle) const {
        const Direction in = Direction::from_degrees(theta_i, phi_i);
        const Direction out =
            Direction::from_degrees(std::abs(view_angle), view_angle < 0 ? phi_i : phi_i + 180);
        const double off_mirror = radians(std::abs(view_angle - theta_i));
        const double sum = reflectance.brdf({in, out})[0];  // 0 on the horizon, where the model is
        const SpecularReflectance specular = reflectance.specular_reflectance(in)[0];
        return {view_angle, reflectance.directional_diffuse({in, out})[0],
                std::min(sum, reflectance.uniform_diffuse()[0]),
                cones ? cones->brdf(specular, in.cos_theta(), off_mirror) : 0, 0};
    }
};

double scale(const PolarPoint& mirror, double theta_i, PolarRadius radius) {
    if (radius == PolarRadius::absolute) return 1;
    if (mirror.brdf() > 0) return 1 / mirror.brdf();
    throw Error{"BRDF in the specular direction at theta_i " + shortest(theta_i) +
                " deg is 0: must be > 0 to normalise with (see --solid-angle and --absolute)"};
}

}  // namespace

EqualCones::EqualCones(double solid_angle)
    : solid_angle_{solid_angle}, half_angle_{2 * std::asin(std::sqrt(solid_angle / (4 * std::numbers::pi)))} {
    if (!(solid_angle > 0 && solid_angle <= 1)) {
        throw out_of_range("solid angle", solid_angle, "sr", "> 0 and at most 1 sr");
    }
}

double EqualCones::overlap(double off_mirror) const noexcept {
    const double x = off_mirror / (2 * half_angle_);
    if (x >= 1) return 0;
    return 2 * std::numbers::inv_pi * (std::acos(x) - x * std::sqrt(1 - x * x));
}

double EqualCones::brdf(const SpecularReflectance& specular, double cos_theta_i,
                        double off_mirror) const noexcept {
    if (cos_theta_i == 0) return 0;
    return specular.value() / (cos_theta_i * solid_angle_) * overlap(off_mirror);
}

PolarCurve polar_curve(const spectral::Reflectance& reflectance, double theta_i, double phi_i,
                       const std::optional<EqualCones>& cones, PolarRadius radius) {
    const Plane plane{reflectance, theta_i, phi_i, cones};
    const double factor = scale(plane.at(theta_i), theta_i, radius);
    PolarCurve curve{theta_i, {}};
    for (const double view_angle : view_angles(theta_i)) {
        curve.points.push_back(plane.at(view_angle));
        curve.points.back().radius = factor * curve.points.back().brdf();
    }
    return curve;
}

SineCurve sine_curve(const spectral::Reflectance& reflectance, double theta_i, double phi_i, double least) {
    constexpr int steps_per_decade = 50;
    const Direction in = Direction::from_degrees(theta_i, phi_i);
    const double mirror = in.sin_theta();
    const auto side = [&](double sign) {
        const double most = sign > 0 ? 1 - mirror : 1 + mirror;
        std::vector<SinePoint> points;
        if (!(most > least)) return points;
        const int steps =
            std::max(1, static_cast<int>(std::ceil(std::log10(most / least) * steps_per_decade)));
        for (int i = 0; i < steps; ++i) {  // short of the horizon itself
            const double difference = least * std::pow(most / least, static_cast<double>(i) / steps);
            const double beta = mirror + sign * difference;
            const Direction out = Direction::from_angles(std::asin(std::min(1.0, std::abs(beta))),
                                                         radians(beta < 0 ? phi_i : phi_i + 180));
            const double sum = reflectance.brdf({in, out})[0];
            points.push_back({beta, difference, reflectance.directional_diffuse({in, out})[0],
                              std::min(sum, reflectance.uniform_diffuse()[0])});
        }
        return points;
    };
    return {theta_i, side(1), side(-1)};
}

}  // namespace hts::validation
