#include "validation/curves/prediction.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "validation/curves/quadrature.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi;

spectral::Material aluminium(double rms_roughness, double correlation_length, double albedo = 0) {
    return spectral::he_torrance_material("aluminium", {rms_roughness, correlation_length},
                                          spectral::built_in_optical_constants("Al"),
                                          spectral::DiffuseAlbedo{albedo});
}

spectral::Reflectance exactly(const spectral::Material& material, double um) {
    return material.at(Wavelength::from_micrometres(um),
                       {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
}

CurveSet set_of(Curve curve, std::optional<double> source = {}, std::optional<double> detector = {}) {
    CurveSet set;
    set.source_solid_angle = source;
    set.detector_solid_angle = detector;
    set.curves = {std::move(curve)};
    return set;
}

Curve in_plane(Band band, double theta_i, std::vector<double> angles) {
    Curve curve{band, Sweep::outgoing, {}};
    for (const double angle : angles)
        curve.points.push_back(in_plane_point(Sweep::outgoing, theta_i, angle, 1, 0));
    return curve;
}

/// Small equal parts of a cone of a solid angle, each with its middle: nothing that the library's own rule
/// shares.
struct Part {
    Direction direction;
    double weight;  // [sr, projected]
};

std::vector<Part> parts_of_cone(const Direction& axis, double solid_angle, int radial, int around) {
    std::vector<Part> parts;
    const Vector3 z = axis.vector();
    Vector3 x = cross(z, Vector3{0.3, 0.5, -0.8});
    x = (1 / std::sqrt(dot(x, x))) * x;
    const Vector3 y = cross(z, x);
    const double drop = solid_angle / (2 * pi);
    for (int i = 0; i < radial; ++i) {
        const double c = 1 - drop * (i + 0.5) / radial, s = std::sqrt(1 - c * c);
        for (int j = 0; j < around; ++j) {
            const double a = 2 * pi * (j + 0.5 * (i % 2)) / around;
            const Vector3 at = c * z + s * std::cos(a) * x + s * std::sin(a) * y;
            if (at.z > 0)
                parts.push_back({Direction::from_unit_vector(at), at.z * solid_angle / (radial * around)});
        }
    }
    return parts;
}

/// Averages over both cones by brute force.
struct BruteForce {
    double diffuse, specular;
};

BruteForce brute_force(const spectral::Reflectance& model, const DirectionPair& pair, double source,
                       double detector, int radial, int fine) {
    const double edge = 1 - detector / (2 * pi);
    double diffuse = 0, specular = 0, lit = 0, all = 0, light = 0, view = 0;
    const auto outgoing = parts_of_cone(pair.out, detector, radial, 2 * radial);
    for (const Part& in : parts_of_cone(pair.in, source, radial, 2 * radial)) {
        for (const Part& out : outgoing) {
            diffuse += in.weight * out.weight * model.brdf({in.direction, out.direction})[0];
            all += in.weight * out.weight;
        }
    }
    for (const Part& in : parts_of_cone(pair.in, source, fine, 2 * fine)) {
        light += in.weight;
        if (dot(in.direction.mirror().vector(), pair.out.vector()) < edge) continue;
        specular += in.weight * model.specular_reflectance(in.direction)[0].value();
        lit += in.weight;
    }
    for (const Part& out : parts_of_cone(pair.out, detector, fine, 2 * fine)) view += out.weight;
    return {diffuse / all, lit > 0 ? specular / (light * view) : 0};
}

}  // namespace

TEST_CASE("Gauss and Legendre's nodes rise and integrate what they promise") {
    double worst = 0;
    for (const int n : {1, 2, 3, 8, 31, 64}) {
        const GaussLegendre rule = gauss_legendre(n);
        REQUIRE(rule.nodes.size() == static_cast<std::size_t>(n));
        CHECK(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
        for (const int degree : {0, 2 * n - 2, 2 * n - 1}) {
            double sum = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i)
                sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
            worst = std::max(worst, std::abs(sum - 1.0 / (degree + 1)));
        }
    }
    std::cout << "Gauss-Legendre: worst " << worst << '\n';
    CHECK(worst <= validation::accuracy::gauss_legendre);
}

TEST_CASE("the part that two cones share is what quadrature finds") {
    using boost::math::quadrature::gauss_kronrod;
    double worst = 0;
    for (const double a : {0.01, 0.05, 0.3}) {
        for (const double b : {0.01, 0.02, 0.3, 0.9}) {
            for (const double x : {0.05, 0.4, 0.7, 0.99}) {
                const double apart = std::abs(a - b) + x * (a + b - std::abs(a - b));
                // circles about the axis of a, of which the other cone holds an arc
                const auto arc = [&](double psi) {
                    const double c =
                        (std::cos(b) - std::cos(psi) * std::cos(apart)) / (std::sin(psi) * std::sin(apart));
                    return 2 * std::sin(psi) * std::acos(std::clamp(c, -1.0, 1.0));
                };
                const double first = std::max(0.0, apart - b), full = std::max(0.0, b - apart);
                const double inner = 4 * pi * std::pow(std::sin(full / 2), 2);
                const double exact =
                    inner + gauss_kronrod<double, 61>::integrate(arc, std::max(first, full), a, 15, 1e-12);
                worst = std::max(worst, std::abs(common_solid_angle(a, b, apart) / exact - 1));
            }
        }
    }
    std::cout << "common solid angle: worst " << worst << '\n';
    CHECK(worst <= validation::accuracy::common_solid_angle);
    CHECK(common_solid_angle(0.1, 0.2, 0.31) == 0);
    CHECK(common_solid_angle(0.1, 0.2, 0.05) == Approx(2 * pi * (1 - std::cos(0.1))).epsilon(1e-12));
    CHECK(common_solid_angle(0, 0.2, 0) == 0);
}

TEST_CASE("averages over the instrument's cones are those of brute force") {
    const auto material = aluminium(0.28, 1.77);
    const auto model = exactly(material, 2);
    double worst_diffuse = 0, worst_specular = 0;
    for (const double theta_i : {10.0, 45.0, 75.0}) {
        for (const auto& [source, detector] : {std::pair{pi / 1024, pi / 1024}, std::pair{7.9e-4, 2e-3}}) {
            const std::vector<double> angles{theta_i, theta_i + 1, theta_i - 2.1, -30, 5};
            const auto set = set_of(in_plane({2, 2}, theta_i, angles), source, detector);
            const auto values = Prediction{set}.values(material);
            for (std::size_t i = 0; i < angles.size(); ++i) {
                const auto exact =
                    brute_force(model, set.curves[0].points[i].pair(), source, detector, 4, 200);
                const auto bare = Prediction{set_of(set.curves[0])}.values(material)[i];
                INFO("theta_i " << theta_i << ", theta_r " << angles[i] << ", source " << source
                                << ": without cones " << bare);
                const double sum = exact.diffuse + exact.specular;
                (exact.specular > 0 ? worst_specular : worst_diffuse) = std::max(
                    exact.specular > 0 ? worst_specular : worst_diffuse, std::abs(values[i] / sum - 1));
            }
        }
    }
    std::cout << "cones, brute force: worst diffuse " << worst_diffuse << ", with specular " << worst_specular
              << '\n';
    CHECK(worst_diffuse <= 1e-4);
    CHECK(worst_specular <= validation::accuracy::specular_average);
}

TEST_CASE("a small cone sees the specular term as rho / (cos theta_i solid angle)") {
    const auto material = aluminium(0.05, 3);
    const double solid_angle = 1e-5;
    const auto model = exactly(material, 0.5);
    for (const double theta : {0.0, 30.0, 80.0}) {
        const auto curve = in_plane({0.5, 0.5}, theta, {theta});
        const auto pair = curve.points[0].pair();
        const double specular =
            model.specular_reflectance(pair.in)[0].value() / (pair.in.cos_theta() * solid_angle);
        const double expected = specular + model.brdf(pair)[0];
        CHECK(Prediction{set_of(curve, solid_angle)}.values(material)[0] == Approx(expected).epsilon(1e-5));
        CHECK(Prediction{set_of(curve, {}, solid_angle)}.values(material)[0] ==
              Approx(expected).epsilon(1e-5));
        CHECK(Prediction{set_of(curve, solid_angle, solid_angle)}.values(material)[0] ==
              Approx(expected).epsilon(1e-5));
        CHECK(Prediction{set_of(curve)}.values(material)[0] == Approx(model.brdf(pair)[0]).epsilon(2e-6));
    }
}

TEST_CASE("a matt surface measures the same through any cone, also one that dips below the horizon") {
    const auto matt = spectral::he_torrance_material(
        "matt", {0.3, 1}, spectral::OpticalConstants::constant({1, 0}), spectral::DiffuseAlbedo{0.6});
    const auto curve = in_plane({0.5, 0.5}, 85, {-89, 0, 40, 85, 89.5});
    for (const double value : Prediction{set_of(curve, 0.05, 0.3)}.values(matt))
        CHECK(value == Approx(0.6 / pi).epsilon(1e-9));
}

TEST_CASE("eight wavelengths carry the band of 2 to 5.7 um") {
    double worst = 0;
    for (const double rms_roughness : {0.1, 0.5, 2.0}) {
        const auto material = aluminium(rms_roughness, 6);
        for (const double theta_i : {20.0, 60.0}) {
            const auto set = set_of(
                in_plane({2, 5.7}, theta_i, {theta_i, theta_i + 5, theta_i + 12, theta_i - 12, 0}), 7.9e-4);
            const auto eight = Prediction{set}.values(material);
            const auto many = Prediction{set, {.wavelengths = 48}}.values(material);
            for (std::size_t i = 0; i < eight.size(); ++i)
                worst = std::max(worst,
                                 std::abs(eight[i] - many[i]) / *std::max_element(many.begin(), many.end()));
        }
    }
    std::cout << "band 2 to 5.7 um, 8 wavelengths against 48: worst " << worst << " of the peak\n";
    CHECK(worst <= validation::accuracy::band_average);
}

TEST_CASE("quantities, scales and models agree with what they are made of") {
    const auto he = aluminium(0.3, 2, 0.1);
    const Curve curve = in_plane({2, 2}, 30, {30, 45, -20, 60});
    auto set = set_of(curve);
    const auto brdf = Prediction{set}.values(he);
    set.quantity = Quantity::brdf_cosine;
    const auto with_cosine = Prediction{set}.values(he);
    set.quantity = Quantity::reflectance_factor;
    const auto factor = Prediction{set}.values(he);
    set.scale = Scale::specular;
    set.quantity = Quantity::brdf;
    const Prediction relative{set};
    const auto normalised = relative.values(he);
    REQUIRE(normalised.size() == 4);
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        CHECK(with_cosine[i] == Approx(brdf[i] * curve.points[i].pair().out.cos_theta()).epsilon(1e-14));
        CHECK(factor[i] == Approx(brdf[i] * pi).epsilon(1e-14));
        CHECK(normalised[i] == Approx(brdf[i] / brdf[0]).epsilon(1e-14));
    }
    const auto model = exactly(he, 2);
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        const auto pair = curve.points[i].pair();
        CHECK(brdf[i] == Approx(model.brdf(pair)[0]).epsilon(1e-6));
    }
}

