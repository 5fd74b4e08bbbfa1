#include "hts/unified/unified_terms.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/unified/he_unified_spectrum.hpp"
#include "hts/unified/unified_mirror.hpp"

using hts::Direction;
using hts::RefractiveIndex;
using hts::ReturnFactor;
using hts::Surface;
using hts::UnifiedView;
using hts::UnifiedWave;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;
const auto one_um = Wavelength::from_micrometres(1);

/// All that the model is, at one wavelength and a pair of directions.
struct Point {
    Surface surface;
    RefractiveIndex index;
    Direction in, out;
    Wavelength wavelength = one_um;

    [[nodiscard]] ReturnFactor m() const { return ReturnFactor{surface.slope_width() / 2}; }
    [[nodiscard]] UnifiedWave wave() const { return {surface, m(), wavelength, index}; }
    [[nodiscard]] hts::UnifiedLobe lobe(hts::DiffuseLobe of = hts::DiffuseLobe::full) const {
        return unified_lobe({surface, m(), in}, {surface, m(), out}, wave(), of);
    }
    [[nodiscard]] hts::UnifiedLobe turned() const {
        return Point{surface, index, out, in, wavelength}.lobe();
    }
};

std::string describe(const Point& p) {
    std::ostringstream text;
    text.precision(17);
    text << "sigma0 " << p.surface.rms_roughness() << ", tau " << p.surface.correlation_length() << ", N "
         << p.index.n() << " + " << p.index.k() << "i, cosines " << p.in.cos_theta() << ", "
         << p.out.cos_theta();
    return text.str();
}

Point random_point(Random& random) {
    const double sigma = random.logarithmic(0.003, 3);
    const Direction in = random.direction(1e-4);
    return {{sigma, sigma / random.logarithmic(0.01, 1)},
            {random.logarithmic(0.05, 5), random.one_of({0, 0.01, 1, 4})},
            in,
            random.direction(1e-4)};
}

}  // namespace

TEST_CASE("he_unified agrees with 50 digits") {
    const ReferenceTable table{"unified/tests/reference/unified.csv"};
    REQUIRE(table.size() == 300);
    WorstCase beta{"mean of 1/m, and 1 less it", hts::accuracy::kicks};
    WorstCase matrices{"Mueller matrix of the lobe beside element 00", hts::accuracy::unified_brdf};
    WorstCase mirror{"specular term of he_unified", hts::accuracy::unified_mirror};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto at = [&](const char* column) { return table(row, column); };
        const auto where = [&] {
            return table.describe(row, {"sigma", "tau", "theta_i", "theta_r", "azimuth", "n", "k"});
        };
        const Point p{{at("sigma"), at("tau")},
                      {at("n"), at("k")},
                      Direction::from_degrees(at("theta_i"), 0),
                      Direction::from_degrees(at("theta_r"), at("azimuth"))};
        const auto lobe = p.lobe();
        beta.note(relative_error(lobe.kicks.beta, at("beta")), where);
        beta.note(relative_error(lobe.kicks.rest, at("w")), where);
        const hts::Mueller m = unified_mueller(lobe.jones, 0);
        for (std::size_t i = 0; i < 16; ++i) {
            std::string column{"m"};
            column.append(std::to_string(i / 4)).append(std::to_string(i % 4));
            matrices.note(std::abs(m.elements()[i] - table(row, column)) / at("m00"), where);
        }
        matrices.note(relative_error(lobe.brdf(), at("m00")), where);
        const auto f = unified_mirror(p.in, p.wave());
        if (std::min(at("rs"), at("rp")) < 1e-280) continue;
        mirror.note(relative_error(std::norm(f.s), at("rs")), where);
        mirror.note(relative_error(std::norm(f.p), at("rp")), where);
        const auto product = f.s * std::conj(f.p);
        mirror.note(std::abs(product - std::complex<double>{at("rsp_re"), at("rsp_im")}) /
                        (std::sqrt(at("rs")) * std::sqrt(at("rp"))),
                    where);
    }
    beta.check();
    matrices.check();
    mirror.check();
}

