#include "hts/correlation/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/correlation/lobe_table.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/unified/unified_terms.hpp"

namespace hts {
namespace {

using testing::relative_error;
using testing::WorstCase;

double square(double x) {
    return x * x;
}

std::string place(double g, double q) {
    return "g = " + shortest(g) + ", q = " + shortest(q);
}

struct Reference {
    double value, inverse_mean;
};

/// Both series of the exponential, C^m = exp(-m x), to 50 digits.
Reference exponential_series(double g, double q) {
    using Real = boost::multiprecision::cpp_bin_float_50;
    const int last = static_cast<int>(g + 20 * std::sqrt(g) + 60);
    Real term = exp(Real{-g}), value = 0, second = 0;
    for (int m = 1; m <= last; ++m) {
        term *= Real{g} / m;
        const Real s = Real{m} * m + Real{q} * q;
        const Real w = term * m / (s * sqrt(s));
        value += w;
        second += w / m;
    }
    return {static_cast<double>(2 * value), static_cast<double>(second / value)};
}

/// Over the greatest value of a lobe: in the body, in the tail, or beyond what is asserted.
enum class Region { body, tail, beyond };
Region region(double value, double peak) {
    return value > 1e-3 * peak ? Region::body : value > 1e-8 * peak ? Region::tail : Region::beyond;
}

/// Compares values and inverse means over random g and q.
void compare(const std::string& name, const Correlation& shape, double most_g,
             const std::function<Reference(double g, double q)>& reference, int cases, double least_q = 1e-4,
             double most_q = 1e4) {
    WorstCase body{name + ", body", accuracy::correlation_lobe},
        tail{name + ", tail", accuracy::correlation_tail};
    WorstCase mean{name + ", 1/m", accuracy::correlation_lobe};
    Random random{7};
    for (int i = 0; i < cases; ++i) {
        const double g = random.logarithmic(1e-5, most_g);
        const double q = std::sqrt(1 + g) * random.logarithmic(least_q, most_q);
        const Reference expected = reference(g, q);
        const ScatteringIntegral computed = shape.lobe(g, q);
        const double peak = reference(g, 0).value;
        const double error = relative_error(computed.value, expected.value);
        const Region where = region(expected.value, peak);
        if (where == Region::body) {
            body.note(error, [&] { return place(g, q); });
            mean.note(relative_error(computed.inverse_mean, expected.inverse_mean),
                      [&] { return place(g, q); });
        }
        if (where == Region::tail) tail.note(error, [&] { return place(g, q); });
    }
    body.check();
    mean.check();
    if (tail.count() > 0) tail.check();
}

std::vector<std::pair<std::string, Correlation>> shapes() {
    const std::vector<Correlation::Part> two_scales{{0.9, Correlation::gaussian(), 1},
                                                    {0.1, Correlation::exponential(), 0.01}};
    return {{"exponential", Correlation::exponential()},
            {"nu 1/4", Correlation::matern(0.25)},
            {"nu 1", Correlation::matern(1)},
            {"nu 3/2", Correlation::matern(1.5)},
            {"nu 5/2", Correlation::matern(2.5)},
            {"nu 10", Correlation::matern(10)},
            {"gaussian", Correlation::gaussian()},
            {"two scales", Correlation::sum(two_scales)}};
}

}  // namespace

TEST_CASE("Correlation: the exponential is its closed series to 50 digits") {
    compare("exponential", Correlation::exponential(), 400, exponential_series, 400);
}

TEST_CASE("Correlation: the Gaussian through the general path is Phi") {
    compare(
        "gaussian", Correlation::gaussian(), 1e7,
        [](double g, double q) {
            return Reference{phi(g, q * q / 4).value, kicks(g, q * q / 4).beta};
        },
        2000, 1e-3, 20);
}

TEST_CASE("Correlation: Matern 3/2 is its integral by direct quadrature") {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    const auto shape = Correlation::matern(1.5);
    WorstCase worst{"nu 3/2 against quadrature", accuracy::correlation_lobe};
    for (const double g : {0.01, 0.7, 3.0, 12.0, 60.0}) {
        for (const double q : {0.0, 0.3, 1.0, 4.0}) {
            const auto integrand = [&](double x) {
                return std::exp(-g) * std::expm1(g * (1 + x) * std::exp(-x)) * x *
                       boost::math::cyl_bessel_j(0, q * x);
            };
            double sum = 0;
            for (double from = 0; from < 64; from += 0.25)
                sum += Rule::integrate(integrand, from, from + 0.25, 2, 1e-13);
            worst.note(relative_error(shape.lobe(g, q).value, 2 * sum), [&] { return place(g, q); });
        }
    }
    worst.check();
}

TEST_CASE("Correlation: the table is the transform, and that is the same on a grid of twice the points") {
    using namespace correlation_detail;
    for (const auto& named : shapes()) {
        const std::string& name = named.first;
        const Correlation& shape = named.second;
        const double bound = name == "two scales" || name == "nu 1/4" ? accuracy::correlation_two_scales
                                                                      : accuracy::correlation_lobe;
        const auto two = [&](const ShapePointer& pointer) {
            const LobeIntegral fine{pointer}, other_grid{pointer, 8192};
            WorstCase body{name + ", table, body", bound};
            WorstCase tail{name + ", table, tail", accuracy::correlation_tail};
            WorstCase rows{name + ", twice the points", accuracy::correlation_lobe};
            Random random{11};
            for (int i = 0; i < 60; ++i) {
                const double g = random.logarithmic(1e-5, 1e7);
                const LobeRow row = fine.row(g), other = other_grid.row(g);
                const double peak = std::exp(row(0).log_lobe);
                for (int j = 0; j < 40; ++j) {
                    const double q = row.width() * random.logarithmic(1e-3, 1e4);
                    const double expected = std::exp(row(q).log_lobe);
                    const double error = relative_error(shape.lobe(g, q).value, expected);
                    const Region where = region(expected, peak);
                    if (where == Region::body) {
                        body.note(error, [&] { return place(g, q); });
                        rows.note(relative_error(std::exp(other(q).log_lobe), expected),
                                  [&] { return place(g, q); });
                    }
                    if (where == Region::tail) tail.note(error, [&] { return place(g, q); });
                }
            }
            body.check();
            tail.check();
            rows.check();
        };
        if (name == "two scales") {
            two(sum_of_shapes({{0.9, gaussian_shape(), 1}, {0.1, matern_shape(0.5), 0.01}}));
        } else if (name == "gaussian") {
            two(gaussian_shape());
        } else {
            const std::vector<std::pair<std::string, double>> orders{{"exponential", 0.5}, {"nu 1/4", 0.25},
                                                                     {"nu 1", 1},          {"nu 3/2", 1.5},
                                                                     {"nu 5/2", 2.5},      {"nu 10", 10}};
            for (const auto& [of, nu] : orders)
                if (of == name) two(matern_shape(nu));
        }
    }
}

TEST_CASE("Correlation: the first order is the spectrum, of rough and of smooth shapes") {
    for (const double nu : {0.05, 0.1, 0.3, 0.9, 3.3, 20.0, 50.0}) {
        const Correlation shape = Correlation::matern(nu);
        WorstCase worst{"first order, nu = " + shortest(nu), 4e-7};
        const double g = 1e-7;
        for (const double q : {0.0, 0.1, 1.0, 3.0, 8.0}) {
            const double expected = 2 * g * std::exp(shape.log_spectrum(q));
            if (expected < 1e-3 * 2 * g * std::exp(shape.log_spectrum(0))) continue;
            worst.note(relative_error(shape.lobe(g, q).value, expected), [&] { return place(g, q); });
        }
        worst.check();
    }
}

TEST_CASE("Correlation: all the light is there, and lobes are positive and fall") {
    for (const auto& named : shapes()) {
        const std::string& name = named.first;
        const Correlation& shape = named.second;
        // beyond the table the power of q is that of its end, which nu = 1/4 is slow to reach
        WorstCase sum_rule{name + ", integral of D q dq", name == "nu 1/4" ? 2e-4 : 1e-7};
        for (const double g : {1e-4, 0.1, 1.0, 8.0, 40.0, 3e3}) {
            // in ln q by the trapezoidal rule
            constexpr double step = 0.02;
            double sum = 0, before = 0;
            bool falls = true, positive = true;
            for (double log_q = -16; log_q < 60; log_q += step) {
                const double q = std::exp(log_q), value = shape.lobe(g, q).value;
                if (log_q > -16 && value > 1e-10 * shape.lobe(g, 0).value)
                    falls = falls && value <= before * (1 + 1e-6);
                positive = positive && value >= 0;
                sum += value / 2 * q * q * step;
                before = value;
            }
            CHECK(falls);
            CHECK(positive);
            sum_rule.note(relative_error(sum, -std::expm1(-g)), [&] { return "g = " + shortest(g); });
        }
        sum_rule.check();
    }
}

TEST_CASE("Correlation: far out, where a cusp scatters, the mean of 1/m is (1 - exp(-g))/g") {
    WorstCase worst{"mean of 1/m from (1 - e^-g)/g", 1e-3};
    for (const double nu : {0.5, 1.0, 1.5}) {
        const auto shape = Correlation::matern(nu);
        for (double g = 1e-5; g < Correlation::most_phase_variance; g *= 1.1) {
            for (double q = 1; q < 1e15; q *= 1.2) {
                const auto [value, log, mean] = shape.lobe(g, q);
                if (value < 1e-10 * shape.lobe(g, 0).value)
                    worst.note(relative_error(mean, -std::expm1(-g) / g), [&] { return place(g, q); });
            }
        }
    }
    worst.check();
}

TEST_CASE("Correlation: moments of the spectrum are those of Matern's formulas") {
    for (const double nu : {0.25, 0.5, 1.0, 1.5, 2.5, 10.0}) {
        const Correlation shape = Correlation::matern(nu);
        WorstCase variance{"variance, nu = " + shortest(nu), accuracy::correlation_moments};
        WorstCase slope{"slopes, nu = " + shortest(nu), accuracy::correlation_moments};
        Random random{3};
        for (int i = 0; i < 300; ++i) {
            const double q = random.logarithmic(1e-2, 1e8), u = q * q;
            variance.note(relative_error(shape.variance_below(q), -std::expm1(-nu * std::log1p(u))),
                          [&] { return "q = " + shortest(q); });
            if (q < 0.3) continue;  // the formula cancels
            using Real = boost::multiprecision::cpp_bin_float_50;
            const Real n{nu}, U{u};
            const Real expected = nu == 1 ? Real{(log(1 + U) - U / (1 + U)) / 2}
                                          : Real{(1 - (1 + n * U) * pow(1 + U, -n)) / (2 * (n - 1))};
            slope.note(relative_error(shape.slope_variance_below(q), static_cast<double>(expected)),
                       [&] { return "q = " + shortest(q); });
        }
        variance.check();
        slope.check();
    }
}

namespace {

struct Table {
    std::vector<double> x, values;
};

Table tabulated(double first, double last, int count, const std::function<double(double)>& f) {
    Table table;
    for (int i = 0; i < count; ++i) {
        table.x.push_back(first * std::pow(last / first, i / (count - 1.0)));
        table.values.push_back(f(table.x.back()));
    }
    return table;
}

void same_lobes(const std::string& name, const Correlation::Scaled& computed, const Correlation& expected,
                double length, double bound) {
    WorstCase worst{name, bound};
    for (const double g : {0.01, 1.0, 10.0, 100.0}) {
        for (const double q : {0.1, 0.5, 1.0, 3.0, 10.0}) {
            const double ours =
                square(computed.length) * computed.shape.lobe(g, q * computed.length / length).value;
            worst.note(relative_error(ours, square(length) * expected.lobe(g, q).value),
                       [&] { return place(g, q); });
        }
    }
    worst.check();
}

}  // namespace

TEST_CASE("Correlation: a table of a K-correlated spectrum scatters as its formula") {
    const double nu = 0.75, length = 0.8, sigma = 0.02, pi = std::numbers::pi;
    const auto density = [&](double f) {
        return 2 * pi * square(sigma * length) * 2 * nu / std::pow(1 + square(2 * pi * f * length), nu + 1);
    };
    const Table table = tabulated(1e-4, 1e3, 300, density);
    const auto scaled = Correlation::of_spectrum(table.x, table.values, true);
    CHECK(relative_error(scaled.rms_roughness, sigma) < 1e-5);
    same_lobes("spectrum of 300 rows", scaled, Correlation::matern(nu), length, 2e-4);

    // S1, one-sided: A/(1 + (B f)^2)^(C/2), C = 2 nu + 1
    const double b = 2 * pi * length, c = 2 * nu + 1;
    const double a2 = sigma * sigma * (c - 1) * b * b / (2 * pi);
    const double a = a2 / b * 2 * std::sqrt(pi) * std::tgamma(c / 2) / std::tgamma((c + 1) / 2);
    const Table profile =
        tabulated(1e-4, 1e3, 300, [&](double f) { return a / std::pow(1 + square(b * f), c / 2); });
    const auto by_profile = Correlation::of_profile_spectrum(profile.x, profile.values, true);
    CHECK(relative_error(by_profile.rms_roughness, sigma) < 2e-3);
    same_lobes("profile's spectrum of 300 rows", by_profile, Correlation::matern(nu), length, 1e-2);
}

TEST_CASE("Correlation: a spectrum that ends is 0 beyond") {
    const Table table = tabulated(1e-2, 1, 60, [](double f) { return 1e-6 / (1 + square(10 * f)); });
    const auto scaled = Correlation::of_spectrum(table.x, table.values, false);
    const double pi = std::numbers::pi;
    // integral of 1e-6/(1 + 100 f^2) 2 pi f df from 0 to 1, the density being held below the first frequency
    const double expected = 1e-6 * pi / 100 * std::log(101.0);
    CHECK(relative_error(square(scaled.rms_roughness), expected) < 3e-3);
    CHECK(scaled.shape.log_spectrum(2 * pi * scaled.length * 2) < -1e300);
    CHECK(scaled.shape.variance_below(2 * pi * scaled.length * 1.3) > 1 - 1e-6);
}

TEST_CASE("Correlation: the lobe of a spectrum that begins and ends is the spectrum in first order") {
    // a corner at the first frequency, a cliff at the last: C oscillates far out, and D falls off a step
    for (const double rows : {11., 33., 161.}) {
        const double pi = std::numbers::pi, g = 1e-3;
        const Table table = tabulated(0.05, 5, static_cast<int>(rows),
                                      [](double f) { return 2e-3 / (1 + std::pow(f / 0.2, 3)); });
        const auto scaled = Correlation::of_spectrum(table.x, table.values, false);
        double worst = 0, where = 0;
        for (double f = 0.01; f < 4; f *= 1.1) {
            const double q = 2 * pi * f * scaled.length;
            const double first = 2 * g * std::exp(-g + scaled.shape.log_spectrum(q));
            const double off = relative_error(scaled.shape.lobe(g, q).value, first);
            if (off > worst) worst = off, where = f;
        }
        std::cout << "spectrum of " << rows << " rows that ends, first order: worst " << worst << " at "
                  << where << "/um\n";
        CHECK(worst < 0.02);
        CHECK(scaled.shape.lobe(g, 2 * pi * 8 * scaled.length).value < 1e-6 * g);
    }
}

TEST_CASE("Correlation: a table of exp(-x) scatters as the exponential") {
    const double length = 3;
    const Table table = tabulated(0.01, 45, 400, [&](double x) { return std::exp(-x / length); });
    same_lobes("autocorrelation of 400 rows", Correlation::of_autocorrelation(table.x, table.values),
               Correlation::exponential(), length, 1e-2);
}

TEST_CASE("Correlation: shapes have names") {
    CHECK(Correlation::exponential().name() == "exponential");
    CHECK(Correlation::matern(1.5).name() == "matern, nu 1.5");
    const std::vector<Correlation::Part> parts{{0.9, Correlation::gaussian(), 1},
                                               {0.1, Correlation::exponential(), 0.05}};
    CHECK(Correlation::sum(parts).name() == "sum of 0.9 of gaussian + 0.1 of exponential");
}

TEST_CASE("Correlation: what no surface has is refused") {
    using Catch::Matchers::Contains;
    const auto refuses = [](const auto& call, const std::string& text) {
        CHECK_THROWS_WITH(static_cast<void>(call()), Contains(text));
    };
    refuses([] { return Correlation::matern(0.01); },
            "nu of a Matern correlation 0.01: must be from 0.05 to 50");
    refuses([] { return Correlation::sum({}); }, "must be one or more");
    const std::vector<Correlation::Part> parts{{-0.5, Correlation::exponential(), 1}};
    refuses([&] { return Correlation::sum(parts); }, "weight in a sum of correlations -0.5: must be > 0");
    const std::vector<double> up{1, 2, 3}, down{1, 3, 2}, zero{0, 1, 2}, good{3, 2, 1}, bad{3, -2, 1},
        flat{1, 1, 1};
    const std::vector<double> two{1, 2};
    refuses([&] { return Correlation::of_spectrum(two, two, false); }, "must be 3 or more");
    refuses([&] { return Correlation::of_spectrum(down, good, false); },
            "frequency 2: must be above the one before, 3");
    refuses([&] { return Correlation::of_spectrum(zero, good, false); }, "frequency 0: must be > 0");
    refuses([&] { return Correlation::of_spectrum(up, bad, false); }, "power spectrum -2: must be > 0");
    refuses([&] { return Correlation::of_spectrum(up, flat, true); }, "variance of heights is infinite");
    refuses([&] { return Correlation::of_profile_spectrum(up, flat, false); },
            "variance of heights is infinite");
    std::vector<double> frequency, nearly_flat;
    for (double f = 0.01; f < 2; f *= 1.2) {
        frequency.push_back(f);
        nearly_flat.push_back(1e-3 * std::pow(1 + f * f / 0.0025, -1.2));
    }
    refuses([&] { return Correlation::of_spectrum(frequency, nearly_flat, true); },
            "must be below -2.5 to be continued, or the variance of heights is mostly that of frequencies");
    const std::vector<double> far{1, 5, 50}, hill{1, 9, 0.01};
    refuses([&] { return Correlation::of_profile_spectrum(far, hill, false); },
            "Abel transform is not positive at 1/um");
    const std::vector<double> high{0.9, 0.8, 0.5}, above{1.5, 0.5, 0};
    refuses([&] { return Correlation::of_autocorrelation(up, high); }, "last autocorrelation 0.5");
    refuses([&] { return Correlation::of_autocorrelation(up, above); }, "autocorrelation 1.5");
    const std::vector<double> box_x{0.01, 0.5, 0.98, 1.02, 1.5}, box{0.999, 0.99, 0.98, 0.01, 0.001};
    refuses([&] { return Correlation::of_autocorrelation(box_x, box); }, "its power spectrum is negative");
}

}  // namespace hts
