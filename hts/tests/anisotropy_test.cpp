// Surfaces of two correlation lengths: the exact path against 50 digits and against identities, the
// lanes against the exact path.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/evaluation/single_precision.hpp"
#include "hts/he_torrance.hpp"
#include "hts/unified/he_unified.hpp"
#include "hts/unified/unified_mirror.hpp"

using hts::CorrelationLengths;
using hts::Direction;
using hts::DirectionPair;
using hts::HeTorranceSpectrum;
using hts::HeUnifiedSpectrum;
using hts::Mueller;
using hts::RefractiveIndex;
using hts::SpectralSample;
using hts::Surface;
using hts::Tolerance;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;

Surface surface(double sigma, const CorrelationLengths& lengths, double azimuth_deg) {
    return Surface::anisotropic(sigma, lengths, Direction::from_degrees(90, azimuth_deg));
}

Surface any_surface(Random& random) {
    const double sigma = random.logarithmic(0.01, 2), steepest = random.logarithmic(0.03, 1);
    const double gentlest = std::max(0.003, steepest / random.logarithmic(1.1, 50));
    const CorrelationLengths lengths{sigma / steepest, sigma / gentlest};
    return surface(sigma, lengths, random.uniform(-180, 180));
}

Direction any_direction(Random& random) {
    const double theta =
        random.uniform(0, 8) < 1 ? random.one_of({0, 45, 89.99, 90}) : random.uniform(0, 89.9);
    return Direction::from_degrees(theta, random.uniform(-180, 180));
}

/// Any two directions, now and then those of the mirror, of backscatter, or near the mirror's.
DirectionPair any_pair(Random& random) {
    const Direction in = any_direction(random);
    const double pick = random.uniform(0, 8);
    if (pick < 1) return {in, in.mirror()};
    if (pick < 2) return {in, in};
    if (pick < 5) {
        const hts::Vector3 near = in.mirror().vector();
        const double step = random.logarithmic(1e-6, 0.3), turn = random.uniform(0, 2 * pi);
        return {in, Direction::from_vector({near.x + step * std::cos(turn), near.y + step * std::sin(turn),
                                            near.z + step / 10})};
    }
    return {in, any_direction(random)};
}

std::string described(const Surface& s, const DirectionPair& p) {
    std::ostringstream text;
    text.precision(17);
    const auto [along, across] = s.correlation_lengths();
    const auto degrees = [](double y, double x) { return std::atan2(y, x) * 180 / pi; };
    text << "sigma0 " << s.rms_roughness() << ", tau " << along << " along " << s.azimuth() * 180 / pi << ", "
         << across << " across; light " << degrees(p.in.sin_theta(), p.in.cos_theta()) << ", "
         << degrees(p.in.sin_phi(), p.in.cos_phi()) << ", view "
         << degrees(p.out.sin_theta(), p.out.cos_theta()) << ", "
         << degrees(p.out.sin_phi(), p.out.cos_phi());
    return text.str();
}

const RefractiveIndex aluminium{0.77, 6.08};
const Wavelength one_um = Wavelength::from_micrometres(1);

template <class Spectrum>
double brdf(const Surface& s, const DirectionPair& p, double wavelength = 1,
            Tolerance tolerance = Tolerance{1e-12}) {
    const Spectrum model{s, {{Wavelength::from_micrometres(wavelength), aluminium, 0}}, tolerance};
    double value = 0;
    model.brdf(p, {&value, 1});
    return value;
}

}  // namespace

