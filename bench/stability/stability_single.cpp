// Row 12: single precision.

#include <cmath>

#include "bench/phi/phi_methods.hpp"
#include "bench/rivals/ggx.hpp"
#include "bench/stability/failures.hpp"
#include "bench/stability/stability_model.hpp"
#include "bench/stability/stability_rows.hpp"
#include "hts/phi.hpp"
#include "hts/roughness.hpp"
#include "hts/shadowing.hpp"
#include "hts/tests/reference/reference_model.hpp"

namespace hts::bench {
namespace {

constexpr double single_bound = 1e-4;  ///< what single precision is used for
constexpr double engine_bound = 1e-7;  ///< one rounding of a double to a float is at most 6e-8
using F = Naive<float>;

/// One quantity: its true value, the engine's and the rivals'.
class Quantity {
  public:
    Quantity(StabilityRow& row, std::string name, double expected, std::string where)
        : row_{row}, name_{std::move(name)}, expected_{expected}, where_{std::move(where)} {}

    Quantity& engine(double value) {
        row_.compare({"engine, " + name_ + " in double, rounded once", true, engine_bound,
                      "Arguments stay in double; the result alone is rounded."},
                     static_cast<double>(static_cast<float>(value)), expected_, where_);
        return *this;
    }
    Quantity& rival(const std::string& name, double value, const std::string& why) {
        row_.compare({"float, " + name, false, single_bound, why}, value, expected_, where_);
        return *this;
    }

  private:
    StabilityRow& row_;
    std::string name_;
    double expected_;
    std::string where_;
};

void compare_phi(StabilityRow& row, float g, float ratio) {
    const float t = ratio * g;
    const double expected = reference_phi(static_cast<double>(g), static_cast<double>(t));
    Quantity{row, "Phi", expected,
             place({{"g", static_cast<double>(g)}, {"t/g", static_cast<double>(ratio)}})}
        .engine(phi(static_cast<double>(g), static_cast<double>(t)).value)
        .rival("series, fixed, 40 terms", static_cast<double>(phi_series_fixed(g, t, 40)),
               "m! passes 3.4e38 at m = 35, g^m sooner.")
        .rival("series, adaptive", static_cast<double>(phi_series_adaptive(g, t)),
               "exp(-g) is 0 past g = 104.")
        .rival("series, windowed", static_cast<double>(phi_series_windowed(g, t)),
               "m ln g - ln m! keeps no digit once g ln g passes 1e6.")
        .rival("saddle point, order 1", static_cast<double>(phi_saddle(g, t, 1)),
               "Few terms at small g; in the tail the exponent t/g carries its own rounding.");
}

void compare_shadowing(StabilityRow& row, float slope, double degrees) {
    const Direction direction = Direction::from_degrees(degrees, 0);
    const auto exact = reference::obstruction(reference::radians(degrees), static_cast<double>(slope));
    const Visibility seen = visibility(Surface{static_cast<double>(slope), 1}, direction);
    const auto cosine = static_cast<float>(direction.cos_theta());
    const std::string where = place({{"sigma0/tau", static_cast<double>(slope)}, {"theta", degrees, "deg"}});
    Quantity{row, "S1/cos", static_cast<double>(exact.S1 / cos(reference::radians(degrees))), where}
        .engine(seen.shadowing_over_cosine)
        .rival(
            "S1, then / cos", static_cast<double>(F::shadowing(cosine, slope) / cosine),
            "sqrt(1 - cos^2) near the normal and Lambda at small slope lose digits that S1 does not need.");
    const auto ratio = static_cast<double>(reference::effective_roughness_ratio(2 * exact.K));
    const float K = 2 * F::obstruction(cosine, slope);
    Quantity{row, "sigma", ratio, where}
        .engine(effective_roughness_ratio(2 * seen.obstruction))
        .rival("Newton from z0 = 0", static_cast<double>(F::roughness_by_newton(K, 0).roughness_ratio),
               "The cycle of double precision starts at a smaller K.");
    const auto lambda = static_cast<double>(exact.lambda);
    if (lambda < 1e-30) return;
    Quantity{row, "", lambda, where}.rival("Lambda",
                                           static_cast<double>(F::lambda(F::slope_argument(cosine, slope))),
                                           "2c^2 roundings of 6e-8 are lost where c is large.");
}

void compare_factor(StabilityRow& row, double apart) {
    const Direction in = Direction::from_degrees(40, 30);
    const Direction out = Direction::from_degrees(40, 30 + apart);
    const auto theta = reference::radians(40);
    const auto expected = static_cast<double>(
        reference::geometrical_factor(-reference::direction(theta, reference::radians(30)),
                                      reference::direction(theta, reference::radians(30 + apart))));
    const double root = wave_vector_change(in, out).root_geometrical_factor();
    Quantity{row, "G", expected, place({{"theta", 40, "deg"}, {"degrees from backscatter", apart}})}
        .engine(root * root)
        .rival("G as printed", static_cast<double>(F::geometrical_factor_as_printed(F::rays_of(in, out))),
               "Directions closer than 1e-3 to backscatter are rounding noise.");
}

void compare_fresnel(StabilityRow& row, float cosine, float n, float k) {
    const auto c = static_cast<double>(cosine);
    const RefractiveIndex index{static_cast<double>(n), static_cast<double>(k)};
    const auto expected =
        static_cast<double>(reference::fresnel(reference::Real(c), {index.n(), index.k()}).unpolarised());
    Quantity{row, "|F|^2", expected, place({{"cos theta_d", c}, {"n", index.n()}, {"k", index.k()}})}
        .engine(fresnel(c, index).unpolarised_reflectance())
        .rival("(c - r)/(c + r)", static_cast<double>(F::fresnel(cosine, {n, k}).unpolarised_reflectance()),
               "c - r cancels at n near 1.")
        .rival("real arithmetic", static_cast<double>(conductor_reflectance(cosine, n, k)),
               "The fourth power of |n| passes 3.4e38.");
}

void compare_model(StabilityRow& row, double rms_roughness) {
    const ModelPoint p{0.5, 30, 0, 40, 170, 1.2, 3.4, rms_roughness, 3};
    Quantity{row, "directional diffuse", reference_model(p).diffuse, place({{"sigma0", rms_roughness, "um"}})}
        .engine(engine_model(p).diffuse)
        .rival("directional diffuse as printed", static_cast<double>(F::model(p)),
               "exp(-g) is 0 past g = 104: ordinary roughness renders black.");
}

}  // namespace

StabilityRow single_precision() {
    StabilityRow row{12, "single precision"};
    for (const float g : {0.5F, 20.0F, 90.0F, 150.0F, 1e4F, 1e6F}) {
        for (const float ratio : {0.0F, 2.0F, 30.0F}) compare_phi(row, g, ratio);
    }
    for (const float slope : {0.02F, 0.125F, 0.5F}) {
        for (const double degrees : {1.0, 45.0, 75.0, 85.0, 89.9}) compare_shadowing(row, slope, degrees);
    }
    for (const double apart : {90.0, 1.0, 1e-2, 1e-4, 1e-6}) compare_factor(row, apart);
    for (const float n : {1.5F, 1.0009765625F, 1.00000011920929F, 1e3F, 1e10F})
        compare_fresnel(row, 0.7F, n, n > 2 ? n : 0);
    for (const double rms_roughness : {0.1, 0.3, 1.0}) compare_model(row, rms_roughness);
    return row;
}

}  // namespace hts::bench
