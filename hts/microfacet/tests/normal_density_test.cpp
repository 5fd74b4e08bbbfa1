#include "hts/microfacet/normals/normal_density.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/expint.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "chi_squared.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"

using hts::NormalDensity;
using hts::ValueGrid;
using hts::Vector3;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;
using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180, endless = std::numeric_limits<double>::infinity();

Vector3 at(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// A lobe to one side, eight azimuths.
ValueGrid lopsided() {
    ValueGrid grid{9, 8, {}};
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 8; ++j) {
            grid.values.push_back(std::exp(-0.1 * i * i) *
                                  (1 + (i > 0 ? 0.5 * std::cos(j * 45 * degree) : 0)));
        }
    }
    return grid;
}

/// Brighter in the middle of each side.
ValueGrid picture() {
    ValueGrid grid{16, 16, {}};
    for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 16; ++j) grid.values.push_back(1 + std::sin(0.4 * i) * std::cos(0.7 * j));
    }
    return grid;
}

template <class Function>
double adaptive(Function f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 8, 1e-10);
}

/// Many short pieces, for densities with bends and jumps.
template <class Function>
double in_pieces(Function f, double from, double to) {
    constexpr int pieces = 40;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double step = (to - from) / pieces;
        sum +=
            boost::math::quadrature::gauss<double, 7>::integrate(f, from + i * step, from + (i + 1) * step);
    }
    return sum;
}

/// (18) directly, in polar coordinates about k: the integral ends where facets turn away.
double area_about_k(const NormalDensity& density, double theta, double phi) {
    const Vector3 k = at(theta, phi), u = at(theta + pi / 2, phi), v = cross(k, u);
    const auto ring = [&](double c) {
        const double s = std::sqrt((1 - c) * (1 + c));
        const auto p = [&](double a) { return density(c * k + s * std::cos(a) * u + s * std::sin(a) * v); };
        return c * in_pieces(p, 0, 2 * pi);
    };
    return in_pieces(ring, 0, 1);
}

/// The same about n, for facets that face up: to where (h.k) changes sign.
double area_about_n(const NormalDensity& density, double theta, double phi) {
    const Vector3 k = at(theta, phi);
    const auto meridian = [&](double from_k) {
        const double across = std::sin(theta) * std::cos(from_k);
        const double end = across < 0 ? std::atan2(k.z, -across) : pi / 2;
        const auto value = [&](double t) {
            const Vector3 h = at(t, phi + from_k);
            return std::sin(t) * dot(h, k) * density(h);
        };
        return adaptive(value, 0, std::fmin(end, pi / 2));
    };
    return adaptive(meridian, -pi / 2, pi / 2) + adaptive(meridian, pi / 2, pi) +
           adaptive(meridian, pi, 3 * pi / 2);
}

using DirectArea = double (*)(const NormalDensity&, double, double);

void check_areas(const char* name, const NormalDensity& density, DirectArea direct, double bound) {
    WorstCase worst{std::string{"g(k) of "}.append(name), bound};
    for (const double theta : {0.0, 35.0, 70.0, 90.0}) {
        for (const double phi : {10.0, 220.0}) {
            const double expected = direct(density, theta * degree, phi * degree);
            worst.note(4 * std::fabs(density.projected_area(at(theta * degree, phi * degree)) - expected),
                       [&] { return "theta " + std::to_string(theta) + ", phi " + std::to_string(phi); });
        }
    }
    worst.check();
}

}  // namespace

TEST_CASE("normals: isotropic Gaussians agree with their closed forms at 50 digits") {
    WorstCase scale{"p(n)", 1e-11}, mean{"<h.n>", 1e-11};
    for (const double sigma : {0.003, 0.02, 0.1, 0.5, 1.0, 3.0, 20.0}) {
        const Real a = 1 / (Real{sigma} * Real{sigma});
        const Real root = sqrt(a);
        const Real pi_50 = boost::math::constants::pi<Real>();
        // c = 1/(2 pi (1 - sqrt(pi a) e^a erfc(sqrt a))): e^a erfc by its continued
        // fraction where it would cancel
        boost::math::quadrature::tanh_sinh<Real> quadrature;
        const auto over_cosine = [&](Real c) -> Real { return exp(-a * (1 - c * c) / (c * c)); };
        const Real area = 2 * pi_50 * quadrature.integrate(over_cosine, Real{0}, Real{1});
        if (sigma >= 0.5) {
            const Real closed = 2 * pi_50 * (1 - sqrt(pi_50 * a) * exp(a) * erfc(root));
            CHECK(static_cast<double>(abs(closed / area - 1)) < 1e-30);
        }
        const Real projection = pi_50 * exp(a) * boost::math::expint(2, a) / area;
        const auto density = NormalDensity::gaussian(sigma, sigma);
        const auto where = [&] { return "sigma " + std::to_string(sigma); };
        scale.note(relative_error(density({0, 0, 1}), static_cast<double>(1 / area)), where);
        mean.note(relative_error(density.projection(), static_cast<double>(projection)), where);
    }
    scale.check();
    mean.check();
}

