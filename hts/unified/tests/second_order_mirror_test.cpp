#include "hts/unified/second_order_mirror.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/unified/unified_mirror.hpp"

using hts::Direction;
using hts::RefractiveIndex;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double tau = 2 * std::numbers::pi;  // k tau of tau = lambda

/// -2 R2/F: the exponents over (k sigma_0)^2.
std::array<double, 2> exponents(double degrees, const RefractiveIndex& index, double k_tau = tau) {
    const double c = Direction::from_degrees(degrees, 0).cos_theta();
    const auto r2 = hts::second_order(c, k_tau, index);
    const auto flat = hts::fresnel(c, index);
    return {-2 * (r2.s / flat.s).real(), -2 * (r2.p / flat.p).real()};
}

/// The same of the closed form, at a correlation length of so many wavelengths.
std::array<double, 2> closed_exponents(double degrees, const RefractiveIndex& index, double wavelengths) {
    const Direction in = Direction::from_degrees(degrees, 0);
    const hts::UnifiedWave wave{hts::Surface{0.1 / tau, wavelengths}, hts::ReturnFactor{0.02},
                                hts::Wavelength::from_micrometres(1), index};
    const auto rough = unified_mirror(in, wave), flat = hts::fresnel(in.cos_theta(), index);
    const auto exponent = [](const std::complex<double>& a, const std::complex<double>& b) {
        return std::log(std::norm(b) / std::norm(a)) / 0.01;
    };
    return {exponent(rough.s, flat.s), exponent(rough.p, flat.p)};
}

}  // namespace

TEST_CASE("a very good conductor loses from the mirror what it scatters") {
    // the optical theorem: another formula, for a perfect conductor, against the reduced Rayleigh equations
    WorstCase worst{"second order of a good conductor from the scattered power", 4e-3};
    for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 88.0}) {
        for (const double k_tau : {2.0, tau, 30.0}) {
            const auto good = exponents(degrees, {1e4, 3e5}, k_tau),
                       perfect = exponents(degrees, {1e9, 1e9}, k_tau);
            for (std::size_t i = 0; i < 2; ++i)
                worst.note(relative_error(good[i], perfect[i]), [&] { return std::to_string(degrees); });
        }
    }
    worst.check();
    CHECK(exponents(75, {1e9, 1e9})[1] == Approx(0.84).margin(0.005));
    CHECK(exponents(85, {1e9, 1e9})[1] == Approx(1.83).margin(0.005));
    CHECK(exponents(88, {1e9, 1e9})[1] == Approx(4.42).margin(0.005));
}

TEST_CASE("second order has the limits it must have") {
    for (const RefractiveIndex index : {RefractiveIndex{1.5, 0}, RefractiveIndex{0.77, 6.08}}) {
        // along the normal s and p are the same, and a gentle surface loses g
        const auto normal = exponents(0, index);
        CHECK(normal[0] == Approx(normal[1]).epsilon(1e-8));
        for (const double degrees : {0.0, 20.0, 40.0}) {
            const double g = 4 * std::pow(Direction::from_degrees(degrees, 0).cos_theta(), 2);
            const auto gentle = exponents(degrees, index, 600);
            CHECK(gentle[0] == Approx(g).epsilon(2e-3));
            CHECK(gentle[1] == Approx(g).epsilon(2e-3));
        }
        // the closed form is within 17 % of x_s for tau = lambda
        for (const double degrees : {0.0, 45.0, 75.0})
            CHECK(closed_exponents(degrees, index, 1)[0] ==
                  Approx(exponents(degrees, index)[0]).epsilon(0.17));
    }
    CHECK(hts::second_order(0.5, tau, {1, 0}).s == 0.0);
}

