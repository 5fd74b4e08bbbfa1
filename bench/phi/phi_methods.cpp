#include "bench/phi/phi_methods.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bench/phi/phi_spline.hpp"
#include "hts/phi.hpp"
#include "hts/phi/lambert.hpp"

namespace hts::bench {
namespace {

/// The largest summand of the series: m* = g exp(w).
struct Saddle {
    double m, w;
};

Saddle saddle_of(double g, double t) {
    const double w = lambert_w0_of_square(std::sqrt(2 * t) / g) / 2;
    return {w < 1 ? g * std::exp(w) : std::sqrt(t / w), w};
}

/// Standard deviation of the summand about m*.
double width(const Saddle& saddle) {
    return std::sqrt(saddle.m / (1 + 2 * saddle.w));
}

/// First and last m of the windowed series: 8.5 standard deviations and a few for the small ones.
struct Window {
    std::int64_t first, last;
};

Window window(double g, double t) {
    const Saddle saddle = saddle_of(g, t);
    const double reach = 8.5 * width(saddle) + 15;
    return {static_cast<std::int64_t>(std::fmax(1, std::floor(saddle.m - reach))),
            static_cast<std::int64_t>(std::ceil(saddle.m + reach))};
}

/// ln of the summand, g^m/(m! m) exp(-g - t/m).
template <class Number>
Number log_term(Number g, Number t, Number m) {
    return m * std::log(g) - std::lgamma(m + 1) - std::log(m) - t / m - g;
}

/// Coefficients of (1 + y)^power.
template <class Number>
std::array<Number, 5> binomial_series(Number power) {
    std::array<Number, 5> c{1};
    for (std::size_t k = 1; k < c.size(); ++k) {
        const auto index = static_cast<Number>(k);
        c[k] = c[k - 1] * (power - index + 1) / index;
    }
    return c;
}

/// The Taylor coefficients q_j of h about the saddle, and a = 2 q_2.
template <class Number>
struct Exponent {
    Number a, q3, q4, q5, q6;
};

template <class Number>
Exponent<Number> exponent_series(Number w) {
    const auto q = [w](int j) { return Number(j % 2 == 0 ? 1 : -1) * (1 / Number(j * (j - 1)) + w); };
    return {1 + 2 * w, q(3), q(4), q(5), q(6)};
}

template <class Number>
Number first_order(const Exponent<Number>& h, Number power) {
    const auto A = binomial_series(power);
    return (A[2] - (3 * (h.q3 * A[1] + h.q4) - Number(7.5) * h.q3 * h.q3 / h.a) / h.a) / h.a;
}

template <class Number>
Number second_order(const Exponent<Number>& h, Number power) {
    const auto A = binomial_series(power);
    const auto& [a, q3, q4, q5, q6] = h;
    const Number quartic = 3 * A[4];
    const Number sextic = 15 * (q3 * A[3] + q4 * A[2] + q5 * A[1] + q6);
    const Number octic = Number(52.5) * (q3 * q3 * A[2] + 2 * q3 * q4 * A[1] + q4 * q4 + 2 * q3 * q5);
    const Number decic = Number(157.5) * q3 * q3 * (q3 * A[1] + 3 * q4);
    const Number dodecic = Number(433.125) * q3 * q3 * q3 * q3;
    return (quartic + (-sextic + (octic + (-decic + dodecic / a) / a) / a) / a) / (a * a);
}

PhiMethodEntry fixed_series(int terms, double most_g, double error) {
    return {"series, fixed",
            std::to_string(terms) + " terms",
            [terms](double g, double t) { return phi_series_fixed(g, t, terms); },
            false,
            {1e-12, most_g, 10},
            error,
            0};
}

PhiMethodEntry saddle(int order, double least_g, double error) {
    return {"saddle point",
            "order " + std::to_string(order),
            [order](double g, double t) { return phi_saddle(g, t, order); },
            false,
            {least_g, 1e12, 700},
            error,
            0};
}

void add_series(std::vector<PhiMethodEntry>& list) {
    list.push_back(fixed_series(10, 1.1, 1e-6));
    list.push_back(fixed_series(40, 14.5, 1e-6));
    list.push_back(fixed_series(64, 29.5, 1e-6));
    list.push_back(fixed_series(200, 34, 5e-14));
    list.push_back({"series, adaptive", "", phi_series_adaptive<double>, false, {1e-12, 300, 1}, 1e-13, 0});
    list.push_back(
        {"series, from m = 1", "logarithms", phi_series_from_one, false, {1e-12, 1e5, 700}, 1e-10, 0});
    list.push_back(
        {"series, windowed", "logarithms", phi_series_windowed<double>, false, {1e-12, 1e5, 700}, 1e-10, 0});
    list.push_back({"series, windowed", "ratios", phi_series_ratios, false, {1e-12, 1e8, 700}, 1e-12, 0});
}

void add_approximations(std::vector<PhiMethodEntry>& list) {
    list.push_back({"rough limit", "", phi_rough_limit, false, {700, 1e12, 6}, 1e-2, 0});
    list.push_back(saddle(0, 120, 1e-2));
    list.push_back(saddle(1, 150, 1e-4));
    list.push_back(saddle(2, 200, 1e-6));
    const PhiSpline& spline = PhiSpline::shared();
    list.push_back({"spline of 1992", "80 x 80", [&spline](double g, double t) { return spline(g, t); },
                    false, PhiSpline::domain, PhiSpline::error, spline.bytes()});
}

/// Functions of single precision, called with rounded arguments.
std::function<double(double, double)> rounded(float (*function)(float, float)) {
    return [function](double g, double t) {
        return static_cast<double>(function(static_cast<float>(g), static_cast<float>(t)));
    };
}

void add_single_precision(std::vector<PhiMethodEntry>& list) {
    list.push_back(
        {"float series, adaptive", "", rounded(phi_series_adaptive<float>), false, {1e-12, 30, 1}, 2e-6, 0});
    list.push_back(
        {"float series, windowed", "", rounded(phi_series_windowed<float>), false, {1e-12, 100, 1}, 1e-4, 0});
    list.push_back({"float saddle point",
                    "order 1",
                    rounded([](float g, float t) { return phi_saddle(g, t, 1); }),
                    false,
                    {150, 1e12, 20},
                    1e-4,
                    0});
}

/// This project's evaluator at each tolerance; what is added here, everything else follows.
void add_ours(std::vector<PhiMethodEntry>& list) {
    for (const auto& [setting, error] : {std::pair{"1e-3", 1e-3}, {"1e-6", 1e-6}, {"1e-12", accuracy::phi}}) {
        const Tolerance tolerance{error};
        list.push_back({"hts::phi",
                        setting,
                        [tolerance](double g, double t) { return phi(g, t, tolerance); },
                        true,
                        {1e-12, 1e12, 700},
                        error,
                        phi_table_bytes(tolerance)});
    }
}

}  // namespace

template <class Number>
Number phi_series_fixed(Number g, Number t, int terms) {
    Number sum = 0;
    for (int i = 1; i <= terms; ++i) {
        const auto m = static_cast<Number>(i);
        sum += std::pow(g, m) / (std::tgamma(m + 1) * m) * std::exp(-t / m);
    }
    return std::exp(-g) * sum;
}

template <class Number>
Number phi_series_adaptive(Number g, Number t) {
    Number poisson = std::exp(-g);
    Number sum = 0;
    for (Number m = 1;; ++m) {
        poisson *= g / m;
        const Number term = poisson / m * std::exp(-t / m);
        sum += term;
        if (!(term > Number(1e-15) * sum)) return sum;
    }
}

double phi_series_from_one(double g, double t) {
    const double peak = saddle_of(g, t).m;
    double sum = 0;
    for (std::int64_t i = 1;; ++i) {
        const auto m = static_cast<double>(i);
        const double term = std::exp(log_term(g, t, m));
        sum += term;
        if (m > peak && !(term > 1e-17 * sum)) return sum;
    }
}

template <class Number>
Number phi_series_windowed(Number g, Number t) {
    const Window range = window(static_cast<double>(g), static_cast<double>(t));
    Number sum = 0;
    for (std::int64_t m = range.first; m <= range.last; ++m) {
        sum += std::exp(log_term(g, t, static_cast<Number>(m)));
    }
    return sum;
}

double phi_series_ratios(double g, double t) {
    const Window range = window(g, t);
    const auto middle = static_cast<std::int64_t>(std::fmax(1, std::round(saddle_of(g, t).m)));
    const auto centre = static_cast<double>(middle);
    double sum = 1;
    double term = 1;
    for (std::int64_t i = middle; i < range.last; ++i) {
        const auto m = static_cast<double>(i);
        term *= g * m / ((m + 1) * (m + 1)) * std::exp(t / (m * (m + 1)));
        sum += term;
    }
    term = 1;
    for (std::int64_t i = middle; i > range.first; --i) {
        const auto m = static_cast<double>(i);
        term *= m * m / (g * (m - 1)) * std::exp(-t / (m * (m - 1)));
        sum += term;
    }
    if (centre < 30) return sum * std::exp(log_term(g, t, centre));
    // ln of the largest term: g (d - (1 + d) ln(1 + d)) - t/m + Stirling's remainder, m = g (1 + d)
    const double excess = (centre - g) / g;
    const double inverse = 1 / centre;
    const double remainder =
        inverse / 12 - inverse * inverse * inverse / 360 * (1 - 2 * inverse * inverse / 7);
    const double log_largest = (centre - g) - centre * std::log1p(excess) - t / centre - remainder;
    return sum * std::exp(log_largest) / (centre * std::sqrt(6.283185307179586 * centre));
}

double windowed_terms(double g, double t) {
    const Window range = window(g, t);
    return static_cast<double>(range.last - range.first + 1);
}

double phi_rough_limit(double g, double t) {
    return std::exp(-t / g) / g;
}

template <class Number>
SaddleCorrections<Number> saddle_corrections(Number w) {
    const Exponent<Number> h = exponent_series(w);
    const Number first = first_order(h, Number(-1.5)) - 1 / Number(12);
    const Number second = second_order(h, Number(-1.5)) - first_order(h, Number(-2.5)) / 12 + 1 / Number(288);
    return {first, second};
}

template <class Number>
Number phi_saddle(Number g, Number t, int order) {
    const auto w = static_cast<Number>(
        lambert_w0_of_square(std::sqrt(2 * static_cast<double>(t)) / static_cast<double>(g)) / 2);
    const Number m = w < 1 ? g * std::exp(w) : std::sqrt(t / w);
    const Number exponent = w < 1 ? g * (std::expm1(w) - 2 * w * std::exp(w)) : m * (1 - 2 * w) - g;
    const auto corrections = saddle_corrections(w);
    Number series = 1;
    if (order >= 1) series += corrections.first / m;
    if (order >= 2) series += corrections.second / (m * m);
    return std::exp(exponent) / (m * std::sqrt(1 + 2 * w)) * series;
}

template double phi_series_fixed(double, double, int);
template float phi_series_fixed(float, float, int);
template double phi_series_adaptive(double, double);
template float phi_series_adaptive(float, float);
template double phi_series_windowed(double, double);
template float phi_series_windowed(float, float);
template double phi_saddle(double, double, int);
template float phi_saddle(float, float, int);
template SaddleCorrections<double> saddle_corrections(double);
template SaddleCorrections<float> saddle_corrections(float);

const std::vector<PhiMethodEntry>& phi_methods() {
    static const std::vector<PhiMethodEntry> list = [] {
        std::vector<PhiMethodEntry> methods;
        add_series(methods);
        add_approximations(methods);
        add_single_precision(methods);
        add_ours(methods);
        return methods;
    }();
    return list;
}

}  // namespace hts::bench
