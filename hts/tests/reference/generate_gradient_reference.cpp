// Generates the reference derivatives of the He-Torrance tests, independently of the engine: central
// differences of the printed forms of He et al. 1991 at 80 digits (reference_model.hpp), at points from a
// fixed seed. No derivative is written down here, so a mistake in one cannot hide.
//
//   run     generate_gradient_reference FOLDER   writes FOLDER/{gradient,mueller_gradient,
//                                                visibility_gradient,fresnel_gradient}.csv; the folder must
//                                                exist; a minute or two
//   exit    0 done, 1 a check failed or a file could not be written, 2 wrong usage
//
// With steps of 1e-20 of a length or index, and of 1e-20 rad, the differences keep about 25 digits: the
// truncation is 1e-40 times the third derivative, which is below 1e13 for the narrowest lobe here, and 55
// digits less the 20 of the step remain of the model. Derivatives by k at k = 0 are those of the analytic
// continuation, equal to the one-sided.

#include <array>
#include <iostream>

#include "reference_checks.hpp"
#include "reference_draws.hpp"

namespace {

using namespace reference;
using RealPoint = PointOf<Real>;

const Real step{"1e-20"};

RealPoint exact(const Point& p) {
    return {Real(p.wavelength), Real(p.theta_i),       Real(p.phi_i),
            Real(p.theta_r),    Real(p.phi_r),         Real(p.n),
            Real(p.k),          Real(p.rms_roughness), Real(p.correlation_length),
            Real(p.albedo)};
}

/// A quantity a derivative is taken by.
struct Parameter {
    std::string name;
    Real RealPoint::*member;
    bool is_angle;
};

const std::array<Parameter, 7> parameters{{{"rms_roughness", &RealPoint::rms_roughness, false},
                                           {"correlation_length", &RealPoint::correlation_length, false},
                                           {"n", &RealPoint::n, false},
                                           {"k", &RealPoint::k, false},
                                           {"theta_i", &RealPoint::theta_i, true},
                                           {"theta_r", &RealPoint::theta_r, true},
                                           {"phi", &RealPoint::phi_r, true}}};
constexpr std::size_t parameters_of_mirror = 5;  // the first ones

/// Everything that is differentiated.
struct Values {
    Real directional_diffuse, specular;
    std::array<Real, 16> lobe;   // its Mueller matrix
    std::array<Real, 4> mirror;  // elements 00, 01, 22, 23 of its Mueller matrix
};

Values values(const RealPoint& p) {
    const Reflection f = reflection(p);
    Values result{f.directional_diffuse, f.specular_reflectance, {}, {}};
    for (std::size_t e = 0; e < 16; ++e) result.lobe[e] = f.mueller[e / 4][e % 4];
    const Fresnel amplitudes = fresnel(cos(radians(p.theta_i)), {p.n, p.k});
    const Mueller m = mueller({amplitudes.s, {}, {}, amplitudes.p});
    const Real scale = f.specular_reflectance / m[0][0];
    result.mirror = {scale * m[0][0], scale * m[0][1], scale * m[2][2], scale * m[2][3]};
    return result;
}

/// Derivatives of everything by one parameter, by angles in radians.
Values derivatives(const Point& p, const Parameter& by, const Real& relative_step) {
    RealPoint below = exact(p), above = below;
    const Real at = below.*by.member;
    const Real half_step =
        by.is_angle ? Real(relative_step * 180 / pi) : Real(relative_step * (at > 0 ? at : Real(1)));
    below.*by.member -= half_step;
    above.*by.member += half_step;
    const Values low = values(below), high = values(above);
    const Real scale = 1 / (by.is_angle ? 2 * relative_step : 2 * half_step);
    const auto slope = [&scale](const Real& from, const Real& to) { return Real(scale * (to - from)); };
    Values result{
        slope(low.directional_diffuse, high.directional_diffuse), slope(low.specular, high.specular), {}, {}};
    for (std::size_t e = 0; e < 16; ++e) result.lobe[e] = slope(low.lobe[e], high.lobe[e]);
    for (std::size_t e = 0; e < 4; ++e) result.mirror[e] = slope(low.mirror[e], high.mirror[e]);
    return result;
}

/// 18 digits, which are more than a double has; 0 for what the differences leave of zeros.
std::string brief(const Real& value, const Real& beside) {
    return abs(value) <= Real("1e-20") * abs(beside) ? "0" : value.str(17, std::ios_base::scientific);
}

/// The same derivatives with another step.
class StepCheck {
  public:
    void add(const Point& p, const Parameter& by, const Values& found, const Real& beside) {
        const Values other = derivatives(p, by, 3 * step);
        // relative to the value and the derivative together, since a derivative may be 0
        worst_.add(
            beside + abs(found.directional_diffuse) + other.directional_diffuse - found.directional_diffuse,
            beside + abs(found.directional_diffuse), by.name);
    }
    void finish() const { worst_.finish(); }