TEST_CASE("normals: velvet agrees with 50 digits, and all have the shapes of (34) and (35)") {
    boost::math::quadrature::tanh_sinh<Real> quadrature;
    WorstCase worst{"velvet", 1e-11};
    for (const double sigma : {0.1, 0.5, 2.0}) {
        const auto value = [&](Real z) -> Real {
            return z >= 1 ? Real{0} : Real(exp(-z * z / ((1 - z * z) * sigma * sigma)));
        };
        const Real area =
            2 * boost::math::constants::pi<Real>() * quadrature.integrate(value, Real{0}, Real{1});
        for (const double theta : {30.0, 60.0, 89.0}) {
            const double expected = static_cast<double>(
                value(cos(Real{theta} * boost::math::constants::pi<Real>() / 180)) / area);
            worst.note(
                relative_error(NormalDensity::inverse_gaussian(sigma)(at(theta * degree, 1)), expected),
                [&] { return "sigma " + std::to_string(sigma); });
        }
    }
    worst.check();
    const auto gaussian = NormalDensity::gaussian(0.2, 0.5);
    const double t = std::tan(0.3), c = std::cos(0.7), s = std::sin(0.7);
    CHECK(gaussian(at(0.3, 0.7)) / gaussian({0, 0, 1}) ==
          Approx(std::exp(-t * t * (c * c / 0.04 + s * s / 0.25))).epsilon(1e-12));
    CHECK(gaussian(at(2, 0.7)) == 0);
}

TEST_CASE("normals: projected areas agree with direct quadrature") {
    using hts::accuracy::projected_area, hts::accuracy::projected_area_of_samples;
    check_areas("a Gaussian", NormalDensity::gaussian(0.3, 1), area_about_n, projected_area);
    // the direct one meets a bend of the cylinders at their ends: it is the less exact, by
    // 1.4e-8 (4e-10 refined further)
    check_areas("cylinders", NormalDensity::gaussian(0.3, endless), area_about_n, 4e-8);
    check_areas("velvet", NormalDensity::inverse_gaussian(0.5), area_about_n, projected_area);
    check_areas("grooves", NormalDensity::grooves(40 * degree, 0.3), area_about_k, projected_area);
    // the direct one meets the jump at the ends of the fibres, so it is the less exact of the two
    check_areas("slanted fibres", NormalDensity::slanted_fibres(0.5, 40 * degree), area_about_k, 2e-4);
    check_areas("a table", NormalDensity::tabulated(lopsided()), area_about_k, projected_area_of_samples);
    check_areas("a picture", NormalDensity::image(0.4, 0.5, picture(), 0.9), area_about_k,
                projected_area_of_samples);
}

TEST_CASE(
    "normals: both sides of a facet differ by the mean normal (24), and a hemisphere of normals is closed") {
    Random random{3};
    for (const auto& density :
         {NormalDensity::gaussian(0.02, 0.4), NormalDensity::gaussian(0.1, endless),
          NormalDensity::slanted_fibres(0.5, 40 * degree), NormalDensity::inverse_gaussian(0.3)}) {
        for (int i = 0; i < 50; ++i) {
            const Vector3 k = at(random.uniform(0, pi), random.uniform(0, 2 * pi));
            CHECK(density.projected_area(k) - density.projected_area(-k) ==
                  Approx(dot(density.mean(), k)).margin(hts::accuracy::projected_area));
        }
    }
    const auto even = NormalDensity::gaussian(endless, endless);
    const auto velvet = NormalDensity::inverse_gaussian(endless);
    for (const double theta : {0.0, 0.5, 1.2, pi / 2}) {
        CHECK(even.projected_area(at(theta, 1)) == Approx((1 + std::cos(theta)) / 4).epsilon(1e-9));
        CHECK(velvet.projected_area(at(theta, 1)) == Approx((1 + std::cos(theta)) / 4).epsilon(1e-9));
    }
}

TEST_CASE("normals: a mixture is the sum of its shares") {
    const auto flats = NormalDensity::gaussian(0.1, endless), ends = NormalDensity::gaussian(0.3, endless);
    const auto satin = NormalDensity::mixture({{1.4, flats}, {0.6, ends}});
    const Vector3 k = at(1.1, 0.4), h = at(0.2, 0.1);
    CHECK(satin(h) == Approx(0.7 * flats(h) + 0.3 * ends(h)).epsilon(1e-14));
    CHECK(satin.projected_area(k) ==
          Approx(0.7 * flats.projected_area(k) + 0.3 * ends.projected_area(k)).epsilon(1e-14));
    CHECK(satin.projection() == Approx(0.7 * flats.projection() + 0.3 * ends.projection()).epsilon(1e-14));
    CHECK(satin.symmetry().mirror_x);
    CHECK_FALSE(satin.symmetry().isotropic);
}