TEST_CASE("surfaces of two correlation lengths say what they are") {
    const Surface s = surface(0.2, {1, 4}, 30);
    CHECK_FALSE(s.isotropic());
    CHECK(s.correlation_length() == 2);
    CHECK(s.shortest_correlation_length() == 1);
    CHECK(s.azimuth() == Approx(pi / 6).epsilon(1e-15));
    CHECK(s.slope_width() == Approx(0.2));
    CHECK(s.correlation_length(Direction::from_degrees(40, 210)) == Approx(1).epsilon(1e-14));
    CHECK(s.correlation_length(Direction::from_degrees(40, 120)) == Approx(4).epsilon(1e-14));
    CHECK(s.slope_width(Direction::from_degrees(1, 75)) ==
          Approx(0.4 * std::sqrt((1 + 1.0 / 16) / 2)).epsilon(1e-14));
    CHECK(s.stretched({std::sqrt(3) / 2, 0.5}) == Approx(0.5).epsilon(1e-14));
    CHECK(s.stretched({-0.5, std::sqrt(3) / 2}) == Approx(2).epsilon(1e-14));
    CHECK(surface(0.2, {3, 3}, 70).isotropic());
    CHECK(surface(0.2, {3, 3}, 70).azimuth() == 0);
    CHECK_THROWS_WITH(surface(0.2, {3, 0}, 0),
                      "correlation length 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    CHECK_THROWS_WITH(surface(0.2, {-1, 1}, 0),
                      "correlation length -1 um: must be > 0 (from 1e-24 to 1e+24 um)");
}

TEST_CASE("both models of surfaces of two correlation lengths agree with 50 digits") {
    const ReferenceTable table{"tests/reference/anisotropic.csv"};
    REQUIRE(table.size() == 100);
    // narrow lobes keep less in proportion: lengths are up to 50 times as long as sigma0/0.01
    WorstCase lobe{"lobe of he, anisotropic", hts::accuracy::brdf};
    WorstCase mirror{"specular term of he, anisotropic", hts::accuracy::specular_reflectance};
    WorstCase unified{"Mueller matrix of he_unified, anisotropic", 4 * hts::accuracy::unified_brdf};
    WorstCase unified_mirrors{"specular term of he_unified, anisotropic", hts::accuracy::unified_mirror};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto at = [&](const char* column) { return table(row, column); };
        const Surface s = surface(at("sigma"), {at("along"), at("across")}, at("azimuth"));
        const DirectionPair p{Direction::from_degrees(at("theta_i"), at("phi_i")),
                              Direction::from_degrees(at("theta_r"), at("phi_r"))};
        const RefractiveIndex index{at("n"), at("k")};
        const auto where = [&] { return described(s, p); };
        const auto term = hts::directional_diffuse({s, p.in, p.out}, one_um, index);
        lobe.note(relative_error(term.brdf, at("lobe")), where);
        if (at("mirror") > 1e-280) {
            mirror.note(relative_error(hts::specular_reflectance(s, view(s, p.in), one_um, index).value(),
                                       at("mirror")),
                        where);
        }
        const hts::ReturnFactor m{s};
        const hts::UnifiedWave wave{s, m, one_um, index};
        const Mueller matrix = unified_mueller(unified_lobe({s, m, p.in}, {s, m, p.out}, wave).jones, 0);
        for (std::size_t i = 0; i < 16; ++i) {
            std::string column{"m"};
            column.append(std::to_string(i / 4)).append(std::to_string(i % 4));
            unified.note(std::abs(matrix.elements()[i] - table(row, column)) / at("m00"), where);
        }
        const auto f = unified_mirror(p.in, wave);
        if (std::min(at("rs"), at("rp")) < 1e-280) continue;
        unified_mirrors.note(relative_error(std::norm(f.s), at("rs")), where);
        unified_mirrors.note(relative_error(std::norm(f.p), at("rp")), where);
    }
    lobe.check();
    mirror.check();
    unified.check();
    unified_mirrors.check();
}

TEMPLATE_TEST_CASE("equal lengths are one length, to the last bit", "", HeTorranceSpectrum,
                   HeUnifiedSpectrum) {
    Random random{3};
    for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
        for (int i = 0; i < 100; ++i) {
            const double sigma = random.logarithmic(0.01, 1), tau = sigma / random.logarithmic(0.01, 1);
            const std::vector<SpectralSample> samples{{one_um, aluminium, 0.1}};
            const TestType one{{sigma, tau}, samples, Tolerance{tolerance}};
            const TestType two{surface(sigma, {tau, tau}, random.uniform(-180, 180)), samples,
                               Tolerance{tolerance}};
            const DirectionPair p = any_pair(random);
            double a = 0, b = 0;
            Mueller m, n;
            one.brdf(p, {&a, 1});
            two.brdf(p, {&b, 1});
            one.mueller(p, {&m, 1});
            two.mueller(p, {&n, 1});
            CHECK(a == b);
            CHECK(m.elements() == n.elements());
        }
    }
}

