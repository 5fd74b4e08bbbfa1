#include "hts/phi.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/special_functions/expint.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/phi/phi_sum.hpp"

using hts::phi;
using hts::phi_gradient;
using hts::PhiMethod;
using hts::phi_detail::phi_sum;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double representable = 1e-280;

std::string at(double g, double t) {
    return "g = " + std::to_string(g) + ", t = " + std::to_string(t);
}

}  // namespace

TEST_CASE("phi and its logarithm agree with 50 digits") {
    const ReferenceTable table{"tests/reference/phi.csv"};
    WorstCase value{"phi", hts::accuracy::phi};
    WorstCase log{"log phi", hts::accuracy::log_phi};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto computed = phi(table(row, "g"), table(row, "t"));
        const auto where = [&] { return table.describe(row, {"g", "t"}); };
        const double expected = table(row, "phi");
        const double expected_log = table(row, "log_phi");
        if (expected > representable) value.note(relative_error(computed.value, expected), where);
        log.note(std::abs(computed.log - expected_log) / std::fmax(1, std::abs(expected_log)), where);
    }
    value.check();
    log.check();
}

TEST_CASE("phi at t = 0 is the exponential integral's combination") {
    WorstCase worst{"phi at t = 0", hts::accuracy::phi};
    for (const double g : {0.5, 1.0, 3.0, 10.0, 49.0, 51.0, 200.0, 600.0}) {
        const double expected =
            std::exp(-g) * (boost::math::expint(g) - std::log(g) - boost::math::constants::euler<double>());
        worst.note(relative_error(phi(g, 0).value, expected), [&] { return at(g, 0); });
    }
    worst.check();
}

TEST_CASE("phi of little roughness is its first term") {
    for (const double g : {1e-300, 1e-200, 1e-30, 1e-14}) {
        for (const double t : {0.0, 1e-3, 1.0, 10.0}) {
            CHECK(relative_error(phi(g, t).value, g * std::exp(-t)) < 1e-9);
        }
    }
}

TEST_CASE("phi of much roughness is the geometric-optics limit") {
    for (const double g : {1e12, 1e20, 1e100, 1e300}) {
        for (const double ratio : {0.0, 0.1, 1.0, 30.0}) {
            const double limit = std::exp(-ratio) / g;
            CHECK(relative_error(phi(g, ratio * g).value, limit) < 3e-9);
        }
    }
}

TEST_CASE("phi obeys its sum rule over the plane") {
    // integral of Phi(g, |v|^2 tau^2/4) d^2v = (4 pi / tau^2)(1 - exp(-g)), that is integral of Phi dt = 1 -
    // exp(-g)
    boost::math::quadrature::exp_sinh<double> integrator;
    for (const double g : {0.01, 0.7, 5.0, 48.0, 52.0, 900.0}) {
        const double integral = integrator.integrate([g](double t) { return phi(g, t).value; }, 1e-13);
        CHECK(integral == Approx(-std::expm1(-g)).epsilon(1e-11));
    }
}

TEST_CASE("phi obeys g^2 phi_gg + ... : its defining equation in g") {
    // Psi = g (dPhi/dg + Phi) has dPsi/dt = -Phi; both by central differences of log Phi
    Random random{5};
    for (int i = 0; i < 200; ++i) {
        const double g = random.logarithmic(0.1, 1e4);
        const double t = g * random.uniform(0.01, 8);
        const auto psi = [g](double u) {
            const double h = 1e-4 * g;
            const double derivative = (phi(g + h, u).value - phi(g - h, u).value) / (2 * h);
            return g * (derivative + phi(g, u).value);
        };
        const double step = 1e-3 * std::sqrt(t * g) / (1 + g) * (1 + t / g);
        const double slope = (psi(t + step) - psi(t - step)) / (2 * step);
        CHECK(slope == Approx(-phi(g, t).value).epsilon(1e-4));
    }
}

TEST_CASE("the two ways of summing phi meet") {
    // m* = 50 and a width of 3 separate them; Phi itself changes by about 1e-9 over the gap taken here
    WorstCase worst{"sums across their regimes", 1e-11};
    for (const double t : {0.0, 1.0, 10.0}) {
        const double g = 50 * std::exp(-t / 2500);
        const auto below = phi_sum(g * (1 - 1e-13), t);
        const auto above = phi_sum(g * (1 + 1e-13), t);
        CHECK(below.method == PhiMethod::sum);
        CHECK(above.method == PhiMethod::trapezoid);
        worst.note(std::abs(below.log - above.log), [&] { return at(g, t); });
        worst.note(relative_error(below.inverse_mean, above.inverse_mean), [&] { return at(g, t); });
        worst.note(std::abs(below.excess - above.excess) / g, [&] { return at(g, t); });
    }
    worst.check();
}

TEST_CASE("phi by summation agrees with 50 digits") {
    const ReferenceTable table{"tests/reference/phi.csv"};
    WorstCase log{"log of the sum", 1e-14};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double expected = table(row, "log_phi");
        log.note(std::abs(phi_sum(table(row, "g"), table(row, "t")).log - expected) /
                     std::fmax(1, std::abs(expected)),
                 [&] {
                     return table.describe(row, {"g", "t"});
                 });
    }
    log.check();
}

