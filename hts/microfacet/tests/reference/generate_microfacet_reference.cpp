// Generates the reference values of the tests of hts/microfacet/: the lobes as their papers print them
// (brackets and normalisation as the headers state), at 80 digits, independently of the library; angles of
// the half direction by atan2.
//
//   build   g++ -std=c++20 -O2 -I.
//           hts/microfacet/tests/reference/generate_microfacet_reference.cpp (header-only Boost)
//   run     generate_microfacet_reference FOLDER      writes FOLDER/microfacet.csv, in a
//           second; the folder must exist

#include <algorithm>
#include <iostream>

#include "hts/tests/reference/reference_numbers.hpp"

namespace {

using namespace reference;

struct Pair {
    double theta_i, phi_i, theta_r, phi_r;  // deg

    [[nodiscard]] Vector in() const { return direction(radians(theta_i), radians(phi_i)); }
    [[nodiscard]] Vector out() const { return direction(radians(theta_r), radians(phi_r)); }
};

struct Parameters {
    double mx, my, f0, alpha, nx, ny, cx, cy, slope_angle;
};

/// Cosines and angles of the half direction.
struct Half {
    Real ci, co, cd, theta, phi;

    explicit Half(const Pair& p) {
        const Vector i = p.in(), o = p.out();
        const Vector sum{i.x + o.x, i.y + o.y, i.z + o.z};
        const Vector h = sum / length(sum);
        ci = i.z;
        co = o.z;
        cd = dot(i, h);
        theta = acos(h.z);
        phi = atan2(h.y, h.x);
    }
};

Real square(const Real& x) {
    return x * x;
}

Real schlick(const Real& f0, const Real& c) {
    return f0 + (1 - f0) * pow(1 - c, 5);
}

Real q(const Half& h, const Real& mx, const Real& my) {
    return exp(-square(tan(h.theta)) * (square(cos(h.phi) / mx) + square(sin(h.phi) / my)));
}

Real kurt(const Half& h, const Parameters& p) {
    const Real D = q(h, p.mx, p.my) / (pi * Real(p.mx) * p.my * pow(cos(h.theta), 4));
    return schlick(p.f0, h.cd) * D / (4 * h.cd * pow(h.ci * h.co, Real(p.alpha)));
}

Real kurt_pdf(const Half& h, const Parameters& p) {
    return q(h, p.mx, p.my) / (4 * pi * Real(p.mx) * p.my * pow(cos(h.theta), 3) * h.cd);
}

Real ward(const Half& h, const Parameters& p) {
    return q(h, p.mx, p.my) / (4 * pi * Real(p.mx) * p.my * sqrt(h.ci * h.co));
}

Real ward_duer(const Half& h, const Parameters& p) {
    return q(h, p.mx, p.my) / (4 * pi * Real(p.mx) * p.my * h.ci * h.co);
}

Real cook_torrance(const Half& h, const Parameters& p) {
    const Real D = q(h, p.mx, p.mx) / (pi * square(p.mx) * pow(cos(h.theta), 4));
    Real G = 1;
    for (const Real& c : {h.ci, h.co}) G = std::min(G, Real(2 * cos(h.theta) * c / h.cd));
    return schlick(p.f0, h.cd) * D * G / (4 * h.ci * h.co);
}

Real blinn_phong(const Half& h, const Parameters& p) {
    const Real n = p.nx;
    return (n + 2) * (n + 4) / (8 * pi * (pow(Real(2), -n / 2) + n)) * pow(cos(h.theta), n);
}

Real ashikhmin_shirley(const Half& h, const Parameters& p) {
    const Real e = p.nx * square(cos(h.phi)) + p.ny * square(sin(h.phi));
    return sqrt((Real(p.nx) + 1) * (Real(p.ny) + 1)) / (8 * pi) * pow(cos(h.theta), e) * schlick(p.f0, h.cd) /
           (h.cd * std::max(h.ci, h.co));
}

Real ashikhmin_shirley_diffuse(const Half& h, const Parameters& p) {
    return 28 / (23 * pi) * (1 - Real(p.f0)) * (1 - pow(1 - h.ci / 2, 5)) * (1 - pow(1 - h.co / 2, 5));
}

Real lafortune(const Pair& pair, const Parameters& p) {
    const Vector i = pair.in(), o = pair.out();
    const Real cosine = p.cx * i.x * o.x + p.cy * i.y * o.y + i.z * o.z;
    return cosine > 0 ? Real((Real(p.nx) + 2) / (2 * pi) * pow(cosine, Real(p.nx))) : Real(0);
}

Real oren_nayar(const Pair& pair, const Parameters& p) {
    const Real s2 = square(p.slope_angle);
    const Real A = 1 - s2 / 2 / (s2 + Real("0.33")), B = Real("0.45") * s2 / (s2 + Real("0.09"));
    const Real i = radians(pair.theta_i), o = radians(pair.theta_r);
    const Real between = std::max(Real(0), Real(cos(radians(pair.phi_i) - radians(pair.phi_r))));
    return (A + B * between * sin(std::max(i, o)) * tan(std::min(i, o))) / pi;
}

/// The outgoing direction: anywhere, or that to which a facet of a few widths' slope mirrors, if
/// it is above the horizon.
Pair draw_pair(Draw& draw, const Parameters& p, bool anywhere) {
    const double degree = static_cast<double>(180 / pi);
    for (;;) {
        const double theta = draw.chance(0.3) ? 90 - draw.log_uniform(0.1, 30) : draw.uniform(0.01, 85);
        Pair pair{theta, draw.uniform(0, 360), draw.uniform(0.01, 89.9), draw.uniform(0, 360)};
        if (anywhere) return pair;
        const double x = p.mx * draw.signed_log_uniform(0.01, 4), y = p.my * draw.signed_log_uniform(0.01, 4);
        const Vector h = Vector{x, y, 1} / length({x, y, 1}), i = pair.in();
        const Real c = dot(i, h);
        const Vector o{2 * c * h.x - i.x, 2 * c * h.y - i.y, 2 * c * h.z - i.z};
        if (o.z < 2e-3) continue;
        pair.theta_r = static_cast<double>(acos(o.z)) * degree;
        pair.phi_r = static_cast<double>(atan2(o.y, o.x)) * degree;
        return pair;
    }
}

Parameters draw_parameters(Draw& draw) {
    Parameters p{};
    p.mx = draw.log_uniform(0.01, 2);
    p.my = draw.log_uniform(0.01, 2);
    p.f0 = draw.uniform(0, 1);
    p.alpha = draw.uniform(0, 1.5);
    p.nx = draw.chance(0.5) ? 2 / (p.mx * p.mx) : draw.log_uniform(0.1, 1e4);
    p.ny = draw.chance(0.5) ? 2 / (p.my * p.my) : draw.log_uniform(0.1, 1e4);
    p.nx = std::min(p.nx, 1e4);
    p.ny = std::min(p.ny, 1e4);
    p.cx = draw.chance(0.5) ? -1 : draw.uniform(-1.3, 1.3);
    p.cy = draw.chance(0.5) ? -1 : draw.uniform(-1.3, 1.3);
    p.slope_angle = draw.uniform(0, 1.5);
    return p;
}

void write(const std::string& folder) {
    Table table(
        folder + "/microfacet.csv",
        {"Lobes of hts/microfacet/ for reflectivity 1 [1/sr], angles in deg; cook_torrance has m = mx, "
         "blinn_phong",
         "and lafortune have n = nx, ashikhmin_shirley_diffuse rd = 1, oren_nayar albedo 1."},
        "theta_i,phi_i,theta_r,phi_r,mx,my,f0,alpha,nx,ny,cx,cy,slope_angle,kurt,kurt_pdf,ward,ward_duer,"
        "cook_torrance,blinn_phong,ashikhmin_shirley,ashikhmin_shirley_diffuse,lafortune,oren_nayar",
        "generate_microfacet_reference");
    Draw draw(20100101);
    for (int k = 0; k < 300; ++k) {
        const Parameters p = draw_parameters(draw);
        const Pair pair = draw_pair(draw, p, k % 5 == 0);
        const Half h{pair};
        std::vector<std::string> row;
        for (const double x : {pair.theta_i, pair.phi_i, pair.theta_r, pair.phi_r, p.mx, p.my, p.f0, p.alpha,
                               p.nx, p.ny, p.cx, p.cy, p.slope_angle}) {
            row.push_back(text(x));
        }
        for (const Real& value : {kurt(h, p), kurt_pdf(h, p), ward(h, p), ward_duer(h, p),
                                  cook_torrance(h, p), blinn_phong(h, p), ashikhmin_shirley(h, p),
                                  ashikhmin_shirley_diffuse(h, p), lafortune(pair, p), oren_nayar(pair, p)}) {
            row.push_back(text(value));
        }
        table.add(row);
    }
    table.close();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: generate_microfacet_reference FOLDER\n";
        return 2;
    }
    try {
        write(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
