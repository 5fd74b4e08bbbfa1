// Generates the reference values of the He-Torrance tests, independently of the engine: the printed forms of
// He et al. 1991 at 80 digits (reference_physics.hpp), inputs from a fixed seed, the same bits on every
// machine.
//
//   build   g++ -std=c++20 -O2 -Wall -Wextra -Wconversion -Wshadow -Wpedantic generate_reference.cpp
//               -o generate_reference           (header-only Boost 1.74 or later, nothing to link)
//   run     generate_reference FOLDER           writes FOLDER/{phi,shadowing,effective_roughness,fresnel,
//                                               model,limits}.csv; the folder must exist; a few minutes
//   exit    0 done, 1 a check failed or a file could not be written, 2 wrong usage
//
// Values too small for a double (1.2e-1234) are written as they are: std::strtod reads them as 0, std::stod
// and std::from_chars report them as out of range. A bare 0 is exact, or (K and Lambda of shadowing.csv)
// below the range of the 80-digit type, about 1e-646456833.

#include <iostream>

#include "reference_checks.hpp"

namespace {

using namespace reference;

// ---------------------------------------------------------------------------------------------------- Phi

struct PhaseAndTilt {
    double g, t;
};

std::vector<PhaseAndTilt> phi_points() {
    Draw draw(1);
    std::vector<PhaseAndTilt> points;
    const auto add = [&points](int count, const auto& one) {
        for (int i = 0; i < count; ++i) points.push_back(one(i));
    };
    struct PhaseAndRatio {
        double g, ratio;  // t/g; braces below fix the order of the two draws
    };
    const auto times = [](PhaseAndRatio p) { return PhaseAndTilt{p.g, p.g * p.ratio}; };
    add(24, [](int i) { return PhaseAndTilt{std::stod("1e" + std::to_string(i - 12)), 0.0}; });
    points.back().g = 1e10;
    add(20, [&](int) { return PhaseAndTilt{draw.log_uniform(1e-3, 1e10), 0.0}; });
    add(140, [&](int) { return times({draw.log_uniform(1e-12, 1e10), draw.uniform(0, 700)}); });
    add(140, [&](int) { return times({draw.log_uniform(1e-12, 1e10), draw.log_uniform(1e-12, 700)}); });
    add(80, [&](int) { return times({draw.log_uniform(1e-2, 1e4), draw.log_uniform(1e-2, 700)}); });
    add(80, [&](int) { return PhaseAndTilt{draw.log_uniform(1e-12, 30), draw.log_uniform(1e-3, 1e4)}; });
    add(100, [&](int) { return times({draw.log_uniform(1e3, 1e10), draw.uniform(0, 700)}); });
    add(36, [&](int) { return times({draw.log_uniform(1e2, 1e10), draw.log_uniform(700, 1e4)}); });
    return points;
}

void write_phi(const std::string& folder) {
    Table table(
        folder + "/phi.csv",
        {"Phi(g,t) = exp(-g) sum_{m>=1} g^m/(m! m) exp(-t/m), the sum of [He91 (78)], its logarithm, and",
         "the companion psi = exp(-g) sum_{m>=1} g^m/m! exp(-t/m). phi and psi may lie below a double's "
         "range."},
        "g,t,log_phi,phi,psi");
    for (const auto& [g, t] : phi_points()) {
        const PhiSums sums = phi_sums(g, t);
        table.add({text(g), text(t), text(sums.log_phi), text(sums.phi), text(sums.psi)});
    }
    table.close();
}

// ------------------------------------------------------------------------------- shadowing and roughness

/// A polar angle [deg]: anywhere, near the normal, or near grazing.
double polar_angle(Draw& draw, int kind) {
    if (kind % 3 == 0) return draw.uniform(0.001, 89.999);
    const double angle = draw.log_uniform(0.001, 45);
    return kind % 3 == 1 ? angle : 90 - angle;
}

void write_shadowing(const std::string& folder) {
    Table table(
        folder + "/shadowing.csv",
        {"K [He91 (82)]; Lambda (25) with the factor exp(-c^2) the print lost; S1 (24); S1/cos(theta).",
         "K and Lambda may lie below a double's range."},
        "theta_deg,sigma_over_tau,K,Lambda,S1,S1_over_cos");
    Draw draw(2);
    for (int i = 0; i < 300; ++i) {
        const double degrees = polar_angle(draw, i), sigma_over_tau = draw.log_uniform(1e-4, 10);
        const Obstruction o = obstruction(radians(degrees), sigma_over_tau);
        table.add({text(degrees), text(sigma_over_tau), text(o.K), text(o.lambda), text(o.S1),
                   text(Real(o.S1 / cos(radians(degrees))))});
    }
    table.close();
}

void write_effective_roughness(const std::string& folder) {
    Table table(folder + "/effective_roughness.csv",
                {"sigma/sigma0 [He91 (80)] from the root of (81) by bisection; K = K_i + K_r."},
                "K,sigma_over_sigma0");
    Draw draw(3);
    for (int i = 0; i < 100; ++i) {
        const double K = i < 17 ? std::stod("1e" + std::to_string(i - 8)) : draw.log_uniform(1e-8, 1e8);
        table.add({text(K), text(effective_roughness_ratio(K))});
    }
    table.close();
}

// ------------------------------------------------------------------------------------------------ Fresnel

struct Interface {
    double cosine, n, k;
};

Interface draw_interface(Draw& draw, int kind) {
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

void write_fresnel(const std::string& folder) {
    Table table(
        folder + "/fresnel.csv",
        {"F_s = (c - r)/(c + r), F_p = (n^2 c - r)/(n^2 c + r), r = sqrt(n^2 - 1 + c^2), index n + ik;",
         "F2 = (|F_s|^2 + |F_p|^2)/2."},
        "cos_theta,n,k,Fs_re,Fs_im,Fp_re,Fp_im,F2");
    Draw draw(4);
    std::vector<Interface> interfaces{{1, 1.5, 0},         {1, 0.183, 3.43},  {1e-8, 1.5, 0},
                                      {1e-8, 0.05, 1000},  {1, 1 + 1e-12, 0}, {0.5, 1 + 1e-12, 0},
                                      {0.5, 1 - 1e-12, 0}, {0.5, 100, 1000}};
    for (int i = 0; i < 292; ++i) interfaces.push_back(draw_interface(draw, i));
    for (const auto& [cosine, n, k] : interfaces) {
        const Fresnel f = fresnel(cosine, {Real(n), Real(k)});
        table.add({text(cosine), text(n), text(k), text(f.s.re), text(f.s.im), text(f.p.re), text(f.p.im),
                   text(f.unpolarised())});
    }
    table.close();
}

// -------------------------------------------------------------------------------------------------- model

constexpr double smallest_angle = 0.01, largest_angle = 89.99;  // degrees

bool within_range(double degrees) {
    return degrees >= smallest_angle && degrees <= largest_angle;
}

Point draw_material(Draw& draw) {
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
bool view_within_lobe(Draw& draw, Point& p) {
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
bool draw_geometry(Draw& draw, int kind, Point& p) {
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
std::pair<Point, Reflection> draw_point(Draw& draw, int kind) {
    while (true) {
        Point p = draw_material(draw);
        if (!draw_geometry(draw, kind, p) || !within_range(p.theta_i) || !within_range(p.theta_r)) continue;
        const Reflection f = reflection(p);
        if (f.g <= 2e5 && f.directional_diffuse > Real("1e-280")) return {p, f};
    }
}

std::vector<std::string> with(std::vector<std::string> row, const std::vector<Real>& values) {
    for (const Real& value : values) row.push_back(text(value));
    return row;
}

void write_model(const std::string& folder) {
    Table table(
        folder + "/model.csv",
        {"Points of `hts eval` and the whole model of [He91] there; m00 ... m33 of the directional-diffuse "
         "term",
         "in the Stokes convention of the interface. specular_reflectance may lie below a double's range; t "
         "= 0",
         "is the exact mirror direction. The degrees are the doubles as printed, converted at 80 digits."},
        std::string(point_columns) +
            ",directional_diffuse,uniform_diffuse,brdf,specular_reflectance,"
            "m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23,m30,m31,m32,m33,"
            "g,t,effective_roughness_um,shadowing,fresnel");
    Draw draw(5);
    ModelChecks checks;
    for (int i = 0; i < 400; ++i) {
        const auto [p, f] = draw_point(draw, i);
        checks.add(p, f);
        std::vector<Real> values{f.directional_diffuse, f.uniform_diffuse,
                                 Real(f.directional_diffuse + f.uniform_diffuse), f.specular_reflectance};
        for (const auto& row : f.mueller) values.insert(values.end(), row.begin(), row.end());
        values.insert(values.end(), {f.g, f.t, f.effective_roughness, f.shadowing, f.fresnel});
        table.add(with(cells(p), values));
    }
    table.close();
    checks.finish();
}

// ------------------------------------------------------------------------------------------------- limits

/// Points of the lobe with g from 1e3 to 1e9 in the mirror direction: the literal model must approach the
/// Beckmann microfacet model as 1/g.
void write_limits(const std::string& folder) {
    Table table(folder + "/limits.csv",
                {"Approach to geometric optics: the literal model and F S D_B/(4 cos cos), D_B of [Walter07 "
                 "(25)] with",
                 "alpha = 2 sigma/tau. Their ratio is 1 + (q^2/2 - 2q + 1)/g + O(1/g^2) with q = t/g."},
                std::string(point_columns) + ",g,t,directional_diffuse,geometric_optics_limit");
    Draw draw(6);
    for (int rows = 0; rows < 60;) {
        Point p = draw_material(draw);
        p.theta_i = draw.uniform(1, 80);
        const Real root_g = sqrt(Real(draw.log_uniform(1e3, 1e9)));
        p.wavelength =
            static_cast<double>(Real(4 * pi * Real(p.rms_roughness) * cos(radians(p.theta_i)) / root_g));
        if (!view_within_lobe(draw, p) || !within_range(p.theta_r)) continue;
        const Reflection f = reflection(p);
        const Real limit = geometric_optics_limit(p, f);
        if (limit < Real("1e-30")) continue;
        table.add(with(cells(p), {f.g, f.t, f.directional_diffuse, limit}));
        ++rows;
    }
    table.close();
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::cerr << "usage: generate_reference FOLDER\n";
        return 2;
    }
    const std::string folder = argv[1];
    check_sum_rules();
    check_stride();
    write_phi(folder);
    write_shadowing(folder);
    write_effective_roughness(folder);
    write_fresnel(folder);
    write_model(folder);
    write_limits(folder);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "generate_reference: " << error.what() << '\n';
    return 1;
}
