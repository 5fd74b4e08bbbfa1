#include "validation/curves/isotropy.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

/// A curve in the plane from -85 to 85 deg, light at `fixed`.
Curve in_plane(double fixed, const std::function<double(const CurvePoint&)>& value, double step = 0.5) {
    Curve curve{{0.6, 0.6}, Sweep::outgoing, {}};
    for (double angle = -85; angle <= 85; angle += step) {
        curve.points.push_back(in_plane_point(Sweep::outgoing, fixed, angle, 0, 0));
        curve.points.back().value = value(curve.points.back());
    }
    return curve;
}

}  // namespace

TEST_CASE("a matt curve reflects its albedo, whatever the quantity") {
    const double albedo = 0.5, brdf = albedo / std::numbers::pi;
    // light out to 85 deg in the plane is all but what lies near the horizon
    CHECK(
        isotropic_reflectance(in_plane(0, [&](const CurvePoint&) { return brdf; }), Quantity::brdf).value() ==
        Approx(albedo * std::pow(std::sin(85 * std::numbers::pi / 180), 2))
            .epsilon(validation::accuracy::isotropic_reflectance));
    CHECK(isotropic_reflectance(in_plane(0, [&](const CurvePoint&) { return albedo; }),
                                Quantity::reflectance_factor)
              .value() == Approx(albedo).epsilon(0.01));
    CHECK(isotropic_reflectance(in_plane(0,
                                         [&](const CurvePoint& p) {
                                             return brdf * std::cos(p.theta_r * std::numbers::pi / 180);
                                         }),
                                Quantity::brdf_cosine)
              .value() == Approx(albedo).epsilon(0.01));
}

TEST_CASE("the lobe of an isotropic surface reflects what it does in all directions") {
    const auto material =
        spectral::he_torrance_material("aluminium", {2, 14}, spectral::built_in_optical_constants("Al"));
    const auto reflectance = material.at(Wavelength::from_micrometres(0.6));
    for (const double fixed : {0.0, 20.0, 40.0}) {
        const Curve curve =
            in_plane(fixed, [&](const CurvePoint& p) { return reflectance.brdf(p.pair())[0]; });
        INFO(fixed);
        // shadowing and Fresnel's reflectance out of the plane are not those in it
        CHECK(isotropic_reflectance(curve, Quantity::brdf).value() ==
              Approx(reflectance.albedo(Direction::from_degrees(fixed, 0), 0).total()).epsilon(0.15));
    }
}

TEST_CASE("what says nothing of the hemisphere gives no reflectance") {
    const auto flat = [](const CurvePoint&) { return 1.0; };
    CHECK_FALSE(isotropic_reflectance(in_plane(70, flat), Quantity::brdf));
    Curve scattered = in_plane(30, flat);
    scattered.sweep = Sweep::scattered;
    CHECK_FALSE(isotropic_reflectance(scattered, Quantity::brdf));
    CHECK_FALSE(isotropic_reflectance(in_plane(30, flat, 100), Quantity::brdf));
    CurveSet set;
    set.curves = {in_plane(30, flat), in_plane(10, [](const CurvePoint&) { return 2.0; })};
    CHECK(brightest_if_isotropic(set)->fixed_angle == 10);
    set.scale = Scale::unknown;
    CHECK_FALSE(brightest_if_isotropic(set));
}