TEMPLATE_TEST_CASE("turned surfaces, exchanged axes and exchanged directions reflect alike", "",
                   HeTorranceSpectrum, HeUnifiedSpectrum) {
    WorstCase exchanged{"lengths exchanged and the azimuth turned by 90 deg", 1.6e-13};
    WorstCase turned{"everything turned together", 6e-13};
    WorstCase reversed{"directions exchanged", 2.4e-15};
    Random random{4};
    for (int i = 0; i < 500; ++i) {
        const double sigma = random.logarithmic(0.01, 1), slope = random.logarithmic(0.03, 0.7);
        const CorrelationLengths lengths{sigma / slope, sigma / slope * random.logarithmic(1.1, 10)};
        // multiples of 2^-20 degrees, whose sums are exact: far out in a lobe the relative error is some
        // hundred times the rounding of an azimuth
        const auto exact = [&](double low, double high) {
            return std::round(random.uniform(low, high) * 0x1p20) * 0x1p-20;
        };
        const double azimuth = exact(-180, 180), turn = exact(-180, 180);
        const double theta_i = random.uniform(0.1, 85), phi_i = exact(-180, 180);
        const double theta_r = std::clamp(theta_i + random.uniform(-20, 20), 0.1, 85.);
        const double phi_r = phi_i + 180 + exact(-30, 30);
        const auto pair = [&](double by) {
            return DirectionPair{Direction::from_degrees(theta_i, phi_i + by),
                                 Direction::from_degrees(theta_r, phi_r + by)};
        };
        const Surface s = surface(sigma, lengths, azimuth);
        const double f = brdf<TestType>(s, pair(0));
        if (f < 1e-200) continue;
        const auto where = [&] { return described(s, pair(0)); };
        exchanged.note(
            relative_error(
                brdf<TestType>(surface(sigma, {lengths.across, lengths.along}, azimuth + 90), pair(0)), f),
            where);
        turned.note(relative_error(brdf<TestType>(surface(sigma, lengths, azimuth + turn), pair(turn)), f),
                    where);
        reversed.note(relative_error(brdf<TestType>(s, {pair(0).out, pair(0).in}), f), where);
    }
    exchanged.check();
    turned.check();
    reversed.check();
}

