// Rows 1 to 3: the sum for Phi and its limits.

#include <chrono>
#include <cmath>

#include "bench/phi/phi_methods.hpp"
#include "bench/stability/stability_model.hpp"
#include "bench/stability/stability_rows.hpp"

namespace hts::bench {
namespace {

struct Point {
    double g, t;
};

std::string at(const Point& p) {
    return place({{"g", p.g}, {"t/g", p.t / p.g}});
}

std::vector<Point> grid(const std::vector<double>& g, const std::vector<double>& ratios) {
    std::vector<Point> points;
    for (const double variance : g) {
        for (const double ratio : ratios) points.push_back({variance, ratio * variance});
    }
    return points;
}

/// Seconds of one call, the mean of enough of them.
double seconds(const PhiMethodEntry& method, const Point& p) {
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    int calls = 0;
    double sum = 0;
    std::chrono::duration<double> spent{0};
    do {
        sum += method.value(p.g, p.t);
        ++calls;
        spent = clock::now() - start;
    } while (spent.count() < 1e-3 && calls < 100000);
    const volatile double kept = sum;  // else the calls could be left out
    static_cast<void>(kept);
    return spent.count() / calls;
}

std::string duration(double seconds) {
    if (seconds < 1e-6) return brief(seconds * 1e9) + " ns";
    if (seconds < 1e-3) return brief(seconds * 1e6) + " us";
    return brief(seconds * 1e3) + " ms";
}

/// How many terms a sum needs, 0 for what is no sum.
double terms(const PhiMethodEntry& method, const Point& p) {
    if (method.name == "series, from m = 1") return p.g + windowed_terms(p.g, p.t) / 2;
    return method.name == "series, windowed" ? windowed_terms(p.g, p.t) : 0;
}

struct Entrant {
    std::string name, why;
    double most_g = INFINITY;  ///< beyond, a call takes too long to be tried
    std::string label = {};    ///< sets results of one grid apart from those of another
};

/// Every method of these names at every point, ours with each tolerance.
void race(StabilityRow& row, const std::vector<Point>& points, const std::vector<Entrant>& entrants,
          bool timed) {
    for (const Point& p : points) {
        const double expected = reference_phi(p.g, p.t);
        for (const PhiMethodEntry& method : phi_methods()) {
            for (const Entrant& entrant : entrants) {
                if (method.name != entrant.name || p.g > entrant.most_g) continue;
                const double count = terms(method, p);
                const std::string unit =
                    timed ? (count > 0 ? "terms, " : "") + duration(seconds(method, p)) : "";
                row.compare({method.title() + entrant.label, method.ours, method.error, entrant.why},
                            method.value(p.g, p.t), expected, at(p),
                            {timed ? count : 0, limit_of_terms, unit});
            }
        }
    }
}

constexpr const char* series_answer =
    "The engine never forms g^m, m! or exp(-g): it works relative to the largest term, whose logarithm does "
    "not cancel.";

}  // namespace

StabilityRow series_in_floating_point() {
    StabilityRow row{1, "the series in floating point"};
    const auto points = grid({0.5, 5, 25, 40, 60, 170, 300, 700, 760, 1e4}, {0, 1, 5});
    race(row, points,
         {{"hts::phi", series_answer},
          {"series, fixed",
           "g^m passes 1e308 and m! overflows at 171, which gives infinity/infinity; exp(-g) is 0 past "
           "g = 745; and terms beyond the count, where the sum lives once g exceeds it, are missing."},
          {"series, adaptive",
           "It starts from exp(-g) exp(-t), which underflows, and so ends at its first term."}},
         false);
    return row;
}

StabilityRow series_at_large_g() {
    StabilityRow row{2, "the series from g = 1e3 to 1e10"};
    race(row, grid({1e3, 1e4, 1e6, 1e8, 1e10}, {0, 1, 30}),
         {{"hts::phi",
           "The engine's cost does not grow with g: beyond the small values it strides over the terms or "
           "reads a correction to the saddle point."},
          {"series, from m = 1", "It adds up g terms, nearly all of them negligible.", 1e6},
          {"series, windowed",
           "About 17 sqrt(g) terms count, so the cost grows without bound; by logarithms it also "
           "loses digits, since m ln g and ln m! cancel."},
          {"spline of 1992", "A table ends where its grid ends."}},
         true);
    return row;
}

StabilityRow rough_limit_in_the_tail() {
    StabilityRow row{3, "the rough limit exp(-t/g)/g in the tail and at small g"};
    const Entrant ours{
        "hts::phi",
        "The engine keeps the saddle point's own exponent, uniform in t/g, and sums where g is small."};
    race(row, grid({0.1, 1, 5, 20, 60}, {0, 1, 10, 100, 400}),
         {ours,
          {"rough limit", "It is the first term in 1/g, of no use where g is not large.", INFINITY,
           ", small g"},
          {"saddle point", "An expansion in 1/m*, m* >= g: it fails where few terms count.", INFINITY,
           ", small g"}},
         false);
    race(
        row, grid({200, 1000, 1e5}, {10, 30, 100, 400}),
        {ours,
         {"rough limit",
          "Its relative error grows as (t/g)^2/2g: the far tail is wrong by orders of magnitude.", INFINITY,
          ", tail"},
         {"saddle point", "It is uniform in t/g, which is why the engine builds on it.", INFINITY, ", tail"}},
        false);
    return row;
}

}  // namespace hts::bench
