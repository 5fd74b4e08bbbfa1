// Rows 4 and 5: effective roughness and shadowing.

#include <cmath>
#include <limits>
#include <numbers>

#include "bench/stability/failures.hpp"
#include "bench/stability/stability_rows.hpp"
#include "hts/roughness.hpp"
#include "hts/shadowing.hpp"
#include "hts/tests/reference/reference_physics.hpp"

namespace hts::bench {
namespace {

std::string at(double slope, double degrees) {
    return place({{"sigma0/tau", slope}, {"theta", degrees, "deg"}});
}

/// What 80 digits say of a direction, with the limits at the horizon.
struct True {
    double K, lambda, S1, S1_over_cosine;
};

True reference_visibility(double slope, double degrees) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    if (degrees == 90) return {unbounded, unbounded, 0, 1 / (2 * slope * std::numbers::inv_sqrtpi)};
    const auto theta = reference::radians(degrees);
    const auto exact = reference::obstruction(theta, slope);
    return {static_cast<double>(exact.K), static_cast<double>(exact.lambda), static_cast<double>(exact.S1),
            static_cast<double>(exact.S1 / cos(theta))};
}

// ---- row 4

void judge_iteration(StabilityRow& row, const Contestant& method, const Iteration<double>& end,
                     double expected, const std::string& where) {
    if (!end.converged && std::isfinite(end.roughness_ratio)) {
        row.judge(method,
                  {Verdict::no_convergence, 1, "no root after " + std::to_string(end.steps) + " steps"},
                  where);
        return;
    }
    row.compare(method, end.roughness_ratio, expected, where,
                {static_cast<double>(end.steps), limit_of_steps, "steps"});
}

void compare_roots(StabilityRow& row, double K, const std::string& where) {
    const double expected =
        std::isinf(K) ? 0 : static_cast<double>(reference::effective_roughness_ratio(reference::Real(K)));
    row.compare(
        {"engine", true, 4 * accuracy::effective_roughness,
         "sigma is closed: (z0/sigma0)^2 = W(K^2/8 pi), W Lambert's function, for every K up to infinity."},
        effective_roughness_ratio(K), expected, where);
    using N = Naive<double>;
    judge_iteration(row,
                    {"Newton from z0 = 0", false, rival_bound,
                     "The first step lands where exp(-z0^2/2) is 0, the next returns to 0: a cycle."},
                    N::roughness_by_newton(K, 0), expected, where);
    judge_iteration(
        row,
        {"Newton from z0 = sigma0", false, rival_bound,
         "Far from the root a step is only 1/z0 long; at the horizon K is infinite and the step NaN."},
        N::roughness_by_newton(K, 1), expected, where);
    judge_iteration(
        row,
        {"fixed point", false, rival_bound,
         "The slope of the iteration at its root is -(z0/sigma0)^2, which repels where it exceeds 1."},
        N::roughness_by_fixed_point(K), expected, where);
    judge_iteration(
        row, {"bisection", false, rival_bound, "Safe, but a digit costs more than three exponentials."},
        N::roughness_by_bisection(K), expected, where);
}

// ---- row 5

void compare_engine(StabilityRow& row, double slope, double degrees, const True& expected) {
    const Visibility seen = visibility(Surface{slope, 1}, Direction::from_degrees(degrees, 0));
    const std::string where = at(slope, degrees);
    const std::string why =
        "S1/cos theta is one function, with cos theta + (sigma0/tau) sin theta ierfc(c) below: sums of "
        "positive parts.";
    row.compare({"engine, S1", true, 4 * accuracy::shadowing, why}, seen.shadowing, expected.S1, where);
    row.compare({"engine, S1/cos", true, 4 * accuracy::shadowing, why}, seen.shadowing_over_cosine,
                expected.S1_over_cosine, where);
    const double error = seen.obstruction == expected.K
                             ? 0
                             : std::abs(seen.obstruction - expected.K) / std::fmax(expected.K, 1);
    row.compare_error({"engine, K", true, accuracy::obstruction, "erfc itself, and infinity at the horizon."},
                      error, where);
}

void compare_lambda(StabilityRow& row, double c, double expected, const std::string& where) {
    if (!(expected > 1e-16)) return;  // nothing beside the 1 that S1 adds to it
    using N = Naive<double>;
    row.compare({"Lambda", false, rival_bound, "Both parts agree to 1/2c^2, so 2c^2 roundings are lost."},
                N::lambda(c), expected, where);
    row.compare({"Lambda with 1 - erf", false, rival_bound,
                 "1 - erf(c) keeps no digit beyond c = 6; S1 forgives that, since it adds Lambda to 1."},
                N::lambda_by_erf(c), expected, where);
    row.compare({"Lambda as printed", false, rival_bound,
                 "(25) lacks Smith's factor exp(-c^2): the shadow of a smooth surface does not vanish."},
                N::lambda_as_printed(c), expected, where);
}

void compare_naive_shadowing(StabilityRow& row, double slope, double degrees, const True& expected) {
    using N = Naive<double>;
    const double cosine = Direction::from_degrees(degrees, 0).cos_theta();
    const std::string where = at(slope, degrees);
    row.compare({"S1 as printed", false, rival_bound, "The same missing factor, seen in the reflectance."},
                N::shadowing_as_printed(cosine, slope), expected.S1, where);
    row.compare({"S1, then / cos", false, rival_bound,
                 "Both are 0 at the horizon, and the quotient is needed there."},
                N::shadowing(cosine, slope) / cosine, expected.S1_over_cosine, where);
    compare_lambda(row, N::slope_argument(cosine, slope), expected.lambda, where);
}

}  // namespace

StabilityRow root_of_roughness() {
    StabilityRow row{4, "the root of (81) by iteration"};
    for (const double slope : {0.1, 0.5, 2.0}) {
        for (const double degrees : {30.0, 60.0, 80.0, 85.0, 89.0, 89.9, 89.9999, 90.0}) {
            compare_roots(row, 2 * reference_visibility(slope, degrees).K, at(slope, degrees));
        }
    }
    return row;
}

StabilityRow shadowing_cancellation() {
    StabilityRow row{5, "Lambda, S1 and S1/cos theta"};
    for (const double slope : {1e-10, 0.02, 0.05, 0.1, 0.5, 2.0}) {
        for (const double degrees : {10.0, 40.0, 60.0, 75.0, 85.0, 89.0, 89.999999, 90.0}) {
            const True expected = reference_visibility(slope, degrees);
            compare_engine(row, slope, degrees, expected);
            compare_naive_shadowing(row, slope, degrees, expected);
        }
    }
    return row;
}

}  // namespace hts::bench