TEST_CASE("the closed exponents of the mirror are near second order where that is said") {
    WorstCase s{"closed x_s beside second order, to 88 deg", hts::accuracy::closed_exponent_s},
        p{"closed x_p, metals to 75 deg, dielectrics to 45", hts::accuracy::closed_exponent_p},
        noble{"closed x_p of Ag, Au, Cu and Al to 88 deg", 0.61};
    const std::vector<RefractiveIndex> indices{{0.06, 4},  {0.25, 2.9}, {0.62, 2.6}, {0.77, 6.08},
                                               {1.2, 6.5}, {1.98, 3.7}, {3.2, 3.3},  {1.33, 0},
                                               {1.5, 0},   {2.5, 0},    {4, 0}};
    for (std::size_t i = 0; i < indices.size(); ++i) {
        for (const double wavelengths : {1.0, 2.0, 4.0, 8.0}) {
            for (const double degrees : {0.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0, 88.0}) {
                const auto closed = closed_exponents(degrees, indices[i], wavelengths);
                const auto exact = exponents(degrees, indices[i], wavelengths * tau);
                const auto where = [&] {
                    return std::to_string(indices[i].n()) + " + " + std::to_string(indices[i].k()) +
                           "i, tau " + std::to_string(wavelengths) + ", " + std::to_string(degrees) + " deg";
                };
                s.note(relative_error(closed[0], exact[0]), where);
                const double of_p = relative_error(closed[1], exact[1]);
                if (degrees <= (indices[i].k() > 0 ? 75 : 45)) p.note(of_p, where);
                if (i < 5) noble.note(of_p, where);
            }
        }
    }
    s.check();
    p.check();
    noble.check();
}

TEST_CASE("the table of the second order follows the integral") {
    WorstCase worst{"second order, from the table", hts::accuracy::second_order_mirror};
    for (const RefractiveIndex index :
         {RefractiveIndex{1.5, 0}, RefractiveIndex{0.16, 3.6}, RefractiveIndex{2.5, 0.1}}) {
        for (const double k_tau : {2.0, tau, 40.0}) {
            constexpr double k_sigma = 0.01;
            const hts::SecondOrderMirror mirror{k_sigma, k_tau, index};
            for (double degrees = 0.7; degrees < 89.9; degrees += 7.3) {
                const Direction in = Direction::from_degrees(degrees, 0);
                const double c = in.cos_theta();
                const auto r2 = hts::second_order(c, k_tau, index), flat = hts::fresnel(c, index);
                const auto found = mirror(in);
                const double g = 4 * k_sigma * k_sigma * c * c;
                const auto s = flat.s * std::exp(k_sigma * k_sigma * r2.s / flat.s);
                worst.note(std::abs(found.s - s) / (k_sigma * k_sigma * 2 * c),
                           [&] { return std::to_string(degrees); });
                const auto p = flat.p + k_sigma * k_sigma * r2.p;  // to the fourth order
                worst.note(
                    std::max(0.0, std::abs(found.p - p) - 30 * g * g / std::max(1e-3, std::abs(flat.p))) /
                        (k_sigma * k_sigma * 2 * c),
                    [&] { return std::to_string(degrees); });
            }
        }
    }
    worst.check();
}

TEST_CASE("about Brewster's angle the second order leaves what the flat surface does not reflect") {
    const double brewster = std::atan(1.5);
    const Direction in = Direction::from_angles(brewster, 0);
    const hts::SecondOrderMirror mirror{0.6, tau, {1.5, 0}};
    const double left = std::norm(mirror(in).p);
    CHECK(left > 2e-5);
    CHECK(left < 1e-2);
    // never more than falls in, and continuous
    double before = std::norm(mirror(Direction::from_degrees(0, 0)).p);
    for (double degrees = 0; degrees <= 90; degrees += 0.25) {
        const auto f = mirror(Direction::from_degrees(degrees, 0));
        CHECK(std::norm(f.s) <= 1 + 1e-12);
        CHECK(std::norm(f.p) <= 1 + 1e-12);
        CHECK(std::abs(std::norm(f.p) - before) < 0.06);
        before = std::norm(f.p);
    }
}
