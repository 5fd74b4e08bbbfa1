// Rows 9 and 10: lengths at their limits, and surfaces outside gentle slopes.

#include <cmath>
#include <numbers>

#include "bench/stability/stability_model.hpp"
#include "bench/stability/stability_rows.hpp"
#include "hts/terms.hpp"

namespace hts::bench {
namespace {

constexpr double steepest_slope = 0.25;  ///< sigma_0/tau beyond which multiple scattering counts
constexpr ModelPoint inside_limits{0.5, 30, 0, 40, 170, 1.2, 3.4, 0.2, 3};

std::string lengths(const ModelPoint& p) {
    return place(
        {{"lambda", p.wavelength}, {"sigma0", p.rms_roughness}, {"tau", p.correlation_length, "um"}});
}

/// The lowest value that still has all its digits.
constexpr double smallest_value = 1e-280;

void compare_models(StabilityRow& row, const ModelPoint& p, const ModelValues& expected,
                    const std::string& where) {
    const std::string why =
        "Every limit is a branch of a total function: no length may be 0 or infinite but sigma0 = "
        "0, which is a mirror.";
    const ModelValues ours = engine_model(p);
    const auto vanished = [](double value) { return value < smallest_value ? 0 : value; };
    row.compare({"engine, directional diffuse", true, accuracy::brdf, why}, vanished(ours.diffuse),
                vanished(expected.diffuse), where);
    row.compare({"engine, specular", true, accuracy::specular_reflectance, why}, vanished(ours.specular),
                vanished(expected.specular), where);
    row.compare({"directional diffuse as printed", false, rival_bound,
                 "exp(-g) underflows for short wavelengths and the sum ends at 0; 0/0 at the normal."},
                vanished(Naive<double>::model(p)), vanished(expected.diffuse), where);
    row.compare({"specular as printed", false, rival_bound, "The formula itself is sound here."},
                vanished(Naive<double>::specular(p)), vanished(expected.specular), where);
}

ModelPoint with_wavelength(double um) {
    ModelPoint p = inside_limits;
    p.wavelength = um;
    return p;
}

ModelPoint with_lengths(double rms_roughness, double correlation_length) {
    ModelPoint p = inside_limits;
    p.rms_roughness = rms_roughness;
    p.correlation_length = correlation_length;
    return p;
}

void compare_at_80_digits(StabilityRow& row, const ModelPoint& p) {
    compare_models(row, p, reference_model(p), lengths(p));
}

/// sigma_0 = 0: the Fresnel mirror.
void compare_mirror(StabilityRow& row) {
    const ModelPoint p = with_lengths(0, 3);
    compare_models(row, p, {0, reference_mirror(p)}, lengths(p));
}

/// tau -> infinity: no slope, so S = 1, sigma = sigma_0 and all diffuse light in the mirror direction.
void compare_flat(StabilityRow& row) {
    const ModelPoint p = with_lengths(0.05, 1e24);
    const double phase =
        4 * std::numbers::pi * p.rms_roughness / p.wavelength * std::cos(std::numbers::pi / 6);
    compare_models(row, p, {0, reference_mirror(p) * std::exp(-phase * phase)}, lengths(p));
}

/// wavelength -> 0: geometric optics.
void compare_short_wave(StabilityRow& row) {
    const ModelPoint p = with_wavelength(1e-24);
    compare_models(row, p, {reference_rough_limit(p), 0}, lengths(p));
}

/// The shadowing of (25) as printed, in the literal model's place.
double with_printed_shadowing(const ModelPoint& p, double correct) {
    const double slope = p.rms_roughness / p.correlation_length;
    double ratio = 1;
    for (const double degrees : {p.theta_i, p.theta_r}) {
        const double cosine = Direction::from_degrees(degrees, 0).cos_theta();
        ratio *= Naive<double>::shadowing_as_printed(cosine, slope) / Naive<double>::shadowing(cosine, slope);
    }
    return correct * ratio;
}

void compare_steep(StabilityRow& row, double slope, double theta_r) {
    ModelPoint p{0.55, 0, 0, theta_r, 180, 1.5, 0, slope * 10, 10};
    const std::string where = place({{"sigma0/tau", slope}, {"theta_i", 0}, {"theta_r", theta_r, "deg"}});
    const double computed = engine_model(p).diffuse;
    p.theta_i = 1e-6;  // what happens at 0 is another row's subject
    const double as_printed = Naive<double>::model(p);
    p.theta_i = 1e-25;  // the literal forms are 0/0 at 0
    const double expected = reference_model(p).diffuse;
    row.compare({"engine, directional diffuse", true, accuracy::brdf, "Finite and exact as arithmetic."},
                computed, expected, where);
    row.compare({"directional diffuse as printed", false, rival_bound,
                 "g is in the thousands, where exp(-g) is 0 and the sum ends at 0."},
                as_printed, expected, where);
    row.compare(
        {"(25) as printed", false, rival_bound, "Without exp(-c^2) the shadowing of the surface is wrong."},
        with_printed_shadowing(p, expected), expected, where);
    if (slope > steepest_slope) {
        row.judge(
            {"engine, validity", true, 0,
             "A slope this steep scatters light more than once, which the model leaves out."},
            {Verdict::model, slope, "model: sigma0/tau above " + brief(steepest_slope) + ", not gentle"},
            where);
    }
}

}  // namespace

StabilityRow extreme_lengths() {
    StabilityRow row{9, "sigma0, tau and wavelength at their limits"};
    compare_mirror(row);
    compare_flat(row);
    compare_short_wave(row);
    for (const ModelPoint& p : {inside_limits, with_lengths(1e-24, 3), with_lengths(0.2, 1e-24),
                                with_wavelength(1e-8), with_wavelength(1e24), with_lengths(0.2, 1e3)}) {
        compare_at_80_digits(row, p);
    }
    return row;
}

StabilityRow steep_surfaces() {
    StabilityRow row{10, "sandpaper, sigma0/tau = 4.4"};
    for (const double slope : {0.5, 4.4}) {
        for (const double theta_r : {10.0, 45.0, 80.0, 89.0}) compare_steep(row, slope, theta_r);
    }
    return row;
}

}  // namespace hts::bench
