#include "bench/phi/phi_methods.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "bench/phi/phi_spline.hpp"
#include "comparison.hpp"
#include "hts/tests/reference/reference_physics.hpp"

using hts::bench::phi_methods;
using hts::bench::phi_saddle;
using hts::bench::PhiMethodEntry;
using hts::bench::PhiSpline;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

double exact(double g, double t) {
    return static_cast<double>(reference::phi_sums(g, t).phi);
}

std::string at(double g, double t) {
    return "g = " + std::to_string(g) + ", t/g = " + std::to_string(t / g);
}

bool single_precision(const PhiMethodEntry& method) {
    return method.name.starts_with("float");
}

/// A point of the domain, one time in three on its edge.
struct Point {
    double g, t;
};
Point draw(Random& random, const hts::bench::PhiDomain& domain) {
    const bool edge = random.uniform(0, 3) < 1;
    const double g = edge ? random.one_of({domain.least_g, domain.most_g})
                          : random.logarithmic(domain.least_g, domain.most_g);
    const double ratio = random.uniform(0, 3) < 1 ? random.one_of({0, domain.most_ratio})
                                                  : random.logarithmic(1e-6, 1) * domain.most_ratio;
    return {g, ratio * g};
}

}  // namespace

TEST_CASE("every method of phi keeps its error inside its domain") {
    constexpr double representable = 1e-280;
    constexpr double representable_in_float = 1e-30;
    for (const PhiMethodEntry& method : phi_methods()) {
        WorstCase worst{method.title(), method.error};
        Random random{17};
        const int draws = method.name == "series, from m = 1" ? 20 : 60;
        for (int i = 0; i < draws; ++i) {
            const Point drawn = draw(random, method.domain);
            const bool rounded = single_precision(method);
            const double g = rounded ? static_cast<double>(static_cast<float>(drawn.g)) : drawn.g;
            const double t = rounded ? static_cast<double>(static_cast<float>(drawn.t)) : drawn.t;
            const double expected = exact(g, t);
            if (expected < (rounded ? representable_in_float : representable)) continue;
            worst.note(relative_error(method.value(g, t), expected), [&] { return at(g, t); });
        }
        worst.check();
    }
}

TEST_CASE("the naive series fails as it must outside its domain") {
    for (const PhiMethodEntry& method : phi_methods()) {
        if (method.name != "series, fixed" && method.name != "series, adaptive") continue;
        INFO(method.title());
        CHECK_FALSE(relative_error(method.value(1000, 1000), exact(1000, 1000)) < 0.99);
    }
    CHECK(std::isnan(hts::bench::phi_series_fixed(1000.0, 0.0, 200)));
    CHECK(hts::bench::phi_series_adaptive(800.0, 0.0) == 0);
    CHECK(hts::bench::phi_series_adaptive(200.0F, 0.0F) == 0);
}

TEST_CASE("the saddle point of order k converges as g^-(k + 1)") {
    for (const double w : {0.0, 0.02, 0.2, 0.6}) {
        for (const int order : {0, 1, 2}) {
            const auto error = [&](double g) {
                const double t = w * g * g * std::exp(2 * w);
                return std::abs(phi_saddle(g, t, order) / exact(g, t) - 1);
            };
            INFO("w = " << w << ", order = " << order);
            CHECK(error(60) / error(120) == Approx(std::pow(2, order + 1)).epsilon(0.08));
        }
    }
}

TEST_CASE("the first correction of the saddle point is that of the specification") {
    for (const double w : {0.0, 0.1, 1.0, 7.0}) {
        const double a = 1 + 2 * w;
        const double b = 1 + 6 * w;
        const double c = 2 + 24 * w;
        const double expected =
            15 / (8 * a) - 3 * b / (4 * a * a) - c / (8 * a * a) + 5 * b * b / (24 * a * a * a) - 1.0 / 12;
        CHECK(hts::bench::saddle_corrections(w).first == Approx(expected).epsilon(1e-14));
    }
    CHECK(hts::bench::saddle_corrections(0.0).second == Approx(2).epsilon(1e-13));
}

TEST_CASE("at t = 0 the saddle point's corrections are those of the exponential integral") {
    // exp(-g) Ei(g) = (1 + 1/g + 2/g^2 + ...)/g
    CHECK(hts::bench::saddle_corrections(0.0).first == Approx(1).epsilon(1e-13));
}

TEST_CASE("the spline of 1992 stays below one per cent all over its table") {
    WorstCase worst{"spline of 1992, finely sampled", PhiSpline::error};
    Random random{3};
    const PhiSpline& spline = PhiSpline::shared();
    for (int i = 0; i < 20000; ++i) {
        const double g = random.logarithmic(PhiSpline::least_g, PhiSpline::most_g);
        const double root = random.uniform(0, PhiSpline::most_y);
        const double t = root * root * (1 + g);
        worst.note(relative_error(spline(g, t), hts::bench::phi_series_ratios(g, t)),
                   [&] { return at(g, t); });
    }
    worst.check();
    CHECK(PhiSpline::error < 0.01);
    CHECK(std::isnan(spline(2 * PhiSpline::most_g, 1)));
    CHECK(std::isnan(spline(1, 1e4)));
}

TEST_CASE("a natural spline is exact for straight lines and straight at its ends") {
    const auto line = hts::bench::natural_second_derivatives({1, 3, 5, 7, 9});
    for (const double bend : line) CHECK(std::abs(bend) < 1e-14);
    // the equations it solves
    const std::vector<double> y{0, 1, 0, 2, -1, 3};
    const auto z = hts::bench::natural_second_derivatives(y);
    CHECK(z.front() == 0);
    CHECK(z.back() == 0);
    for (std::size_t i = 1; i + 1 < y.size(); ++i) {
        CHECK(z[i - 1] + 4 * z[i] + z[i + 1] == Approx(6 * (y[i - 1] - 2 * y[i] + y[i + 1])));
    }
}
