// Rows 6 to 8: backscatter, the normal, and Fresnel.

#include <algorithm>
#include <cmath>

#include "bench/rivals/ggx.hpp"
#include "bench/stability/failures.hpp"
#include "bench/stability/stability_rows.hpp"
#include "hts/polarisation.hpp"
#include "hts/tests/reference/reference_model.hpp"

namespace hts::bench {
namespace {

using Value = std::complex<double>;

constexpr double jones_bound = 2e-14;    ///< of the engine's Jones matrix, relative to |F|
constexpr double factor_bound = 4e-15;   ///< of the engine's G, relative
constexpr double fresnel_bound = 4e-15;  ///< of the engine's |F|^2, relative

Value rounded(const reference::Complex& value) {
    return {static_cast<double>(value.re), static_cast<double>(value.im)};
}

/// A pair of directions [deg], and the same at 80 digits, where an angle that the literal forms cannot bear
/// has been moved by 1e-25.
struct Pair {
    double theta_i, phi_i, theta_r, phi_r;

    [[nodiscard]] std::string text() const {
        return place({{"theta_i", theta_i}, {"phi_i", phi_i}, {"theta_r", theta_r}, {"phi_r", phi_r, "deg"}});
    }
    [[nodiscard]] Direction in() const { return Direction::from_degrees(theta_i, phi_i); }
    [[nodiscard]] Direction out() const { return Direction::from_degrees(theta_r, phi_r); }
};

struct ExactRays {
    reference::Vector in, out;
};

ExactRays exact(const Pair& pair) {
    const auto off_the_normal = [](double degrees, const char* least) {
        return degrees == 0 ? reference::Real(least) : reference::radians(degrees);
    };
    const reference::Real apart = pair.phi_i == pair.phi_r ? reference::Real("1e-25") : reference::Real(0);
    return {
        -reference::direction(off_the_normal(pair.theta_i, "1e-25"), reference::radians(pair.phi_i)),
        reference::direction(off_the_normal(pair.theta_r, "2e-25"), reference::radians(pair.phi_r) + apart)};
}

/// Largest difference of an element from the true one, relative to |F|; NaN if any is.
template <class Matrix>
double jones_error(const Matrix& computed, const reference::Jones& expected, double sign) {
    const double scale = std::sqrt(static_cast<double>(expected.half_sum_of_squares()));
    double worst = 0;
    const auto note = [&](Value element, const reference::Complex& truth) {
        const double error = std::abs(sign * element - rounded(truth)) / scale;
        worst = error > worst || std::isnan(error) ? error : worst;
    };
    note(computed.ss, expected.ss);
    if (!std::isnan(worst)) note(computed.sp, expected.sp);
    if (!std::isnan(worst)) note(computed.ps, expected.ps);
    if (!std::isnan(worst)) note(computed.pp, expected.pp);
    return worst;
}

struct JonesRivals {
    Contestant engine, printed;
};

/// The engine's Jones matrix, the printed one, and with `patched` the printed one with a fixed axis along the
/// normal.
void compare_jones(StabilityRow& row, const Pair& pair, const JonesRivals& rivals,
                   const Contestant* patched) {
    const ExactRays rays = exact(pair);
    const RefractiveIndex index{1.2, 3.4};
    const auto truth = reference::jones(
        rays.in, rays.out,
        reference::fresnel(reference::length(rays.out - rays.in) / 2, {index.n(), index.k()}));
    const FresnelAmplitudes f = fresnel(wave_vector_change(pair.in(), pair.out()).cos_theta_d(), index);
    // the engine leaves out the phase factor -1
    row.compare_error(rivals.engine, jones_error(facet_jones(pair.in(), pair.out(), f), truth, -1),
                      pair.text());
    const auto naive_rays = Naive<double>::rays_of(pair.in(), pair.out());
    const Amplitudes<double> amplitudes{f.s, f.p};
    row.compare_error(rivals.printed,
                      jones_error(Naive<double>::jones_as_printed(naive_rays, amplitudes), truth, 1),
                      pair.text());
    if (patched == nullptr) return;
    row.compare_error(
        *patched,
        jones_error(Naive<double>::jones_as_printed(naive_rays, amplitudes, NormalFrame::fixed_axis), truth,
                    1),
        pair.text());
}

void compare_factor(StabilityRow& row, const Pair& pair) {
    const ExactRays rays = exact(pair);
    const auto expected = static_cast<double>(reference::geometrical_factor(rays.in, rays.out));
    const double root = wave_vector_change(pair.in(), pair.out()).root_geometrical_factor();
    row.compare(
        {"engine, G", true, factor_bound,
         "Each bracket of (76) equals |k_r x k_i|^2 and cancels: G = (v.v/v_z)^2 needs no division by it."},
        root * root, expected, pair.text());
    row.compare(
        {"G as printed", false, rival_bound,
         "Both brackets and |k_r x k_i|^4 vanish together: 0/0 at backscatter, rounding noise near it."},
        Naive<double>::geometrical_factor_as_printed(Naive<double>::rays_of(pair.in(), pair.out())), expected,
        pair.text());
}

struct Interface {
    double cosine, n, k;
};

void compare_fresnel(StabilityRow& row, const Interface& at) {
    const auto expected =
        static_cast<double>(reference::fresnel(reference::Real(at.cosine), {at.n, at.k}).unpolarised());
    const std::string where = place({{"cos theta_d", at.cosine}, {"n", at.n}, {"k", at.k}});
    row.compare({"engine", true, fresnel_bound,
                 "F_s = (1 - N^2)/(c + r)^2 and its p twin: no difference of nearly equal numbers is left."},
                fresnel(at.cosine, {at.n, at.k}).unpolarised_reflectance(), expected, where);
    const Value index{at.n, at.k};
    row.compare({"(c - r)/(c + r)", false, rival_bound,
                 "r tends to c as n tends to 1, and nothing is left of c - r."},
                Naive<double>::fresnel(at.cosine, index).unpolarised_reflectance(), expected, where);
    row.compare({"real arithmetic, as renderers", false, rival_bound,
                 "The same difference, squared: below 1e-16 the reflectance is noise."},
                conductor_reflectance(at.cosine, at.n, at.k), expected, where);
    row.compare({"Schlick", false, 1e-2,
                 "A fit to ordinary dielectrics; absorption and indices near 1 lie outside it."},
                Naive<double>::fresnel_schlick(at.cosine, index), expected, where);
}

}  // namespace

StabilityRow factors_at_backscatter() {
    StabilityRow row{6, "G and M as printed at backscatter"};
    const JonesRivals rivals{
        {"engine, Jones matrix", true, jones_bound,
         "A rotation into the facet's plane, diag(F_s, F_p), a rotation out: every factor is at "
         "most 1, and at backscatter any plane will do, since F_s = -F_p there."},
        {"Jones matrix as printed", false, rival_bound,
         "(61)-(64) divide products that vanish at backscatter by |k_r x k_i|^2, which does too."}};
    for (const double apart : {0.0, 1e-13, 1e-10, 1e-7, 1e-4, 1.0, 90.0}) {
        for (const double theta : {5.0, 40.0, 80.0}) {
            const Pair pair{theta, 30, theta, 30 + apart};
            compare_factor(row, pair);
            compare_jones(row, pair, rivals, nullptr);
        }
    }
    return row;
}

StabilityRow frames_along_the_normal() {
    StabilityRow row{7, "s and p vectors along the normal"};
    const JonesRivals rivals{
        {"engine, Jones matrix", true, jones_bound,
         "A direction keeps its azimuth when it is vertical, so s and p have their limits."},
        {"Jones matrix as printed", false, rival_bound, "s = k x z/|k x z| is 0/0 along the normal."}};
    const Contestant patched{"Jones matrix, s = y along the normal", false, rival_bound,
                             "A fixed axis is not the limit along the given azimuth: the frame jumps."};
    for (const Pair& pair : {Pair{0, 25, 30, 130}, Pair{30, 130, 0, 25}, Pair{0, 25, 0, 130},
                             Pair{1e-9, 25, 30, 130}, Pair{1e-14, 200, 60, 10}, Pair{0, 70, 89.9, 20}}) {
        const bool both_vertical = pair.theta_i == 0 && pair.theta_r == 0;
        compare_jones(row, pair, rivals, both_vertical ? nullptr : &patched);
    }
    return row;
}

StabilityRow fresnel_cancellation() {
    StabilityRow row{8, "Fresnel: n near 1, |n| large, grazing"};
    for (const Interface& at : {Interface{0.7, 1 + 0x1p-40, 0},
                                {0.5, 1 + 0x1p-27, 1e-9},
                                {1e-5, 1 + 0x1p-33, 0},
                                {0.5, 1, 1e-13},
                                {0.9, 1 - 0x1p-45, 0},
                                {1, 1 + 0x1p-50, 0},
                                {1e-8, 1.5, 0},
                                {1e-12, 0.2, 3.5},
                                {0, 1.5, 0},
                                {0, 0.2, 3.5},
                                {0.3, 1e10, 1e10},
                                {0.9, 200, 1e12},
                                {0.8, 1e24, 1e24},
                                {0.8, 0.9, 6},
                                {0.6, 1.5, 0}}) {
        compare_fresnel(row, at);
    }
    return row;
}

}  // namespace hts::bench
