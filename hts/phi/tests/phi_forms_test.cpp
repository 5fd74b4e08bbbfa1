// The tables of phi at every tolerance and on every instruction set, against long sums.
#include <array>
#include <bit>
#include <cmath>
#include <iostream>
#include <limits>
#include <span>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/phi/phi_simd.hpp"
#include "hts/phi/tables/phi_series.hpp"
#include "hts/phi/tables/phi_table.hpp"
#include "targets.hpp"

using hts::phi;
using hts::PhiMethod;
using hts::Tolerance;
using hts::phi_detail::phi_forms;
using hts::phi_detail::PhiForms;
using hts::testing::on_every_target;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr std::array tolerances{Tolerance{1e-3}, Tolerance{1e-6}, Tolerance{1e-12}};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double representable_log = -644;  // 1e-280

std::string at(double g, double t) {
    return "g = " + hts::shortest(g) + ", t = " + hts::shortest(t) + ", t/g = " + hts::shortest(t / g);
}

struct Point {
    double g, t;
};

double beside(double v, bool above) {
    return std::nextafter(v, above ? infinity : 0);
}

double power_of_2_near(double v) {
    return std::exp2(std::round(std::log2(v)));
}

/// Anywhere, mostly beyond the tables.
Point draw_far(Random& random) {
    return {random.logarithmic(1e-12, 1e6), random.logarithmic(1e-3, 1e9)};
}

/// Log-uniform in g over [1e-12, 1e12] or where the tables have their octaves; t/g in [0, 700] uniform,
/// log-uniform or at its ends; one point in ten beside an octave's edge in g, one in ten beside one in 1 + t.
Point draw(Random& random) {
    const auto one_in = [&](double n) { return random.uniform(0, n) < 1; };
    double g = one_in(2) ? random.logarithmic(1e-12, 1e12) : random.logarithmic(0x1p-9, 0x1p8);
    if (one_in(10)) g = beside(power_of_2_near(g), one_in(2));
    double ratio = one_in(3) ? random.logarithmic(1e-8, 700) : random.uniform(0, 700);
    if (one_in(10)) ratio = one_in(2) ? 700 : 0;
    double t = ratio * g;
    if (one_in(10)) t = std::fmax(0, beside(power_of_2_near(1 + t), one_in(2)) - 1);
    return {g, std::fmin(t, 700 * g)};
}

constexpr std::array<double, 6> regime_ends{1.0 / 32, 1, 8, 64, 1e4, infinity};
constexpr std::array<const char*, 6> regime_names{"g < 1/32",    "1/32 <= g < 1", "1 <= g < 8",
                                                  "8 <= g < 64", "64 <= g < 1e4", "1e4 <= g"};

std::size_t regime(double g) {
    std::size_t i = 0;
    while (g >= regime_ends[i]) ++i;
    return i;
}

/// The worst error and where it was, by regime, of one tolerance.
struct Worst {
    std::array<double, 6> error{};
    std::array<Point, 6> where{};

    void note(double e, const Point& p) {
        const std::size_t i = regime(p.g);
        if (e <= error[i]) return;
        error[i] = e;
        where[i] = p;
    }
    void merge(const Worst& other) {
        for (std::size_t i = 0; i < error.size(); ++i) {
            if (!(other.error[i] <= error[i])) {
                error[i] = other.error[i];
                where[i] = other.where[i];
            }
        }
    }
};

using Worsts = std::array<Worst, 3>;

/// One block of points, with its own seed so that threads do not matter.
Worsts errors_of_block(const PhiForms& forms, Point (*draw_point)(Random&), std::uint64_t seed, int points) {
    Random random{seed};
    Worsts worsts;
    for (int i = 0; i < points; ++i) {
        const Point p = draw_point(random);
        const long double expected = hts::phi_detail::series_sums<long double>(static_cast<long double>(p.g),
                                                                               static_cast<long double>(p.t))
                                         .log_phi();
        if (expected < representable_log) continue;
        for (std::size_t form = 0; form < worsts.size(); ++form) {
            const long double computed = std::log(static_cast<long double>(forms.one[form](p.g, p.t)));
            const long double error = std::abs(std::expm1(computed - expected));
            worsts[form].note(std::isnan(error) ? infinity : static_cast<double>(error), p);
        }
    }
    return worsts;
}

