#include "validation/scattering/profile_scattering.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "comparison.hpp"

using boost::math::quadrature::gauss_kronrod;
using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi;

/// exp(-g) integral (exp(g exp(-x^2)) - 1) cos(2 sqrt(t) x) dx / sqrt(pi): what Phi_1 is the sum of.
double phi_by_quadrature(double g, double t) {
    const auto integrand = [=](double x) {
        return (std::exp(g * std::expm1(-x * x)) - std::exp(-g)) * std::cos(2 * std::sqrt(t) * x);
    };
    return 2 * gauss_kronrod<double, 61>::integrate(integrand, 0.0, 8.0, 12, 1e-13) / std::sqrt(pi);
}

}  // namespace

TEST_CASE("Phi of a profile is the Fourier integral of its characteristic function") {
    hts::testing::WorstCase worst{"Phi_1 against quadrature", 1e-10};
    for (const double g : {0.01, 0.5, 3.0, 20.0, 150.0}) {
        for (const double t : {0.0, 0.2, 1.0, 4.0}) {
            worst.note(hts::testing::relative_error(profile_phi(g, t), phi_by_quadrature(g, t)),
                       [=] { return "g = " + std::to_string(g) + ", t = " + std::to_string(t); });
        }
    }
    worst.check();
    CHECK(profile_phi(0, 1) == 0);
}

TEST_CASE("Phi of a profile conserves energy and becomes the rough limit") {
    for (const double g : {0.1, 2.0, 30.0}) {
        const auto integrand = [g](double q) { return profile_phi(g, q * q); };
        const double most = 6 * std::sqrt(g + 10);
        CHECK(2 * gauss_kronrod<double, 61>::integrate(integrand, 0.0, most, 12, 1e-12) ==
              Approx(std::sqrt(pi) * -std::expm1(-g)).epsilon(1e-9));
    }
    CHECK(profile_phi(1e4, 0.7e4) == Approx(std::exp(-0.7) / 100).epsilon(1e-3));
}

TEST_CASE("a K-correlated profile scatters all light, first as its spectrum, and has beta of its own") {
    for (const double nu : {0.5, 1.5}) {
        const ProfileHeights heights{{0.1, 0.5, nu}};
        const double length = heights.statistics().correlation_length;
        for (const double g : {0.01, 1.0, 9.0}) {
            double sum = 0;  // over the frequencies of the period that the lags resolve
            constexpr double step = 2 * pi / 102.4;
            for (int i = -1023; i <= 1024; ++i)
                sum += heights.phi(g, std::fabs(i * step)) * step * length / 2;
            CHECK(sum == Approx(std::sqrt(pi) * -std::expm1(-g)).epsilon(1e-9));
        }
        // one kick: the spectrum, and none beyond its cut
        const auto first = [&](double f) { return heights.kicks(1e-4, 2 * pi * f); };
        const auto spectrum = [&](double f) {
            return std::pow(1 + std::pow(2 * pi * f * length, 2), -nu - 0.5);
        };
        CHECK(first(1).phi / first(2).phi == Approx(spectrum(1) / spectrum(2)).epsilon(0.02));
        CHECK(first(1).inverse_mean == Approx(1).epsilon(1e-3));
        CHECK(first(3).phi < 1e-2 * first(2).phi);
    }
    // slopes of frequencies up to 1, and the mean of 1/m that another program found
    const ProfileHeights heights{{0.1, 0.5, 1.5}};
    const auto slope_squared = [](double most) {
        const auto spectrum = [](double f) { return std::pow(1 + std::pow(pi * f, 2), -2.0); };
        return gauss_kronrod<double, 61>::integrate(
                   [&](double f) { return std::pow(2 * pi * f, 2) * spectrum(f); }, 0.0, most) /
               gauss_kronrod<double, 61>::integrate(spectrum, 0.0, most_frequency);
    };
    CHECK(heights.seen().correlation_length() == Approx(std::sqrt(2 / slope_squared(1))).epsilon(1e-9));
    const auto beta = [&](double degrees) {
        const double theta = degrees * pi / 180;
        return heights.kicks(std::pow(2 * pi * 0.1 * (1 + std::cos(theta)), 2), 2 * pi * std::sin(theta))
            .inverse_mean;
    };
    CHECK(beta(42) == Approx(0.57).margin(0.006));
    CHECK(beta(62) == Approx(0.63).margin(0.006));
    CHECK(beta(77) == Approx(0.71).margin(0.006));
}

TEST_CASE("a gently rough profile returns all light, and each model is reciprocal") {
    const RoughnessStatistics gentle{0.3, 20};
    for (const double degrees : {0.0, 30.0, 50.0}) {
        const double theta = degrees * pi / 180;
        const auto lobe = [&](double out) {
            return profile_lobe(ProfileModel::kirchhoff, gentle, theta, out);
        };
        const double total =
            gauss_kronrod<double, 61>::integrate(lobe, -pi / 2 + 0.01, pi / 2 - 0.01, 12, 1e-9) +
            profile_mirror(ProfileModel::kirchhoff, gentle, theta);
        CHECK(total == Approx(1).epsilon(2e-3));
    }
    for (const ProfileModel model : profile_models) {
        const RoughnessStatistics surface{0.25, 1};
        CHECK(profile_lobe(model, surface, 0.5, 1.1) * std::cos(0.5) ==
              Approx(profile_lobe(model, surface, 1.1, 0.5) * std::cos(1.1)).epsilon(1e-12));
        CHECK(profile_mirror(model, RoughnessStatistics{0, 1}, 1) == 1);
    }
}
