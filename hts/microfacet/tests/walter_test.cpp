#include "hts/microfacet/walter.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "checks.hpp"
#include "hts/error.hpp"
#include "hts/terms.hpp"
#include "walter_cases.hpp"

using hts::Direction;
using hts::FacetDistribution;
using hts::FacetShape;
using hts::NormalDraw;
using hts::PathFrom;
using hts::RefractiveIndex;
using hts::Side;
using hts::SidedDirection;
using hts::Uniforms;
using hts::WalterBrdf;
using hts::WalterBsdf;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;
using namespace hts::testing::walter;

namespace {

SidedDirection opposite(const SidedDirection& d) {
    return {d.side == Side::front ? Side::back : Side::front, d.direction};
}

}  // namespace

TEST_CASE("Walter: reflection agrees with 50 digits") {
    const ReferenceTable table{"microfacet/tests/reference/walter_brdf.csv"};
    WorstCase worst{"BRDF", hts::accuracy::microfacet};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const WalterBrdf model{distribution(table(row, "shape"), table(row, "width")),
                               {table(row, "n"), table(row, "k")}};
        const auto in = Direction::from_degrees(table(row, "theta_i_deg"), table(row, "phi_i_deg"));
        const auto out = Direction::from_degrees(table(row, "theta_o_deg"), table(row, "phi_o_deg"));
        worst.note(relative_error(model.brdf(in, out), table(row, "brdf")), [&] {
            return table.describe(row,
                                  {"shape", "width", "theta_i_deg", "phi_i_deg", "theta_o_deg", "phi_o_deg"});
        });
    }
    worst.check();
}

TEST_CASE("Walter: reflection and refraction of a dielectric agree with 50 digits, from both sides") {
    const ReferenceTable table{"microfacet/tests/reference/walter_bsdf.csv"};
    WorstCase worst{"BSDF", hts::accuracy::microfacet};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto facets = distribution(table(row, "shape"), table(row, "width"));
        const double eta_in = table(row, "eta_in");
        const double eta_out = table(row, "eta_out");
        for (const Side side : {Side::front, Side::back}) {
            const WalterBsdf model = side == Side::front ? WalterBsdf{facets, eta_in, eta_out}
                                                         : WalterBsdf{facets, eta_out, eta_in};
            const SidedDirection in{
                side, Direction::from_degrees(table(row, "theta_i_deg"), table(row, "phi_i_deg"))};
            const SidedDirection same{
                side, Direction::from_degrees(table(row, "theta_o_deg"), table(row, "phi_o_deg"))};
            const SidedDirection out = table(row, "out_side") > 0 ? same : opposite(same);
            worst.note(relative_error(model.bsdf(in, out), table(row, "bsdf")), [&] {
                return table.describe(row, {"shape", "width", "eta_in", "eta_out", "theta_i_deg", "phi_i_deg",
                                            "out_side", "theta_o_deg", "phi_o_deg"});
            });
        }
    }
    worst.check();
}

TEST_CASE("Walter: the reflectance of a facet agrees with 50 digits") {
    const ReferenceTable table{"tests/reference/fresnel.csv"};
    WorstCase worst{"reflectance, absolute", hts::accuracy::facet_reflectance};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double reflectance =
            hts::facet_reflectance(table(row, "cos_theta"), {table(row, "n"), table(row, "k")});
        worst.note(std::abs(reflectance - table(row, "F2")), [&] {
            return table.describe(row, {"cos_theta", "n", "k"});
        });
    }
    worst.check();
    for (const double n : {0.5, 1.0, 1.5}) CHECK(hts::facet_reflectance(0, {n, 0}) == (n == 1 ? 0 : 1));
    CHECK(hts::facet_reflectance(0.1, {0.5, 0}) == 1);  // total
    CHECK(hts::facet_reflectance(1, {1e24, 1e24}) == Approx(1).epsilon(1e-15));
    for (const double n : {1e-7, 1e-9, 1e-12})
        CHECK(hts::facet_reflectance(1, {n, 0}) == Approx(1).margin(5 * n));
}