TEST_CASE("the gradient of phi agrees with 50 digits") {
    const ReferenceTable table{"tests/reference/phi.csv"};
    WorstCase value{"phi with its gradient", hts::accuracy::phi_gradient};
    WorstCase d_g{"d phi / dg", hts::accuracy::phi_gradient};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double g = table(row, "g"), expected = table(row, "phi"), psi_over_g = table(row, "psi") / g;
        if (!(expected > representable)) continue;
        const auto computed = phi_gradient(g, table(row, "t"));
        const auto where = [&] { return table.describe(row, {"g", "t"}); };
        value.note(relative_error(computed.value, expected), where);
        d_g.note(std::abs(computed.d_g - (psi_over_g - expected)) / (psi_over_g + expected), where);
        CHECK(computed.d_g == Approx(computed.value * computed.log_d_g));
        CHECK(computed.d_t == Approx(computed.value * computed.log_d_t));
    }
    value.check();
    d_g.check();
}

TEST_CASE("the gradient of phi from its table agrees with the sums") {
    const hts::Tolerance tolerance{hts::accuracy::tabled_phi_gradient};
    WorstCase worst{"gradient of phi, table against sums", hts::accuracy::tabled_phi_gradient};
    Random random{6};
    for (int i = 0; i < 300000; ++i) {
        const double g = random.logarithmic(1e-4, 1e8);  // the sums of g d ln Phi/dg lose 1e-16 sqrt(g)
        const double end_of_octave = std::exp2(std::floor(random.uniform(1, 40))) * (1 - 0x1p-52);
        const double t = i % 4 == 0   ? g * random.uniform(0, 300)
                         : i % 4 == 1 ? std::fmax(g, 1) * random.logarithmic(1e-8, 100)
                         : i % 4 == 2 ? random.logarithmic(1e-6, 1e4)
                                      : end_of_octave - 1;
        const auto summed = phi_gradient(g, t), tabled = phi_gradient(g, t, tolerance);
        if (!(summed.value > representable)) continue;
        const auto where = [&] { return at(g, t); };
        worst.note(relative_error(tabled.value, summed.value), where);
        worst.note(relative_error(tabled.d_t, summed.d_t), where);
        worst.note(std::abs(tabled.d_g - summed.d_g) / (summed.d_g + 2 * summed.value), where);
        // g d ln Phi/dg = Psi/Phi - g keeps its digits where both terms are large
        worst.note(g * std::abs(tabled.log_d_g - summed.log_d_g) / (1 + g * std::abs(summed.log_d_g)), where);
        CHECK(std::abs(tabled.log - summed.log) <=
              hts::accuracy::log_phi * std::fmax(1, std::abs(summed.log)));
    }
    worst.check();
    for (const double g : {0.0, 1e-300, 1e300})
        for (const double t : {0.0, 1e4, 1e300})
            CHECK(phi_gradient(g, t, tolerance).d_t == Approx(phi_gradient(g, t).d_t).epsilon(1e-10));
    CHECK(phi_gradient(3, 4, hts::Tolerance{1e-12}).d_t == phi_gradient(3, 4).d_t);
}

TEST_CASE("the gradient of phi at the edges of its domain") {
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(phi_gradient(0, 3).value == 0);
    CHECK(phi_gradient(0, 3).d_g == std::exp(-3));
    CHECK(phi_gradient(0, 3).d_t == 0);
    CHECK(phi_gradient(5, infinity).value == 0);
    CHECK(phi_gradient(1e-310, 2).d_g == Approx(std::exp(-2)));
    CHECK(phi_gradient(1e12, 0).log_d_g == Approx(-1e-12).epsilon(1e-6));  // where Psi/g and Phi cancel
    for (const double g : {0.0, 5e-324, 1e-300, 1e-10, 1.0, 50.0, 1e10, 1e300}) {
        for (const double t : {0.0, 5e-324, 1e-300, 1.0, 1e10, 1e300, infinity}) {
            const auto gradient = phi_gradient(g, t);
            INFO(at(g, t));
            CHECK(gradient.value >= 0);
            CHECK(std::isfinite(gradient.d_g));
            CHECK(gradient.d_t <= 0);
            CHECK(gradient.log_d_t <= 0);
            CHECK_FALSE(std::isnan(gradient.log_d_g));
        }
    }
}

TEST_CASE("phi is total") {
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(phi(0, 3).value == 0);
    CHECK(phi(0, 3).log == -infinity);
    CHECK(phi(0, 3).method == PhiMethod::zero);
    CHECK(phi(7, infinity).value == 0);
    for (const double g : {5e-324, 1e-300, 1e-10, 1.0, 50.0, 1e10, 1e300}) {
        for (const double t : {0.0, 5e-324, 1e-300, 1.0, 1e10, 1e300}) {
            const auto computed = phi(g, t);
            INFO(at(g, t));
            CHECK(computed.value >= 0);
            CHECK(computed.value <= 1);
            CHECK(std::isfinite(computed.log));
        }
    }
}

TEST_CASE("phi of lists that are not equally long is an error") {
    const std::vector<double> two(2, 1.0), three(3, 1.0);
    std::vector<double> result(2);
    phi(two, two, result, hts::Tolerance{1e-6});
    CHECK_THROWS_AS(phi(two, three, result, hts::Tolerance{1e-6}), hts::Error);
    CHECK_THROWS_AS(phi(three, two, result, hts::Tolerance{1e-6}), hts::Error);
    CHECK_THROWS_AS(phi(three, three, result, hts::Tolerance{1e-6}), hts::Error);
}
