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
#include "reference_draws.hpp"

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