  private:
    Worst worst_{"derivatives with steps of 1e-20 and 3e-20", "7e-33"};
};

void write_gradient(const std::string& folder) {
    std::string header = std::string(point_columns) + ",directional_diffuse,specular_reflectance";
    for (const Parameter& by : parameters) header += ",directional_diffuse_by_" + by.name;
    for (std::size_t i = 0; i < parameters_of_mirror; ++i) header += ",specular_by_" + parameters[i].name;
    Table table(folder + "/gradient.csv",
                {"The directional-diffuse BRDF and the specular reflectance with their derivatives: by the "
                 "lengths [1/um],",
                 "by n and k, and by the angles [1/rad], phi the outgoing azimuth. Those of the specular "
                 "term may lie below",
                 "a double's range."},
                header, "generate_gradient_reference");
    Draw draw(7);
    StepCheck check;
    for (int i = 0; i < 300; ++i) {
        const Point p = draw_point(draw, i).first;
        const Values here = values(exact(p));
        std::vector<std::string> row = cells(p), of_mirror;
        row.push_back(brief(here.directional_diffuse, 0));
        row.push_back(brief(here.specular, 0));
        for (const Parameter& by : parameters) {
            const Values slopes = derivatives(p, by, step);
            if (i % 10 == 0) check.add(p, by, slopes, here.directional_diffuse);
            row.push_back(brief(slopes.directional_diffuse, here.directional_diffuse));
            of_mirror.push_back(brief(slopes.specular, here.specular));
        }
        row.insert(row.end(), of_mirror.begin(), of_mirror.begin() + parameters_of_mirror);
        table.add(row);
    }
    table.close();
    check.finish();
}

void write_mueller_gradient(const std::string& folder) {
    std::string header = std::string(point_columns) + ",m00,s00";
    for (const Parameter& by : parameters)
        for (std::size_t e = 0; e < 16; ++e)
            header += ",m" + std::to_string(e / 4) + std::to_string(e % 4) + "_by_" + by.name;
    for (std::size_t i = 0; i < parameters_of_mirror; ++i)
        for (const char* element : {"00", "01", "22", "23"})
            header += std::string(",s") + element + "_by_" + parameters[i].name;
    Table table(folder + "/mueller_gradient.csv",
                {"Derivatives of the Mueller matrices of the directional-diffuse term, m, and of the "
                 "specular term, s (element",
                 "10 is 01, 11 is 00, 33 is 22, 32 is -23, the rest 0), in the Stokes convention of the "
                 "interface; units as in",
                 "gradient.csv."},
                header, "generate_gradient_reference");
    Draw draw(8);
    for (int i = 0; i < 60; ++i) {
        const Point p = draw_point(draw, i).first;
        const Values here = values(exact(p));
        std::vector<std::string> row = cells(p), of_mirror;
        row.push_back(brief(here.directional_diffuse, 0));
        row.push_back(brief(here.specular, 0));
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            const Values slopes = derivatives(p, parameters[j], step);
            for (const Real& slope : slopes.lobe) row.push_back(brief(slope, here.directional_diffuse));
            if (j >= parameters_of_mirror) continue;
            for (const Real& slope : slopes.mirror) of_mirror.push_back(brief(slope, here.specular));
        }
        row.insert(row.end(), of_mirror.begin(), of_mirror.end());
        table.add(row);
    }
    table.close();
}

// -------------------------------------------------------------------------------------------- the parts