Worsts sweep(const PhiForms& forms, Point (*draw_point)(Random&), int blocks, int points_per_block) {
    Worsts total;
#pragma omp parallel for schedule(dynamic)
    for (int block = 0; block < blocks; ++block) {
        const Worsts worsts =
            errors_of_block(forms, draw_point, 1000U + static_cast<unsigned>(block), points_per_block);
#pragma omp critical
        for (std::size_t form = 0; form < total.size(); ++form) total[form].merge(worsts[form]);
    }
    return total;
}

void check(const Worsts& worsts, const std::string& where) {
    for (std::size_t form = 0; form < worsts.size(); ++form) {
        const double bound = tolerances[form].relative_error();
        for (std::size_t i = 0; i < regime_names.size(); ++i) {
            const Point p = worsts[form].where[i];
            std::cout << "phi at " << bound << ", " << where << ", " << regime_names[i] << ": worst "
                      << worsts[form].error[i] << " at " << at(p.g, p.t) << '\n';
            CHECK(worsts[form].error[i] <= bound);
        }
    }
}

/// Ordinary points, points beyond the tables, and every kind of edge.
std::vector<Point> mixed_points(Random& random, std::size_t count) {
    const std::vector<double> edges{0, infinity, std::numeric_limits<double>::quiet_NaN(), -1, 1e-310, 1e308};
    std::vector<Point> points(count);
    for (Point& p : points) {
        p.g = random.logarithmic(1e-15, 1e15);
        p.t = p.g * random.logarithmic(1e-3, 1e4);
        if (random.uniform(0, 1) < 0.02) p.g = random.one_of(edges);
        if (random.uniform(0, 1) < 0.02) p.t = random.one_of(edges);
    }
    return points;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

}  // namespace

TEST_CASE("phi at every tolerance agrees with 50 digits") {
    const ReferenceTable table{"tests/reference/phi.csv"};
    for (const Tolerance tolerance : tolerances) {
        WorstCase worst{"phi at " + hts::shortest(tolerance.relative_error()), tolerance.relative_error()};
        for (std::size_t row = 0; row < table.size(); ++row) {
            if (table(row, "log_phi") < representable_log) continue;
            worst.note(relative_error(phi(table(row, "g"), table(row, "t"), tolerance), table(row, "phi")),
                       [&] {
                           return table.describe(row, {"g", "t"});
                       });
        }
        worst.check();
    }
}

TEST_CASE("phi at every tolerance agrees with long sums over the plane") {
    const bool all = hts::testing::exhaustive();
    check(sweep(phi_forms(), draw, all ? 10000 : 100, 1000), "this processor");
}

TEST_CASE("phi agrees with long sums beyond its tables") {
    check(sweep(phi_forms(), draw_far, hts::testing::exhaustive() ? 1000 : 50, 1000), "beyond the tables");
}

TEST_CASE("phi keeps its tolerances on every instruction set") {
    on_every_target([](const std::string& target) {
        const PhiForms forms = phi_forms();
        check(sweep(forms, draw, 10, 1000), target);
    });
}

TEST_CASE("the gradient of phi keeps its tolerance on every instruction set") {
    on_every_target([](const std::string& target) {
        const PhiForms forms = phi_forms();
        Random random{18};
        WorstCase worst{"log-gradient of phi, " + target, hts::accuracy::tabled_phi_gradient};
        for (int i = 0; i < 20000; ++i) {
            const Point p = draw(random);
            if (p.g > 1e8) continue;  // where the sums of g d ln Phi/dg lose 1e-16 sqrt(g)
            const auto tabled = forms.gradient(p.g, p.t), summed = hts::phi_gradient(p.g, p.t);
            const auto note = [&](double computed, double expected) {
                worst.note(std::abs(computed - expected) / (1 + std::abs(expected)),
                           [&] { return at(p.g, p.t); });
            };
            note(p.g * tabled.log_d_g, p.g * summed.log_d_g);
            note(tabled.log_d_t / summed.log_d_t, 1);
        }
        worst.check();
    });
}