TEST_CASE("Walter: reflection is reciprocal, refraction but for eta squared") {
    Random random{91};
    WorstCase reflection{"f_r(i, o) against f_r(o, i)", 1.7e-15};
    WorstCase refraction{"f_t(i, o)/eta_o^2 against f_t(o, i)/eta_i^2", 3.5e-15};
    for (int i = 0; i < 20000; ++i) {
        const auto facets = random_facets(random);
        const auto where = [&] { return text(facets, 0); };
        const auto in = off_grazing(random);
        const auto out = off_grazing(random);
        const WalterBrdf metal{facets, {random.uniform(0.1, 3), random.uniform(0, 8)}};
        if (const double there = metal.brdf(in, out); there > 1e-250) {
            reflection.note(relative_error(metal.brdf(out, in), there), where);
        }
        const double eta = random.one_of({0.4, 0.7, 1.33, 1.5, 2.4});
        const WalterBsdf glass{facets, 1, eta};
        const SidedDirection light{Side::front, in};
        const SidedDirection view{Side::back, out};
        if (const double there = glass.bsdf(light, view); there > 1e-250) {
            refraction.note(relative_error(glass.bsdf(view, light) * eta * eta, there), where);
        }
        if (const double there = glass.bsdf(opposite(view), light); there > 1e-250) {
            reflection.note(relative_error(glass.bsdf(light, opposite(view)), there), where);
        }
    }
    reflection.check();
    refraction.check();
    CHECK(refraction.count() > 2000);
}

TEST_CASE("Walter: energy kept is 1 less the single-scattering loss") {
    const ReferenceTable table{"microfacet/tests/reference/walter_furnace.csv"};
    WorstCase mirrors{"albedo for F = 1, from the furnace", 1.5e-5};
    // what bounds it: the midpoint rule at the jump where the facets of GGX, alpha 1, are vertical
    WorstCase glass{"reflected and transmitted share, from the furnace", 8e-4};
    for (std::size_t row = 0; row < table.size(); row += hts::testing::exhaustive() ? 1U : 5U) {
        const auto facets = distribution(table(row, "shape"), table(row, "width"));
        const double theta = table(row, "theta_deg");
        const SidedDirection in{Side::front, Direction::from_degrees(theta, 180)};
        const WalterBsdf interface { facets, 1, table(row, "eta") };
        const auto where = [&] { return table.describe(row, {"shape", "width", "theta_deg", "eta"}); };
        // the midpoint rule: lobes of GGX end at a jump, where adaptive rules only lose time
        const auto share = [&](const hts::testing::OnSphere& f, bool front) {
            constexpr int thetas = 600;
            constexpr int azimuths = 240;
            double sum = 0;
            for (int i = 0; i < thetas; ++i) {
                const double polar = pi / 2 * ((i + 0.5) / thetas + (front ? 0 : 1));
                for (int j = 0; j < azimuths; ++j)
                    sum += f(polar, pi * (j + 0.5) / azimuths) * std::sin(polar);
            }
            return sum * pi * pi / (thetas * azimuths);
        };
        const auto scattered = [&](double polar, double phi) {
            const auto out = on_sphere(polar, phi);
            return interface.bsdf(in, out) * out.direction.cos_theta();
        };
        const auto kept = [&](double polar, double phi) {
            const auto out = Direction::from_angles(polar, phi);
            return hts::facet_lobe(facets, in.direction, out).value * out.cos_theta();
        };
        const double albedo = share(kept, true);
        mirrors.note(std::abs(albedo - table(row, "mirrors")), where);
        CHECK(albedo < 1 + 1e-5);
        glass.note(std::abs(share(scattered, true) - table(row, "reflected")), where);
        glass.note(std::abs(share(scattered, false) - table(row, "transmitted")), where);
    }
    mirrors.check();
    glass.check();
}

TEST_CASE("Walter: Beckmann at alpha = 2 sigma/tau is He and Torrance's rough limit but for the shadowing") {
    Random random{96};
    WorstCase limit{"rough limit over S from f over G", 1.8e-13};
    WorstCase full{"full lobe at g > 1e8, times g/(|q^2/2 - 2q + 1| + 1)", 1.1};
    for (int i = 0; i < 3000; ++i) {
        const double roughness = random.logarithmic(0.1, 10);
        const hts::Surface surface{roughness, roughness / random.logarithmic(0.01, 1)};
        const RefractiveIndex index{random.uniform(0.1, 3), random.uniform(0, 8)};
        const Direction in = Direction::from_degrees(random.uniform(0, 80), 0);
        const Direction out = Direction::from_degrees(random.uniform(0, 80), random.uniform(0, 360));
        const hts::PairFactors pair{surface, in, out};
        const auto facets =
            FacetDistribution::beckmann(2 * pair.effective_roughness() / surface.correlation_length());
        const double expected =
            WalterBrdf{facets, index}.brdf(in, out) / (facets.shadowing(in) * facets.shadowing(out));
        if (!(expected > 1e-20)) continue;
        const auto of = [&](double um, hts::DiffuseLobe lobe) {
            return hts::directional_diffuse(pair, hts::Wavelength::from_micrometres(um), index, lobe);
        };
        const auto where = [&] { return text(facets, std::acos(in.cos_theta()) * 180 / pi); };
        limit.note(relative_error(of(0.5, hts::DiffuseLobe::rough_limit).brdf / pair.shadowing(), expected),
                   where);
        const auto term = of(roughness * 1e-4, hts::DiffuseLobe::full);
        const double q = term.lobe_argument / term.phase_variance;
        if (q > 6 || term.phase_variance < 1e8) continue;
        const double approach = (std::abs(q * q / 2 - 2 * q + 1) + 1) / term.phase_variance;
        full.note((relative_error(term.brdf / pair.shadowing(), expected) - 1e-11) / approach, where);
    }
    limit.check();
    full.check();
}