TEST_CASE("he_unified has the values of the study it comes from") {
    const ReferenceTable table{"unified/tests/reference/study.csv"};
    REQUIRE(table.size() == 15);
    WorstCase elements{"elements of the lobe, the study's", 2e-4};
    WorstCase betas{"mean of 1/m, the study's, absolute", 5.1e-7};
    WorstCase reflectances{"flat reflectance, the study's, absolute", 5.1e-5};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Point p{{table(row, "sigma"), table(row, "tau")},
                      {table(row, "n"), table(row, "k")},
                      Direction::from_degrees(table(row, "theta_i"), 0),
                      Direction::from_degrees(table(row, "theta_r"), 180 + table(row, "phi"))};
        const auto lobe = p.lobe();
        // the study's values are with R in place of R'
        const double two = p.m()(p.in) * p.m()(p.out) - 1, flat = hts::flat_reflectance(p.index);
        const double factor =
            (1 + flat * lobe.kicks.rest * two) / (1 + p.wave().returned * lobe.kicks.rest * two);
        const auto note = [&](std::complex<double> element, const char* column) {
            const double found = factor * std::norm(element), expected = table(row, column);
            elements.note(expected == 0 ? found : relative_error(found, expected),
                          [&] { return describe(p); });
        };
        note(lobe.jones.ss, "ss");
        note(lobe.jones.sp, "sp");
        note(lobe.jones.ps, "ps");
        note(lobe.jones.pp, "pp");
        betas.note(std::abs(lobe.kicks.beta - table(row, "beta")), [&] { return describe(p); });
        reflectances.note(std::abs(flat - table(row, "reflectance")), [&] { return describe(p); });
    }
    elements.check();
    betas.check();
    reflectances.check();
}

TEST_CASE("he_unified is reciprocal") {
    WorstCase worst{"he_unified, both ways, beside the BRDF", 1e-12};
    Random random{1};
    for (int i = 0; i < 20000; ++i) {
        const Point p = random_point(random);
        const auto one = p.lobe(), other = p.turned();
        const double scale = std::sqrt(one.brdf());
        if (scale < 1e-100) continue;
        const auto note = [&](std::complex<double> a, std::complex<double> b) {
            worst.note(std::abs(a - b) / scale, [&] { return describe(p); });
        };
        note(one.jones.ss, other.jones.ss);
        note(one.jones.pp, other.jones.pp);
        // the frames of a ray turn round with it, so exchanging both rays changes the sign of one axis
        worst.note(std::abs(std::norm(one.jones.sp) - std::norm(other.jones.ps)) / (scale * scale),
                   [&] { return describe(p); });
    }
    worst.check();
}

TEST_CASE("Bragg's and Kirchhoff's matrices agree to second order about the mirror direction") {
    Random random{2};
    WorstCase worst{"|K - B|/|v_xy|^2 at 1e-4 and 1e-3 from the mirror", 0.02};
    for (int i = 0; i < 300; ++i) {
        const RefractiveIndex index{random.uniform(0.2, 4), random.one_of({0, 0.5, 6})};
        if (index.k() == 0 && index.n() < 1.2) continue;
        const Direction in = Direction::from_degrees(random.uniform(5, 60), random.uniform(0, 360));
        const double azimuth = random.uniform(0, 2 * pi);
        const auto difference = [&](double away) {
            const hts::Vector3 m = in.mirror().vector();
            const double x = m.x + away * std::cos(azimuth), y = m.y + away * std::sin(azimuth);
            const Direction out = Direction::from_unit_vector({x, y, std::sqrt(1 - x * x - y * y)});
            const auto change = wave_vector_change(in, out);
            const auto k = facet_jones(in, out, fresnel(change.cos_theta_d(), index));
            const auto b = bragg_jones(in, out, index, 0);
            const double a = change.squared() / 2, c = 2 * in.cos_theta() * out.cos_theta();
            return std::max({std::abs(a * k.ss - c * b.ss), std::abs(a * k.sp - c * b.sp),
                             std::abs(a * k.ps - c * b.ps), std::abs(a * k.pp - c * b.pp)}) /
                   (away * away);
        };
        worst.note(relative_error(difference(1e-3), difference(1e-4)), [&] {
            return "N " + std::to_string(index.n()) + " + " + std::to_string(index.k()) + "i, cos " +
                   std::to_string(in.cos_theta());
        });
    }
    worst.check();
}

