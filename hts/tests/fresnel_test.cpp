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
    const ReferenceTable table{"fresnel.csv"};
    WorstCase absolute{"Fresnel amplitude, absolute", hts::accuracy::fresnel};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto computed = fresnel(table(row, "cos_theta"), {table(row, "n"), table(row, "k")});
        const auto where = [&] { return table.describe(row, {"cos_theta", "n", "k"}); };
        absolute.note(std::abs(computed.s - Complex{table(row, "Fs_re"), table(row, "Fs_im")}), where);
        absolute.note(std::abs(computed.p - Complex{table(row, "Fp_re"), table(row, "Fp_im")}), where);
    }
    absolute.check();
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