TEST_CASE("Walter: as alpha goes to 0 light goes the way of Snell with the shares of Fresnel") {
    const double alpha = 1e-5;
    Random random{97};
    for (const auto& facets : {FacetDistribution::beckmann(alpha), FacetDistribution::ggx(alpha),
                               FacetDistribution::phong(2 / (alpha * alpha))}) {
        for (const Side side : {Side::front, Side::back}) {
            for (const double theta : {0.0, 20.0, 50.0, 70.0}) {
                const double eta = side == Side::front ? 1.5 : 1 / 1.5;
                const SidedDirection in{side, Direction::from_degrees(theta, 40)};
                const WalterBsdf glass{facets, 1, 1.5};
                double reflected = 0;
                double transmitted = 0;
                const double sine = in.direction.sin_theta() / eta;
                const auto back = Direction::from_degrees(90, 220).vector();
                int astray = 0;
                for (int i = 0; i < 4000; ++i) {
                    const auto drawn = glass.sample(in, random.uniforms());
                    const auto v = drawn.out.direction.vector();
                    const bool mirror = drawn.out.side == side;
                    (mirror ? reflected : transmitted) += drawn.weight / 4000;
                    const double expected = mirror ? in.direction.sin_theta() : sine;
                    const double off = std::hypot(v.x - expected * back.x, v.y - expected * back.y);
                    if (off > 100 * alpha) ++astray;
                }
                // of GGX's facets, by which Phong's are drawn, 1e-4 are steeper than 100 alpha
                CHECK(astray <= (facets.shape() == FacetShape::beckmann ? 0 : 20));
                const bool weighted = facets.shape() == FacetShape::phong;  // others have weights G_1 = 1
                const double f = hts::fresnel(in.direction.cos_theta(), {eta, 0}).unpolarised_reflectance();
                INFO(text(facets, theta) << " side " << static_cast<int>(side));
                CHECK(reflected ==
                      Approx(f).margin(4 * std::sqrt(f * (1 - f) / 4000) + (weighted ? 0.03 : 1e-6)));
                CHECK(reflected + transmitted == Approx(1).margin(weighted ? 0.03 : 1e-3));
                if (sine > 1) CHECK(transmitted == 0);
            }
        }
    }
}

TEST_CASE("Walter: total reflection inside glass sends nothing out") {
    // facets about the normal reflect all light beyond the critical angle, 41.8 deg for 1.5
    const WalterBsdf glass{FacetDistribution::beckmann(0.02), 1, 1.5};
    const SidedDirection in{Side::back, Direction::from_degrees(60, 0)};
    double across = 0;
    for (double theta = 1; theta < 90; ++theta) {
        across = std::max(across, glass.bsdf(in, {Side::front, Direction::from_degrees(theta, 180)}));
    }
    CHECK(across < 1e-60);
    const SidedDirection mirror{Side::back, in.direction.mirror()};
    CHECK(
        glass.bsdf(in, mirror) ==
        Approx(hts::facet_lobe(FacetDistribution::beckmann(0.02), in.direction, in.direction.mirror()).value)
            .epsilon(1e-14));
}

TEST_CASE("Walter: refraction needs a facet between the directions") {
    const WalterBsdf glass{FacetDistribution::ggx(1), 1, 1.5};
    // on the same side of the normal, steeper than any facet of the surface refracts
    CHECK(glass.bsdf({Side::front, Direction::from_degrees(60, 0)},
                     {Side::back, Direction::from_degrees(60, 0)}) == 0);
    CHECK(glass.bsdf({Side::front, Direction::from_degrees(20, 0)},
                     {Side::back, Direction::from_degrees(13, 180)}) > 0);
    // the horizon
    CHECK(glass.bsdf({Side::front, Direction::from_degrees(90, 0)},
                     {Side::back, Direction::from_degrees(30, 180)}) == 0);
    CHECK(glass.pdf({Side::front, Direction::from_degrees(20, 0)},
                    {Side::back, Direction::from_degrees(90, 180)}) == 0);
}

