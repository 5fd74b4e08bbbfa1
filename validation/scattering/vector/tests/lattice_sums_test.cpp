#include "validation/scattering/vector/lattice_sums.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi;

/// u_a u_b Q^(-3/2) exp(-Q) summed over a lattice of step h, the origin left out.
LatticeSums punctured(double slope_x, double slope_y, double h) {
    LatticeSums sums{0, 0, 0};
    const int reach = static_cast<int>(7 / h);
    for (int m = -reach; m <= reach; ++m) {
        for (int n = -reach; n <= reach; ++n) {
            if (m == 0 && n == 0) continue;
            const double x = m * h, y = n * h, along = slope_x * x + slope_y * y;
            const double q = x * x + y * y + along * along;
            const double weight = h * h * std::exp(-q) / (q * std::sqrt(q));
            sums.xx += weight * x * x;
            sums.xy += weight * x * y;
            sums.yy += weight * y * y;
        }
    }
    return sums;
}

}  // namespace

TEST_CASE("lattice sums: a level plane's are Epstein's zeta function") {
    // 2 zeta(1/2) beta(1/2), by mpmath
    const LatticeSums sums = lattice_sums(0, 0);
    CHECK(sums.xx == Approx(-1.9501324600009779).epsilon(1e-11));
    CHECK(sums.yy == Approx(sums.xx).epsilon(1e-14));
    CHECK(std::fabs(sums.xy) < 1e-14);
}

TEST_CASE("lattice sums: they complete the punctured rule to the third order") {
    for (const auto& [sx, sy] : {std::pair{0.0, 0.0}, {0.7, -0.4}, {-1.5, 1.2}, {3.0, 0.0}}) {
        const LatticeSums sums = lattice_sums(sx, sy);
        // integral u_a u_b Q^(-3/2) exp(-Q) = pi^(3/2)/2 (Q^-1)_ab/sqrt(det Q)
        const double det = 1 + sx * sx + sy * sy, scale = std::pow(pi, 1.5) / 2 / (det * std::sqrt(det));
        const LatticeSums exact{scale * (1 + sy * sy), -scale * sx * sy, scale * (1 + sx * sx)};
        double before = 0;
        for (const double h : {0.2, 0.1}) {
            const LatticeSums sum = punctured(sx, sy, h);
            const double off = std::hypot(sum.xx - h * sums.xx - exact.xx, sum.xy - h * sums.xy - exact.xy,
                                          sum.yy - h * sums.yy - exact.yy);
            std::printf("slopes %g %g, step %g: error %.2e\n", sx, sy, h, off);
            CHECK(off < 0.5 * h * h * h);
            if (before > 0) CHECK(off < before / 7);
            before = off;
        }
    }
}
