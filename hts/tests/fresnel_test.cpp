#include "hts/fresnel.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"

using hts::fresnel;
using hts::RefractiveIndex;
using hts::testing::ReferenceTable;
using hts::testing::WorstCase;
using Complex = std::complex<double>;

TEST_CASE("Fresnel amplitudes agree with 50 digits") {
    const ReferenceTable table{"tests/reference/fresnel.csv"};
    WorstCase absolute{"Fresnel amplitude, absolute", hts::accuracy::fresnel};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto computed = fresnel(table(row, "cos_theta"), {table(row, "n"), table(row, "k")});
        const auto where = [&] { return table.describe(row, {"cos_theta", "n", "k"}); };
        absolute.note(std::abs(computed.s - Complex{table(row, "Fs_re"), table(row, "Fs_im")}), where);
        absolute.note(std::abs(computed.p - Complex{table(row, "Fp_re"), table(row, "Fp_im")}), where);
    }
    absolute.check();
}

TEST_CASE("derivatives of Fresnel amplitudes agree with differences at 80 digits") {
    const ReferenceTable table{"tests/reference/fresnel_gradient.csv"};
    WorstCase worst{"derivatives of Fresnel amplitudes", hts::accuracy::fresnel_gradient};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double c = table(row, "cos_theta"), n = table(row, "n"), k = table(row, "k");
        const auto computed = hts::fresnel_gradient(c, {n, k});
        const double r = std::abs(std::sqrt(Complex{(n - 1) * (n + 1) - k * k + c * c, 2 * n * k}));
        const auto note = [&](Complex value, const std::string& re, const std::string& im) {
            const Complex expected{table(row, re), table(row, im)};
            worst.note(std::abs(value - expected) / (1 + std::abs(expected)) * std::fmin(1, r * r), [&] {
                return re + ", " + table.describe(row, {"cos_theta", "n", "k"});
            });
        };
        note(computed.by_cos_theta.s, "Fs_re_by_cos", "Fs_im_by_cos");
        note(computed.by_cos_theta.p, "Fp_re_by_cos", "Fp_im_by_cos");
        note(computed.by_n.s, "Fs_re_by_n", "Fs_im_by_n");
        note(computed.by_n.p, "Fp_re_by_n", "Fp_im_by_n");
        note(computed.sum_over_sine_squared, "sum_re", "sum_im");
    }
    worst.check();
}

TEST_CASE("derivatives of Fresnel amplitudes: normal incidence, grazing, the critical angle") {
    const RefractiveIndex glass{1.5, 0};
    const auto normal = hts::fresnel_gradient(1, glass);
    CHECK(normal.unpolarised_reflectance(normal.by_n) ==
          Approx(4 * 0.5 / std::pow(2.5, 3)));  // ((n-1)/(n+1))^2
    CHECK(normal.unpolarised_reflectance(normal.by_k()) == 0);
    const auto grazing = hts::fresnel_gradient(0, glass);
    CHECK(grazing.by_n.s == 0.0);
    CHECK(grazing.by_cos_theta.s.real() == Approx(2 / std::sqrt(1.25)));
    const auto critical = hts::fresnel_gradient(0.6, {0.8, 0});
    CHECK(std::isfinite(critical.unpolarised_reflectance(critical.by_n)));
    const auto nothing = hts::fresnel_gradient(0.3, {1, 0});
    CHECK(nothing.unpolarised_reflectance(nothing.by_n) == 0);
    CHECK(nothing.by_n.s.real() == Approx(-1 / (2 * 0.09)));
    for (const double c : {0.0, 1e-300, 1e-100})
        CHECK(std::isfinite(hts::fresnel_gradient(c, {1, 0}).by_n.s.real()));
}

TEST_CASE("Fresnel amplitudes do not cancel as the index nears 1") {
    const double gap = 0x1p-40;
    const auto f = fresnel(0.5, {1 + gap, 0});
    // F_s -> -(n - 1)/(2 c^2), F_p -> (n - 1)(2 c^2 - 1)/(2 c^2)
    CHECK(f.s.real() == Approx(-gap / 0.5).epsilon(1e-11));
    CHECK(f.p.real() == Approx(-gap).epsilon(1e-11));
    CHECK(std::abs(fresnel(0.3, {1, 0}).s) == 0);
    CHECK(std::abs(fresnel(0, {1, 0}).p) == 0);
}

TEST_CASE("Fresnel amplitudes at the critical angle lose no more than the inputs' last bits") {
    // |F| = 1 beyond it; at r = 0 the error is that of r, the square root of the last bit
    for (const double n : {0.051318396927193796, 0.5759, 0.9}) {
        const double critical = std::sqrt((1 - n) * (1 + n));
        for (const double offset : {0.0, 1e-14, 1e-10, 1e-4}) {
            const auto f = fresnel(critical * (1 - offset), {n, 0});
            const double root = std::sqrt(std::fmax(2 * offset * critical * critical, 1e-16));
            CHECK(std::abs(f.s) == Approx(1).margin(hts::accuracy::fresnel / root));
            CHECK(std::abs(f.p) == Approx(1).margin(hts::accuracy::fresnel / root));
        }
    }
}

TEST_CASE("Fresnel limits: normal, grazing, Brewster, total and perfect reflection") {
    const auto normal = fresnel(1, {1.5, 0.3});
    CHECK(std::abs(normal.s + normal.p) < 1e-16);
    CHECK(fresnel(1, {1.5, 0}).unpolarised_reflectance() == Approx(0.04).epsilon(1e-15));
    const auto grazing = fresnel(0, {1.5, 0.3});
    CHECK(grazing.s == Complex{-1.0});
    CHECK(grazing.p == Complex{-1.0});
    CHECK(std::abs(fresnel(1 / std::sqrt(1 + 1.5 * 1.5), {1.5, 0}).p) < 1e-15);
    CHECK(std::abs(fresnel(0.1, {0.5, 0}).s) == Approx(1).epsilon(1e-15));
    const auto conductor = fresnel(0.4, {1e12, 1e12});
    CHECK(std::abs(conductor.s + 1.0) < 1e-12);
    CHECK(std::abs(conductor.p - 1.0) < 1e-11);
}

TEST_CASE("indices that cannot be are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(RefractiveIndex(0, 1), "refractive index n 0: must be > 0 and at most 1e+24");
    CHECK_THROWS_WITH(RefractiveIndex(1.5, -0.1),
                      "extinction coefficient k -0.1: must be >= 0 and at most 1e+24");
    CHECK_THROWS_AS(RefractiveIndex(nan, 0), hts::Error);
    CHECK_THROWS_AS(RefractiveIndex(1, std::numeric_limits<double>::infinity()), hts::Error);
}