TEST_CASE("Walter: radiance gathered from the eye is compressed by the denser medium") {
    const WalterBsdf glass{FacetDistribution::ggx(0.3), 1, 1.5};
    const SidedDirection known{Side::front, Direction::from_degrees(30, 0)};
    const Uniforms u{0.3, 0.6, 0.9};
    const auto photon = glass.sample(known, u, PathFrom::light);
    const auto gathered = glass.sample(known, u, PathFrom::eye);
    REQUIRE(photon.out.side == Side::back);
    CHECK(gathered.weight == Approx(photon.weight / 2.25).epsilon(1e-14));
    CHECK(gathered.pdf == photon.pdf);
}

TEST_CASE("Walter: no input gives NaN") {
    Random random{98};
    const std::vector<double> ends{0, 0x1p-53, 0.4, 1 - 0x1p-53};
    const std::vector<double> angles{0, 1e-9, 30, 80, 90 - 1e-10, 90};
    for (int i = 0; i < 40000; ++i) {
        const double shape = random.one_of({0, 1, 2});
        const auto facets = distribution(
            shape, shape == 1 ? random.one_of({0, 50, 1e12}) : random.one_of({1e-6, 1e-3, 1, 1e3}));
        const auto which = static_cast<NormalDraw>(random.one_of({0, 1, 2}));
        const WalterBsdf glass{facets, 1, random.one_of({0.01, 0.7, 1 + 2e-6, 1.5, 100}), which};
        const WalterBrdf metal{facets, {random.one_of({1e-3, 1, 1e6}), random.one_of({0, 3})}, which};
        const SidedDirection in{random.uniform(0, 1) < 0.5 ? Side::front : Side::back,
                                Direction::from_degrees(random.one_of(angles), random.one_of({0, 33}))};
        const SidedDirection out{random.uniform(0, 1) < 0.5 ? Side::front : Side::back,
                                 Direction::from_degrees(random.one_of(angles), random.one_of({0, 33, 180}))};
        const Uniforms u{random.one_of(ends), random.one_of(ends), random.one_of(ends)};
        const auto drawn = glass.sample(in, u);
        const auto mirrored = metal.sample(in.direction, u);
        INFO(text(facets, polar_angle(in) * 180 / pi) << " to " << polar_angle(out) * 180 / pi);
        for (const double value : {glass.bsdf(in, out), glass.pdf(in, out), drawn.weight, drawn.pdf,
                                   metal.brdf(in.direction, out.direction),
                                   metal.pdf(in.direction, out.direction), mirrored.weight, mirrored.pdf}) {
            CHECK(std::isfinite(value));
            CHECK(value >= 0);
        }
    }
}

TEST_CASE("Walter: the measured glasses") {
    CHECK(std::string{hts::measured_glasses[0].name} == "ground");
    const SidedDirection in{Side::front, Direction::from_degrees(0, 0)};
    const SidedDirection out{Side::back, Direction::from_degrees(0, 0)};
    for (const auto& glass : hts::measured_glasses) {
        // f_t of the facet that lies flat, (21)
        const double eta = hts::measured_glass_index;
        const double share = 4 * eta / ((1 + eta) * (1 + eta)) * eta * eta / ((eta - 1) * (eta - 1));
        const double alpha = glass.ggx_alpha;
        CHECK(glass.bsdf(FacetShape::ggx).bsdf(in, out) ==
              Approx(share / (pi * alpha * alpha)).epsilon(1e-13));
        CHECK(glass.bsdf(FacetShape::beckmann).bsdf(in, out) ==
              Approx(share / (pi * glass.beckmann_alpha * glass.beckmann_alpha)).epsilon(1e-13));
    }
}

TEST_CASE("Walter: media that cannot be are refused") {
    const auto facets = FacetDistribution::ggx(0.1);
    CHECK_THROWS_WITH((WalterBsdf{facets, 1, 0}), "refractive index of the back 0: must be from 0.01 to 100");
    CHECK_THROWS_WITH((WalterBsdf{facets, std::numeric_limits<double>::quiet_NaN(), 1}),
                      "refractive index of the front nan: must be from 0.01 to 100");
    CHECK_THROWS_WITH(
        (WalterBsdf{facets, 1.5, 1.5}),
        "refractive index of the back 1.5: must be apart from the front's, 1.5, by at least 1e-06 of it");
}
