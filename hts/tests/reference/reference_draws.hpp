// Random points of the model: surfaces, indices and pairs of directions of every kind, edges included.
#pragma once

#include <cmath>
#include <utility>

#include "reference_model.hpp"

namespace reference {

/// A polar angle [deg]: anywhere, near the normal, or near grazing.
inline double polar_angle(Draw& draw, int kind) {
    if (kind % 3 == 0) return draw.uniform(0.001, 89.999);
    const double angle = draw.log_uniform(0.001, 45);
    return kind % 3 == 1 ? angle : 90 - angle;
}

struct Interface {
    double cosine, n, k;
};

inline Interface draw_interface(Draw& draw, int kind) {
    const double cosine = draw.chance(0.5) ? draw.uniform(0, 1) : draw.log_uniform(1e-8, 1);
    const double offset = draw.signed_log_uniform(1e-12, 1e-2);
    switch (kind % 6) {
        case 0:
            return {cosine, draw.log_uniform(0.05, 100), 0};  // dielectric
        case 1:
            return {cosine, draw.log_uniform(0.05, 100), draw.log_uniform(1e-3, 1e3)};  // absorber
        case 2:
            return {cosine, 1 + offset, 0};  // hardly a surface
        case 3:
            return {cosine, 1 + offset, draw.log_uniform(1e-12, 1e-2)};
        case 4:
            return {cosine, draw.uniform(0.05, 0.999), 0};  // total reflection
        default:
            return {cosine, draw.uniform(0.05, 3), draw.uniform(0, 20)};  // metal
    }
}

inline constexpr double smallest_angle = 0.01, largest_angle = 89.99;  // degrees

inline bool within_range(double degrees) {
    return degrees >= smallest_angle && degrees <= largest_angle;
}

inline Point draw_material(Draw& draw) {
    Point p{};
    p.wavelength = draw.log_uniform(0.3, 13);
    p.rms_roughness = draw.log_uniform(1e-3, 16);
    p.correlation_length = p.rms_roughness / draw.log_uniform(0.003, 5);
    p.n = draw.uniform(0.05, 3);
    p.k = draw.chance(0.4) ? 0 : draw.chance(0.5) ? draw.uniform(0, 20) : draw.log_uniform(1e-3, 20);
    p.albedo = draw.chance(0.3) ? 0 : draw.uniform(0, 1);
    p.theta_i = draw.uniform(smallest_angle, largest_angle);
    p.phi_i = draw.uniform(0, 360);
    p.theta_r = draw.uniform(smallest_angle, largest_angle);
    p.phi_r = draw.uniform(0, 360);
    return p;
}

/// A view within the lobe about the mirror direction: t = q max(g, 1) with q in [0, 50], g the mirror's with
/// sigma0. False if the lobe has no direction there.
inline bool view_within_lobe(Draw& draw, Point& p) {
    const Real theta = radians(p.theta_i), phi = radians(p.phi_i), turn = 2 * pi * draw.unit();
    const Real root_g = 4 * pi * Real(p.rms_roughness) * cos(theta) / Real(p.wavelength);
    const Real q = draw.chance(0.6) ? draw.uniform(0, 50) : draw.uniform(0, 4);
    const Real t = q * (root_g > 1 ? Real(root_g * root_g) : Real(1));
    const Real radius = sqrt(t) * Real(p.wavelength) / (pi * Real(p.correlation_length));
    const Real x = radius * cos(turn) - sin(theta) * cos(phi), y = radius * sin(turn) - sin(theta) * sin(phi);
    const Real sine = sqrt(x * x + y * y);
    if (sine >= 1) return false;
    p.theta_r = static_cast<double>(Real(asin(sine) * 180 / pi));
    p.phi_r = static_cast<double>(Real(atan2(y, x) * 180 / pi));
    return true;
}

/// Geometry of one of the kinds; false if the draw is to be repeated.
inline bool draw_geometry(Draw& draw, int kind, Point& p) {
    switch (kind % 20) {
        default:
            return view_within_lobe(draw, p);
        case 10:
        case 11:
            return true;  // anything
        case 12:          // in the plane of incidence, forward
            p.phi_i = std::floor(p.phi_i), p.phi_r = p.phi_i + 180;
            return true;
        case 13:  // in the plane of incidence, backward
            p.phi_r = p.phi_i;
            return true;
        case 14:  // almost backscatter
            p.theta_r = p.theta_i + draw.signed_log_uniform(1e-4, 1e-2);
            p.phi_r = p.phi_i + draw.signed_log_uniform(1e-4, 1e-2);
            return true;
        case 15:  // almost the mirror
            p.theta_r = p.theta_i + draw.signed_log_uniform(1e-6, 1e-2);
            p.phi_r = p.phi_i + 180 + draw.signed_log_uniform(1e-6, 1e-2);
            return true;
        case 16:  // the mirror, exactly
            p.theta_r = p.theta_i, p.phi_i = std::floor(p.phi_i), p.phi_r = p.phi_i + 180;
            return true;
        case 17:  // both grazing
            p.theta_i = 90 - draw.log_uniform(0.01, 6), p.theta_r = 90 - draw.log_uniform(0.01, 6);
            return true;
        case 18:  // grazing light, view within its lobe
            p.theta_i = 90 - draw.log_uniform(0.01, 6);
            return view_within_lobe(draw, p);
        case 19:  // light and view near the normal
            p.theta_i = draw.log_uniform(0.01, 2), p.theta_r = draw.log_uniform(0.01, 2);
            return true;
    }
}

/// A point of the kind whose directional-diffuse term is in a double's range, and its values.
inline std::pair<Point, Reflection> draw_point(Draw& draw, int kind) {
    while (true) {
        Point p = draw_material(draw);
        if (!draw_geometry(draw, kind, p) || !within_range(p.theta_i) || !within_range(p.theta_r)) continue;
        const Reflection f = reflection(p);
        if (f.g <= 2e5 && f.directional_diffuse > Real("1e-280")) return {p, f};
    }
}

}  // namespace reference