TEST_CASE("Bragg's matrix of a perfect conductor keeps its digits at grazing angles") {
    // p in p, (cos phi - s_i s_r)/(c_i c_r), to 50 digits; angles above the horizon, and phi, in degrees
    using Real = boost::multiprecision::cpp_bin_float_50;
    const auto radians = [](double degrees) {
        return Real{degrees} * boost::math::constants::pi<Real>() / 180;
    };
    WorstCase worst{"pp of a perfect conductor, beside ss", 2e-13};
    for (double i = 8; i > 1e-5; i /= 2) {
        for (double o = 8; o > 1e-5; o /= 2) {
            for (double phi = 0; phi < 90; phi = phi == 0 ? 1e-5 : 2 * phi) {
                const Direction in = Direction::from_degrees(90 - i, phi),
                                out = Direction::from_degrees(90 - o, 0).mirror();
                const Real sines = cos(radians(i)) * cos(radians(o)),
                           cosines = sin(radians(i)) * sin(radians(o));
                const auto expected = static_cast<double>((cos(radians(phi)) - sines) / cosines);
                const auto b = bragg_jones(in, out, hts::perfect_conductor(), 0);
                worst.note(std::abs(b.pp - expected) / (std::abs(expected) + std::abs(b.ss)), [&] {
                    return std::to_string(i) + ", " + std::to_string(o) + ", " + std::to_string(phi);
                });
            }
        }
    }
    worst.check();
}

TEST_CASE("a smooth surface scatters as Rayleigh and Rice say") {
    // another program's first-order theory of roughness: 0.7 % is what g = 1.4e-3 explains
    const Point p{{0.002, 1},
                  {0.183, 3.43},
                  Direction::from_degrees(0, 0),
                  Direction::from_degrees(30, 180),
                  Wavelength::from_micrometres(0.633)};
    const auto m = unified_mueller(p.lobe().jones, 0);
    CHECK(m(0, 0) == Approx(2.4846e-5).epsilon(7e-3));
    CHECK(m(0, 1) / m(0, 0) == Approx(-0.135).margin(7e-4));

    WorstCase worst{"first order at k sigma_0 = 6e-4, beside g, 1 - beta and Z", 4};
    Random random{3};
    for (int i = 0; i < 2000; ++i) {
        Point at = random_point(random);
        at.surface = Surface{1e-4, random.logarithmic(0.1, 2)};
        const double tau = at.surface.correlation_length();
        const auto b = bragg_jones(at.in, at.out, at.index, 0);
        const double q = 2 * pi * wave_vector_change(at.in, at.out).horizontal;
        const double psd = 1e-8 * pi * tau * tau * std::exp(-q * q * tau * tau / 4);
        const double scale = 16 * pi * pi * at.in.cos_theta() * at.out.cos_theta() * psd;
        const auto lobe = at.lobe();
        const double expected =
            scale * (std::norm(b.ss) + std::norm(b.sp) + std::norm(b.ps) + std::norm(b.pp)) / 2;
        if (expected < 1e-100 || lobe.kicks.rest > 1e-3) continue;
        const double lifted = 4 * at.wave().lift / std::min(at.in.cos_theta(), at.out.cos_theta());
        worst.note(
            relative_error(lobe.brdf(), expected) / (lobe.phase_variance + lobe.kicks.rest + lifted + 1e-11),
            [&] { return describe(at); });
    }
    worst.check();
}