TEST_CASE("short wavelengths meet Beckmann's facets of two widths") {
    // [Walter07 (20), (25)] with alpha_x = 2 sigma/tau_x, alpha_y = 2 sigma/tau_y, q the
    // slopes of the half vector
    WorstCase published{"he in the rough limit", 8e-7};
    WorstCase successor{"he_unified in the rough limit", 8e-7};
    Random random{5};
    const double wavelength = 1e-3;
    for (int i = 0; i < 300; ++i) {
        const double steep = random.uniform(0.1, 0.5), gentle = random.uniform(0.02, 0.1);
        const Surface s = surface(1, {1 / steep, 1 / gentle}, 0);
        const Direction in = Direction::from_degrees(random.uniform(0, 60), random.uniform(-180, 180));
        const Direction out = Direction::from_degrees(
            std::clamp(std::acos(in.cos_theta()) * 180 / pi + random.uniform(-10, 10), 0., 70.),
            std::atan2(in.sin_phi(), in.cos_phi()) * 180 / pi + 180 + random.uniform(-10, 10));
        const hts::Vector3 v = in.vector() + out.vector();
        const auto density = [&](double sigma) {
            const double x = v.x / v.z / (2 * sigma * steep), y = v.y / v.z / (2 * sigma * gentle);
            const double tilt = dot(v, v) / (v.z * v.z);  // 1/cos^2
            return std::exp(-x * x - y * y) * tilt * tilt / (pi * 4 * sigma * sigma * steep * gentle);
        };
        const double cosines = in.cos_theta() * out.cos_theta();
        const auto where = [&] { return described(s, {in, out}); };
        const hts::PairFactors pair{s, in, out};
        const double reflectance = hts::fresnel(pair.cos_theta_d(), aluminium).unpolarised_reflectance();
        const double expected =
            reflectance * density(pair.effective_roughness()) * pair.shadowing() / (4 * cosines);
        if (expected > 1e-12)
            published.note(relative_error(brdf<HeTorranceSpectrum>(s, {in, out}, wavelength), expected),
                           where);
        // of he_unified by slopes along each azimuth
        const auto slope = [&](const Direction& d) {
            return std::hypot(steep * d.cos_phi(), gentle * d.sin_phi());
        };
        const auto lambda = [&](const Direction& d) {
            const double c = d.cos_theta() / d.sin_theta() / (2 * slope(d));
            return (std::exp(-c * c) / (std::sqrt(pi) * c) - std::erfc(c)) / 2;
        };
        const double returned = hts::ReturnFactor{s}.returned(hts::flat_reflectance(aluminium));
        const auto m = [&](const Direction& d) { return hts::ReturnFactor{slope(d)}(d); };
        const double facets = reflectance * density(1) / (4 * cosines) *
                              (1 + returned * (m(in) * m(out) - 1)) / (1 + lambda(in) + lambda(out));
        if (facets > 1e-12)
            successor.note(relative_error(brdf<HeUnifiedSpectrum>(s, {in, out}, wavelength), facets), where);
    }
    published.check();
    successor.check();
}

TEST_CASE("the lobe's sum over all wave vectors is what the mirror loses") {
    // integral of Phi d^2v = 4 pi (1 - exp(-g))/(k^2 tau_x tau_y)
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    WorstCase worst{"integral of Phi over v_xy", 1.2e-10};
    for (const double ratio : {1.0, 3.0, 10.0}) {
        for (const double g : {0.1, 2.0, 30.0}) {
            const Surface s = surface(0.1, {1 / std::sqrt(ratio), std::sqrt(ratio)}, 25);
            const double end = 14 * std::sqrt((1 + g) * ratio);
            const auto along_y = [&](double x) {
                return Rule::integrate(
                    [&](double y) {
                        return hts::phi(g, std::pow(s.stretched({x, y}) / 2, 2)).value;
                    },
                    -end, end, 10, 1e-11);
            };
            const double sum = Rule::integrate(along_y, -end, end, 10, 1e-10);
            worst.note(relative_error(sum, 4 * pi * -std::expm1(-g)),
                       [&] { return "g " + std::to_string(g); });
        }
    }
    worst.check();
}

TEMPLATE_TEST_CASE("grooves keep light in its cone", "", HeTorranceSpectrum, HeUnifiedSpectrum) {
    const auto groove = [](double length, double out_of_cone) {
        const Direction in = Direction::from_degrees(40, 0);  // across the grooves
        return brdf<TestType>(surface(0.2, {2, length}, 0),
                              {in, Direction::from_degrees(50, 180 + out_of_cone)});
    };
    CHECK(groove(1000, 5) < 1e-100);
    CHECK(groove(1000, 0) == Approx(10 * groove(100, 0)).epsilon(1e-3));  // grows as the length
}