TEST_CASE("averages are linear in the answers and reciprocal") {
    Curve there{{2, 5.7}, Sweep::scattered, {{40, 10, 62, 150, 1, 0}}};
    Curve back{{2, 5.7}, Sweep::scattered, {{62, 150, 40, 10, 1, 0}}};
    const auto material = aluminium(0.4, 2);
    const auto forth = Prediction{set_of(there, 2e-3, 5e-3)}.values(material)[0];
    CHECK(forth == Approx(Prediction{set_of(back, 5e-3, 2e-3)}.values(material)[0]).epsilon(1e-12));

    const Prediction prediction{set_of(there, 2e-3)};
    const auto& job = prediction.jobs().at(0);
    CHECK(job.wavelengths.size() == 8);
    Prediction::Answer answer{std::vector<double>(job.pairs.size() * 8, 0.25), {}};
    answer.specular_reflectance.assign(job.incidences.size() * 8, 0.5);
    CHECK(prediction.average(std::vector{answer})[0] == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("changes of what is seen are the differences of what is seen") {
    auto set = set_of(in_plane({2, 2}, 30, {30, 45, -20, 60}), 1e-3);
    for (const Scale scale : {Scale::absolute, Scale::specular}) {
        set.scale = scale;
        const Prediction prediction{set};
        CHECK(prediction.is_affine() == (scale == Scale::absolute));
        const auto averages = [&](double rms_roughness) {
            const auto model = exactly(aluminium(rms_roughness, 2, 0.1), 2);
            return prediction.average(
                std::vector{Prediction::answer(prediction.jobs().at(0), model.evaluator())});
        };
        const double step = 1e-5;
        const auto middle = averages(0.3), above = averages(0.3 + step), below = averages(0.3 - step);
        auto slope = above;
        for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (above[i] - below[i]) / (2 * step);
        const auto change = prediction.change(middle, slope);
        for (std::size_t i = 0; i < change.size(); ++i) {
            const double expected = (prediction.seen(above)[i] - prediction.seen(below)[i]) / (2 * step);
            CHECK(change[i] == Approx(expected).epsilon(1e-6).margin(1e-9));
        }
    }
}

TEST_CASE("single pairs are seen as they are, neighbours of one pair by one evaluation") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({1.0, 2.0});
    const DirectionPair one{Direction::from_degrees(30, 0), Direction::from_degrees(40, 180)};
    const DirectionPair other{Direction::from_degrees(10, 0), Direction::from_degrees(60, 90)};
    const std::vector<PairAtWavelength> points{{one, 0}, {one, 1}, {other, 1}, {one, 0}};
    const Prediction prediction{grid, points};
    CHECK(prediction.jobs().at(0).pairs.size() == 3);
    const auto material = aluminium(0.3, 2, 0.1);
    const auto reflectance = material.at(grid);
    const auto values = prediction.values(material);
    REQUIRE(values.size() == points.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        CHECK(values[i] == reflectance.brdf(points[i].pair)[points[i].wavelength]);
}

TEST_CASE("a prediction refuses numbers of nodes that make no sense") {
    const auto set = set_of(in_plane({2, 2}, 30, {30}));
    CHECK_THROWS_WITH((Prediction{set, {.wavelengths = 0}}),
                      Catch::Contains("number of wavelengths per band 0: must be 1 ... 64"));
    CHECK_THROWS_WITH((Prediction{set, {.rings = 9}}), Catch::Contains("rings per cone 9: must be 0 ... 8"));
}