TEST_CASE("a rough surface has Beckmann's facets with Smith's shadowing of correlated heights") {
    WorstCase worst{"limit of geometric optics, times sigma_0/lambda squared", 0.01};
    Random random{4};
    for (const double sigma : {20.0, 60.0}) {
        for (int i = 0; i < 500; ++i) {
            Point p = random_point(random);
            const double slope = random.uniform(0.05, 0.5);
            p.surface = Surface{sigma, sigma / slope};
            p.in = random.direction(0.2), p.out = random.direction(0.2);
            p.index = {random.uniform(1.2, 3), random.one_of({0, 3})};
            const auto change = wave_vector_change(p.in, p.out);
            const double tan_squared = std::pow(change.horizontal / change.vertical, 2);
            const double alpha = 2 * slope;
            if (tan_squared > 4 * alpha * alpha) continue;
            const double cos_squared = 1 / (1 + tan_squared);
            const double beckmann =
                std::exp(-tan_squared / (alpha * alpha)) / (pi * std::pow(alpha * cos_squared, 2));
            const auto mask = [&](const Direction& d) {
                return visibility(p.surface, d).masked / d.cos_theta();
            };
            const double expected =
                fresnel(change.cos_theta_d(), p.index).unpolarised_reflectance() * beckmann /
                (4 * p.in.cos_theta() * p.out.cos_theta() * (1 + mask(p.in) + mask(p.out))) *
                (1 + p.wave().returned * (p.m()(p.in) * p.m()(p.out) - 1));
            worst.note(relative_error(p.lobe().brdf(), expected) * sigma * sigma / 1000,
                       [&] { return describe(p); });
        }
    }
    worst.check();
}

TEST_CASE("on gentle surfaces away from grazing it is He-Torrance") {
    struct Gentle {
        double sigma, tau, error;
    };
    for (const Gentle& of : {Gentle{1, 20, 3e-4}, Gentle{0.3, 30, 1e-4}}) {
        WorstCase worst{"he_unified beside He-Torrance, of the peak", of.error};
        for (double theta = 0; theta <= 50; theta += 5) {
            const Direction in = Direction::from_degrees(theta, 0);
            const auto he = [&](const Direction& out) {
                const Surface surface{of.sigma, of.tau};
                return directional_diffuse({surface, in, out}, one_um, {1.5, 0}).brdf;
            };
            const double peak = he(in.mirror());
            for (double view = 0; view <= 50; view += 2.5) {
                const Point p{{of.sigma, of.tau}, {1.5, 0}, in, Direction::from_degrees(view, 180)};
                worst.note(std::abs(p.lobe().brdf() - he(p.out)) / peak, [&] { return describe(p); });
            }
        }
        worst.check();
    }
}

TEST_CASE("a limit of Phi chosen by the caller has its own mean of 1/m") {
    using hts::DiffuseLobe;
    CHECK(hts::kicks(1e-4, 0.5, DiffuseLobe::first_order).beta == 1);
    CHECK(hts::kicks(1e-9, 0.5).beta == Approx(1).epsilon(1e-8));
    CHECK(hts::kicks(1e6, 3e5, DiffuseLobe::rough_limit).beta == Approx(1e-6));
    CHECK(hts::kicks(1e6, 3e5).beta == Approx(1e-6).epsilon(2e-6));
    CHECK(hts::kicks(1, 1, DiffuseLobe::none).phi == 0);
}

TEST_CASE("the closed mirror has the limits of second-order theory") {
    const auto wave = [](double sigma, double tau, RefractiveIndex index) {
        return UnifiedWave{{sigma, tau}, ReturnFactor{sigma / tau}, one_um, index};
    };
    // x is g at the normal, and on gentle slopes
    for (const double degrees : {0.0, 40.0}) {
        const Direction in = Direction::from_degrees(degrees, 0);
        const double g = std::pow(4 * pi * 0.1 * in.cos_theta(), 2);
        const auto f = unified_mirror(in, wave(0.1, 50, {1.5, 0}));
        const auto flat = hts::fresnel(in.cos_theta(), {1.5, 0});
        CHECK(std::norm(f.s) == Approx(std::norm(flat.s) * std::exp(-g)).epsilon(1e-4));
        CHECK(std::norm(f.p) == Approx(std::norm(flat.p) * std::exp(-g)).epsilon(4e-4));
    }
    // a rough surface becomes a mirror at the horizon, but for a perfect conductor's p
    const Direction grazing = Direction::from_degrees(90 - 1e-6, 0);
    CHECK(std::norm(unified_mirror(grazing, wave(0.3, 2, {1.5, 0})).s) == Approx(1).epsilon(1e-5));
    CHECK(std::norm(unified_mirror(grazing, wave(0.3, 2, {1.5, 0})).p) == Approx(1).epsilon(1e-5));
    CHECK(std::norm(unified_mirror(grazing, wave(0.3, 2, hts::perfect_conductor())).p) < 1e-100);
}