TEMPLATE_TEST_CASE("lanes of surfaces of two correlation lengths are as exact as asked for", "",
                   HeTorranceSpectrum, HeUnifiedSpectrum) {
    const bool unified = std::is_same_v<TestType, HeUnifiedSpectrum>;
    for (const double tolerance : {1e-6, 1e-3}) {
        const bool single = !unified && tolerance >= hts::accuracy::single_precision_brdf;
        const double floor = single ? hts::accuracy::single_precision_floor : 1e-280;
        const std::string name = std::string{unified ? " of he_unified" : " of he"} + ", anisotropic, at " +
                                 std::to_string(tolerance);
        WorstCase values{"brdf" + name, tolerance};
        WorstCase mirrors{"specular term" + name, tolerance};
        WorstCase matrices{"mueller" + name, tolerance};
        Random random{20261129};
        while (values.count() < (hts::testing::exhaustive() ? 1'000'000U : 20'000U)) {
            const Surface s = any_surface(random);
            const std::size_t count = 1 + values.count() % 13;
            std::vector<SpectralSample> samples;
            for (std::size_t i = 0; i < count; ++i) {
                samples.push_back({Wavelength::from_micrometres(random.logarithmic(0.3, 13)),
                                   {random.uniform(0.1, 4), random.one_of({0, 0.5, 5})},
                                   0});
            }
            const TestType fast{s, samples, Tolerance{tolerance}};
            const TestType slow{s, samples, Tolerance{hts::accuracy::finest_tolerance}};
            std::vector<DirectionPair> pairs;
            for (int i = 0; i < 20; ++i) pairs.push_back(any_pair(random));
            std::vector<double> f(count), exact(count), mirror(count), exact_mirror(count),
                batch(count * pairs.size());
            std::vector<Mueller> m(count), exact_m(count);
            fast.brdf(pairs, batch);
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                fast.brdf(pairs[i], f);
                slow.brdf(pairs[i], exact);
                fast.specular_reflectance(pairs[i].in, mirror);
                slow.specular_reflectance(pairs[i].in, exact_mirror);
                fast.mueller(pairs[i], m);
                slow.mueller(pairs[i], exact_m);
                const auto where = [&] { return described(s, pairs[i]); };
                for (std::size_t j = 0; j < count; ++j) {
                    if (f[j] != batch[i * count + j]) FAIL("other bits in a batch at " << where());
                    if (exact_mirror[j] > 1e-280)
                        mirrors.note(relative_error(mirror[j], exact_mirror[j]), where);
                    if (exact[j] < floor) {  // absolute there
                        if (single) values.note(std::abs(f[j] - exact[j]) / floor, where);
                        continue;
                    }
                    values.note(relative_error(f[j], exact[j]), where);
                    for (std::size_t e = 0; e < 16; ++e)
                        matrices.note(std::abs(m[j].elements()[e] - exact_m[j].elements()[e]) / exact[j],
                                      where);
                }
            }
        }
        values.check();
        mirrors.check();
        matrices.check();
    }
}

TEMPLATE_TEST_CASE("every surface of two correlation lengths has a finite answer", "", HeTorranceSpectrum,
                   HeUnifiedSpectrum) {
    Random random{6};
    const auto length = [&] { return random.one_of({1e-24, 1e-12, 1e-3, 1, 1e6, 1e24}); };
    for (int i = 0; i < 20'000; ++i) {
        const Surface s = surface(random.one_of({0, 1e-24, 1e-3, 1, 1e24}), {length(), length()},
                                  random.uniform(-180, 180));
        for (const double tolerance : {1e-6, 1e-12}) {
            const double f = brdf<TestType>(s, any_pair(random), length(), Tolerance{tolerance});
            if (!(std::isfinite(f) && f >= 0))
                FAIL(f << " at sigma0 " << s.rms_roughness() << ", tau " << s.correlation_lengths().along
                       << ", " << s.correlation_lengths().across);
        }
    }
    SUCCEED();
}

TEST_CASE("what is known of isotropic surfaces alone is refused of others") {
    const std::vector<SpectralSample> samples{{one_um, aluminium, 0}};
    const Surface s = surface(0.1, {1, 2}, 0);
    const auto with = [&](const hts::UnifiedChoices& choices) {
        return HeUnifiedSpectrum{s, samples, {}, hts::DiffuseLobe::full, choices};
    };
    CHECK_THROWS_WITH(with({.mirror = hts::UnifiedChoices::Mirror::second_order}),
                      Catch::Contains("second-order mirror") && Catch::Contains("two correlation lengths"));
    CHECK_THROWS_WITH(with({.polarisation_mixing = true}),
                      Catch::Contains("polarisation mixing") && Catch::Contains("must be false"));
}