TEST_CASE("normals: a tilted mean is a warning, and only that of slanted and lopsided densities") {
    const auto slanted = NormalDensity::slanted_fibres(0.5, 40 * degree);
    REQUIRE(slanted.tilted_mean());
    CHECK(slanted.tilted_mean()->angle == Approx(50 * degree));
    CHECK(slanted.tilted_mean()->text().find("50 deg") != std::string::npos);
    CHECK(slanted.projection() == Approx(2 * slanted.mean().z));
    CHECK(slanted(at(100 * degree, pi)) > 0);  // not a height field
    CHECK(NormalDensity::tabulated(lopsided()).tilted_mean());
    CHECK_FALSE(NormalDensity::grooves(40 * degree, 0.1).tilted_mean());
    CHECK_FALSE(NormalDensity::gaussian(0.1, 1).tilted_mean());
    CHECK_FALSE(NormalDensity::inverse_gaussian(0.5).tilted_mean());
}

TEST_CASE("normals: draws fall as their density says, which is near p") {
    const std::size_t count = hts::testing::exhaustive() ? 1'000'000 : 20'000;
    struct Case {
        const char* name;
        NormalDensity density;
        double most;  // of p over the density of the draw
    };
    for (const Case& each : {Case{"a Gaussian", NormalDensity::gaussian(0.1, 1), 1.5},
                             Case{"cylinders", NormalDensity::gaussian(0.3, endless), 1.5},
                             Case{"grooves", NormalDensity::grooves(40 * degree, 0.2), 1.5},
                             Case{"velvet", NormalDensity::inverse_gaussian(0.5), 1.5},
                             Case{"slanted fibres", NormalDensity::slanted_fibres(0.5, 40 * degree), 1.5},
                             Case{"a table", NormalDensity::tabulated(lopsided()), 4},
                             Case{"a picture", NormalDensity::image(0.4, 0.5, picture(), 0.9), 4}}) {
        const NormalDensity& density = each.density;
        Random random{19};
        double sum = 0, squares = 0, largest = 0, draws = 0;
        const auto draw = [&]() -> std::optional<hts::testing::Angles> {
            const double u0 = random.uniform(0, 1), u1 = random.uniform(0, 1);
            const Vector3 h = density.sample({u0, u1, random.uniform(0, 1)});
            const double ratio = density(h) / density.pdf(h);
            sum += ratio, squares += ratio * ratio, draws += 1;
            largest = std::fmax(largest, ratio);
            return hts::testing::Angles{std::atan2(std::hypot(h.x, h.y), h.z), std::atan2(h.y, h.x)};
        };
        const auto fit = hts::testing::fit_of(
            draw, [&](double theta, double phi) { return density.pdf(at(theta, phi)); }, count);
        INFO(each.name << ": p " << fit.p_value << ", total " << fit.total << ", largest p/pdf " << largest);
        CHECK(fit.p_value > 1e-4);
        CHECK(fit.total == Approx(1).margin(2e-3));
        CHECK(largest <= each.most);
        const double mean = sum / draws, deviation = std::sqrt((squares / draws - mean * mean) / draws);
        CHECK(std::fabs(mean - 1) < 4 * deviation + 2e-4);  // p is normalised
    }
}

TEST_CASE("normals: bad parameters are named") {
    using Catch::Contains;
    CHECK_THROWS_WITH(NormalDensity::gaussian(-0.1, 1),
                      Contains("sigma_x of the normals -0.1: must be at least"));
    CHECK_THROWS_WITH(NormalDensity::gaussian(1, std::nan("")), Contains("sigma_y"));
    CHECK_THROWS_WITH(NormalDensity::grooves(2, 0.1), Contains("slope of the grooves 2 rad"));
    CHECK_THROWS_WITH(NormalDensity::inverse_gaussian(0.01), Contains("at least 0.1"));
    CHECK_THROWS_WITH(NormalDensity::slanted_fibres(0.5, -1), Contains("slant of the fibres -1 rad"));
    CHECK_THROWS_WITH(NormalDensity::tabulated({1, 1, {1}}), Contains("rows of a grid of normals 1"));
    CHECK_THROWS_WITH(NormalDensity::tabulated({2, 1, {1}}), Contains("rows times columns, 2"));
    CHECK_THROWS_WITH(NormalDensity::tabulated({2, 1, {1, -1}}), Contains("value of a grid of normals -1"));
    CHECK_THROWS_WITH(NormalDensity::tabulated({2, 1, {0, 0}}), Contains("largest value"));
    CHECK_THROWS_WITH(NormalDensity::image(0.1, 0.1, {2, 1, {1, 1}}, 0), Contains("extent of the image"));
    CHECK_THROWS_WITH(NormalDensity::mixture({}), Contains("number of densities"));
    CHECK_THROWS_WITH(NormalDensity::mixture({{0, NormalDensity::gaussian(1, 1)}}),
                      Contains("weight in a mixture"));
}
