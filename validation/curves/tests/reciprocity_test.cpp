#include "validation/curves/reciprocity.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace hts::validation;

namespace {

/// Scattered pairs and their partners; the partner of pair i is brighter by `errors[i]` in the logarithm.
CurveSet with_partners(const std::vector<double>& errors) {
    Curve curve{{0.5, 0.5}, Sweep::scattered, {}};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double theta = 10 + 7 * static_cast<double>(i), value = 0.1 + 0.01 * theta;
        curve.points.push_back({theta, 20, 75, 160, value, 0});
        curve.points.push_back(
            {75, 30, theta, -110, value * std::exp(errors[i]), 0});  // 140 deg the other way
    }
    CurveSet set;
    set.curves = {curve};
    return set;
}

}  // namespace

TEST_CASE("reciprocal pairs are found whatever the azimuths, and their errors measured") {
    const auto perfect = reciprocity(with_partners({0, 0, 0}));
    CHECK(perfect.pairs == 3);
    CHECK(perfect.rms_log == Approx(0).margin(1e-15));
    const auto errors = reciprocity(with_partners({0.1, -0.3, 0.2, 0.05}));
    CHECK(errors.pairs == 4);
    CHECK(errors.median_abs_log == Approx(0.15));
    CHECK(errors.rms_log == Approx(std::sqrt((0.01 + 0.09 + 0.04 + 0.0025) / 4)));
    CHECK(errors.worst.log_ratio == Approx(0.3));
    CHECK(errors.worst.there.theta_i == 17);
    CHECK(errors.relative_uncertainty() == Approx(0.15 / (0.67449 * std::sqrt(2.0))).epsilon(1e-5));
}

TEST_CASE("what is no pair does not count") {
    CurveSet set = with_partners({0.1});
    set.curves[0].points[1].phi_r += 1;  // other azimuth
    CHECK(reciprocity(set).pairs == 0);
    set = with_partners({0.1});
    set.curves[0].points[1].value = 0;
    CHECK(reciprocity(set).pairs == 0);
    set = with_partners({0.1});
    set.scale = Scale::specular;
    CHECK(reciprocity(set).pairs == 0);
    set = with_partners({0.1});
    set.curves.push_back({{0.6, 0.6}, Sweep::scattered, {set.curves[0].points[1]}});
    set.curves[0].points.pop_back();  // now at another wavelength
    CHECK(reciprocity(set).pairs == 0);
}

TEST_CASE("BRDF times cosine is reciprocal after the cosine is taken out") {
    CurveSet set = with_partners({0, 0});
    set.quantity = Quantity::brdf_cosine;
    for (CurvePoint& p : set.curves[0].points) p.value *= p.pair().out.cos_theta();
    CHECK(reciprocity(set).pairs == 2);
    CHECK(reciprocity(set).rms_log == Approx(0).margin(1e-14));
}