TEST_CASE("phi is continuous across cells") {
    // one ulp changes Phi itself by 1e-13 at most, so any jump is the tables'
    for (const Tolerance tolerance : tolerances) {
        Random random{17};
        WorstCase worst{"jump of phi at " + hts::shortest(tolerance.relative_error()),
                        tolerance.relative_error()};
        for (int i = 0; i < 20000; ++i) {
            const double sixteenth = std::floor(random.uniform(16, 32)) / 16;
            const double edge = sixteenth * std::exp2(std::floor(random.uniform(-9, 14)));
            const bool in_g = i % 2 == 0;
            const double g = in_g ? edge : random.logarithmic(0x1p-9, 0x1p8);
            const double t = in_g ? g * random.uniform(0, 600) : std::fmin(edge, 700 * g);
            const double below =
                in_g ? phi(beside(g, false), t, tolerance) : phi(g, beside(1 + t, false) - 1, tolerance);
            const double above = in_g ? phi(g, t, tolerance) : phi(g, beside(1 + t, true) - 1, tolerance);
            if (above > 1e-280) worst.note(relative_error(below, above), [&] { return at(g, t); });
        }
        worst.check();
    }
}

TEST_CASE("a batch of phi has the bits of single calls at every place") {
    on_every_target([](const std::string& target) {
        const PhiForms forms = phi_forms();
        INFO(target);
        Random random{5};
        int different = 0;
        for (std::size_t count = 1; count < 200; ++count) {
            const std::vector<Point> points = mixed_points(random, count);
            std::vector<double> g(count), t(count), result(count);
            for (std::size_t i = 0; i < count; ++i) {
                g[i] = points[i].g;
                t[i] = points[i].t;
            }
            for (std::size_t form = 0; form < tolerances.size(); ++form) {
                forms.many[form](g.data(), t.data(), result.data(), count);
                for (std::size_t i = 0; i < count; ++i) {
                    const double single = forms.one[form](g[i], t[i]);
                    different += same_bits(result[i], single) ? 0 : 1;
                    different += std::isnan(single) == (g[i] >= 0 && t[i] >= 0) ? 1 : 0;
                }
            }
        }
        CHECK(different == 0);
    });
}

TEST_CASE("a span of phi has the bits of single calls, in place too") {
    std::vector<double> g, t;
    Random random{6};
    for (int i = 0; i < 1001; ++i) {
        g.push_back(random.logarithmic(1e-6, 1e6));
        t.push_back(g.back() * random.uniform(0, 50));
    }
    for (const Tolerance tolerance : tolerances) {
        std::vector<double> in_place = g;
        phi(in_place, t, in_place, tolerance);
        for (std::size_t i = 0; i < g.size(); ++i) CHECK(same_bits(in_place[i], phi(g[i], t[i], tolerance)));
    }
}

TEST_CASE("phi with its logarithm has the value of the finest tolerance") {
    Random random{7};
    for (int i = 0; i < 1000; ++i) {
        const Point p = draw(random);
        const hts::Phi both = phi(p.g, p.t);
        if (both.value < 1e-280) continue;
        CHECK(both.method == PhiMethod::table);
        CHECK(both.value == phi(p.g, p.t, Tolerance{1e-12}));
    }
}

TEST_CASE("a tolerance takes the cheapest form that meets it") {
    CHECK(hts::phi_table_bytes(Tolerance{1}) == hts::phi_table_bytes(Tolerance{1e-3}));
    CHECK(hts::phi_table_bytes(Tolerance{0.9e-3}) == hts::phi_table_bytes(Tolerance{1e-6}));
    CHECK(hts::phi_table_bytes(Tolerance{0.9e-6}) == hts::phi_table_bytes(Tolerance{1e-12}));
    CHECK(hts::phi_table_bytes(Tolerance{1e-3}) < hts::phi_table_bytes(Tolerance{1e-6}));
    CHECK(hts::phi_table_bytes(Tolerance{1e-6}) < hts::phi_table_bytes(Tolerance{1e-12}));
}

TEST_CASE("phi is total at every tolerance") {
    for (const Tolerance tolerance : tolerances) {
        for (const double g : {0.0, 5e-324, 1e-300, 1e-10, 1.0, 50.0, 1e10, 1e300, infinity}) {
            for (const double t : {0.0, 5e-324, 1e-300, 1.0, 1e5, 1e10, 1e300, infinity}) {
                INFO(at(g, t));
                CHECK(phi(g, t, tolerance) >= 0);
                CHECK(phi(g, t, tolerance) < 0.52);
            }
        }
        CHECK(std::isnan(phi(-1, 1, tolerance)));
        CHECK(std::isnan(phi(1, -1, tolerance)));
    }
}