/// Central difference of a function that gives several values.
template <class Function>
auto difference(const Function& of, const Real& at, const Real& half_step) {
    const auto low = of(Real(at - half_step)), high = of(Real(at + half_step));
    std::vector<Real> result;
    for (std::size_t i = 0; i < low.size(); ++i) result.push_back((high[i] - low[i]) / (2 * half_step));
    return result;
}

void write_visibility_gradient(const std::string& folder) {
    Table table(folder + "/visibility_gradient.csv",
                {"ln K, ln S1 and ln(S1/cos(theta)) of shadowing.csv differentiated by theta [1/rad] and by "
                 "ln(sigma/tau)."},
                "theta_deg,sigma_over_tau,K,log_K_by_theta,log_S1_by_theta,log_S1_over_cos_by_theta,log_K_by_"
                "log_slope,"
                "log_S1_by_log_slope,log_S1_over_cos_by_log_slope",
                "generate_gradient_reference");
    Draw draw(9);
    for (int i = 0; i < 150;) {
        const double degrees = polar_angle(draw, i), slope = draw.log_uniform(1e-3, 10);
        const auto logs = [](const Obstruction& o, const Real& theta) {
            return std::array<Real, 3>{log(o.K), log(o.S1), log(Real(o.S1 / cos(theta)))};
        };
        const Real theta = radians(degrees), K = obstruction(theta, slope).K;
        if (K < Real("1e-290")) continue;
        const auto by_theta =
            difference([&](const Real& x) { return logs(obstruction(x, Real(slope)), x); }, theta, step);
        const auto by_slope = difference(
            [&](const Real& x) { return logs(obstruction(theta, exp(x)), theta); }, log(Real(slope)), step);
        std::vector<std::string> row{text(degrees), text(slope), brief(K, 0)};
        for (const auto& slopes : {by_theta, by_slope})
            for (const Real& value : slopes) row.push_back(brief(value, 0));
        table.add(row);
        ++i;
    }
    table.close();
}

void write_fresnel_gradient(const std::string& folder) {
    Table table(
        folder + "/fresnel_gradient.csv",
        {"Amplitudes of fresnel.csv differentiated by cos_theta and by n, and (F_s + F_p)/sin^2(theta)."},
        "cos_theta,n,k,Fs_re_by_cos,Fs_im_by_cos,Fp_re_by_cos,Fp_im_by_cos,Fs_re_by_n,Fs_im_by_n,Fp_re_by_n,"
        "Fp_im_by_n,sum_re,sum_im",
        "generate_gradient_reference");
    Draw draw(10);
    for (int i = 0; i < 200; ++i) {
        const auto [cosine, n, k] = draw_interface(draw, i);
        const auto parts = [](const Fresnel& f) {
            return std::array<Real, 4>{f.s.re, f.s.im, f.p.re, f.p.im};
        };
        const auto by_cosine = difference(
            [&, n = n, k = k](const Real& x) {
                return parts(fresnel(x, {Real(n), Real(k)}));
            },
            Real(cosine), step * cosine);
        const auto by_n = difference(
            [&, c = cosine, k = k](const Real& x) {
                return parts(fresnel(c, {x, Real(k)}));
            },
            Real(n), step * n);
        const Fresnel f = fresnel(cosine, {Real(n), Real(k)});
        const Real sine_squared = 1 - Real(cosine) * Real(cosine);
        std::vector<std::string> row{text(cosine), text(n), text(k)};
        for (const auto& slopes : {by_cosine, by_n})
            for (const Real& value : slopes) row.push_back(brief(value, Real("1e-10")));
        for (const Real& value : {Real(f.s.re + f.p.re), Real(f.s.im + f.p.im)})
            row.push_back(brief(Real(value / sine_squared), 0));
        table.add(row);
    }
    table.close();
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::cerr << "usage: generate_gradient_reference FOLDER\n";
        return 2;
    }
    const std::string folder = argv[1];
    write_visibility_gradient(folder);
    write_fresnel_gradient(folder);
    write_gradient(folder);
    write_mueller_gradient(folder);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "generate_gradient_reference: " << error.what() << '\n';
    return 1;
}
