#include "hts/microfacet/ashikhmin.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "checks.hpp"
#include "hts/error.hpp"

using hts::AshikhminBrdf;
using hts::AshikhminFacets;
using hts::Direction;
using hts::FacetFresnel;
using hts::FacetShadowing;
using hts::LambertianFacets;
using hts::NormalDensity;
using hts::Vector3;
using hts::testing::check_values;
using hts::testing::Random;
using hts::testing::random_direction;
using hts::testing::relative_error;
using hts::testing::text;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180, endless = std::numeric_limits<double>::infinity();

struct Named {
    const char* name;
    NormalDensity density;
};

/// The paper's, and narrower and wider ones; the mean normal along n.
std::vector<Named> upright() {
    const auto satin = NormalDensity::mixture(
        {{0.7, NormalDensity::gaussian(0.1, endless)}, {0.3, NormalDensity::gaussian(0.3, endless)}});
    hts::ValueGrid rings{24, 1, {}};
    for (int i = 0; i < 24; ++i) rings.values.push_back(1 + std::cos(0.8 * i));
    return {{"Gaussian 0.1, 1", NormalDensity::gaussian(0.1, 1)},
            {"Gaussian 0.1, 0.2", NormalDensity::gaussian(0.1, 0.2)},
            {"Gaussian 0.02, 0.05", NormalDensity::gaussian(0.02, 0.05)},
            {"Gaussian 0.05", NormalDensity::gaussian(0.05, 0.05)},
            {"Gaussian 1", NormalDensity::gaussian(1, 1)},
            {"grooves", NormalDensity::grooves(40 * degree, 0.1)},
            {"satin", satin},
            {"velvet", NormalDensity::inverse_gaussian(0.5)},
            {"velvet 0.1", NormalDensity::inverse_gaussian(0.1)},
            {"rings", NormalDensity::tabulated(rings)}};
}

const AshikhminFacets& brushed() {
    static const AshikhminFacets facets{NormalDensity::gaussian(0.2, 0.6)};
    return facets;
}

/// 200 directions, as many as the paper has: 10 elevations even in theta by 20 azimuths.
std::vector<Direction> grid() {
    std::vector<Direction> directions;
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 20; ++j)
            directions.push_back(Direction::from_degrees((i + 0.5) * 9, (j + 0.5) * 18));
    }
    return directions;
}

/// int f cos theta dw over the hemisphere in many short pieces; nothing here knows of half vectors.
template <class Function>
double over_hemisphere(Function f, int pieces = 24) {
    using boost::math::quadrature::gauss;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const auto ring = [&](double theta) {
            double around = 0;
            for (int j = 0; j < 2 * pieces; ++j) {
                const auto along = [&](double phi) { return f(Direction::from_angles(theta, phi)); };
                around += gauss<double, 7>::integrate(along, j * pi / pieces, (j + 1) * pi / pieces);
            }
            return std::cos(theta) * std::sin(theta) * around;
        };
        const double step = pi / 2 / pieces;
        sum += gauss<double, 7>::integrate(ring, i * step, std::fmin((i + 1) * step, pi / 2));
    }
    return sum;
}

}  // namespace

TEST_CASE("Ashikhmin: tables of g and R against their integrals, and energy") {
    WorstCase area{"g(k) tabulated", hts::accuracy::tabulated_area};
    WorstCase reflectance{"R(k) tabulated", hts::accuracy::tabulated_reflectance};
    WorstCase energy{"R(k) above 1, f0 = 1", hts::accuracy::integrated_reflectance};
    const auto mirrors = FacetFresnel::schlick(1);
    for (const auto& [name, density] : upright()) {
        const AshikhminFacets facets{density};
        Random random{1};
        for (int i = 0; i < 300; ++i) {
            const Direction k = random_direction(random);
            area.note(relative_error(facets.projected_area(k), density.projected_area(k.vector())),
                      [&, n = name] { return std::string{n}.append(", ").append(text(k)); });
        }
        for (const Direction& k : grid()) {
            const auto where = [&, n = name] { return std::string{n}.append(", ").append(text(k)); };
            const double most = facets.integrated_reflectance(k, mirrors);
            energy.note(std::fmax(most - 1, 0), where);
            reflectance.note(std::fabs(facets.reflectance(k, 1) - most), where);
            reflectance.note(std::fabs(facets.reflectance(k, 0.3) -
                                       facets.integrated_reflectance(k, FacetFresnel::schlick(0.3))),
                             where);
        }
    }
    area.check();
    reflectance.check();
    energy.check();
}

TEST_CASE("Ashikhmin: the energy of correlated shadowing is bounded too") {
    WorstCase energy{"R(k) above 1, correlated, f0 = 1", hts::accuracy::integrated_reflectance};
    for (const auto& density : {NormalDensity::inverse_gaussian(0.5),
                                NormalDensity::grooves(40 * degree, 0.1), NormalDensity::gaussian(0.3, 1)}) {
        const AshikhminFacets facets{density, FacetShadowing::correlated}, apart{density};
        bool more = true;
        for (const Direction& k : grid()) {
            const double r = facets.integrated_reflectance(k, FacetFresnel::schlick(1));
            energy.note(std::fmax(r - 1, 0), [&] { return text(k); });
            more = more && r >= apart.integrated_reflectance(k, FacetFresnel::schlick(1)) - 1e-3;
        }
        CHECK(more);
    }
    energy.check();
}

TEST_CASE(
    "Ashikhmin: slanted velvet reflects more than it gets, as the paper reports, but not at f0 = 0.05") {
    const AshikhminFacets facets{NormalDensity::slanted_fibres(0.5, 40 * degree), FacetShadowing::correlated};
    const AshikhminFacets uncorrelated{NormalDensity::slanted_fibres(0.5, 40 * degree)};
    REQUIRE(facets.density().tilted_mean());
    for (const auto* kind : {&facets, &uncorrelated}) {
        int above = 0, above_at_005 = 0;
        double most = 0;
        for (const Direction& k : grid()) {
            const double r = kind->integrated_reflectance(k, FacetFresnel::schlick(1));
            above += r > 1 ? 1 : 0;
            most = std::fmax(most, r);
            above_at_005 += kind->integrated_reflectance(k, FacetFresnel::schlick(0.05)) > 1 ? 1 : 0;
        }
        std::cout << "slanted velvet: R > 1 in " << above << " of 200 directions at f0 = 1 (most " << most
                  << "), in " << above_at_005 << " at f0 = 0.05; the paper: 14 and 0\n";
        CHECK(std::abs(above - 14) <= 1);
        CHECK(above_at_005 == 0);
    }
}

TEST_CASE("Ashikhmin: R(k) agrees with the integral of the BRDF over the outgoing direction") {
    WorstCase worst{"R(k)", hts::accuracy::integrated_reflectance};
    for (const auto shadowing : {FacetShadowing::uncorrelated, FacetShadowing::correlated}) {
        for (const auto& density : {NormalDensity::gaussian(0.3, 1), NormalDensity::inverse_gaussian(0.5),
                                    NormalDensity::grooves(40 * degree, 0.3)}) {
            const AshikhminFacets facets{density, shadowing};
            const AshikhminBrdf model{facets, FacetFresnel::schlick(0.3), 0};
            for (const double theta : {5.0, 45.0, 80.0}) {
                const auto in = Direction::from_degrees(theta, 25);
                const double direct =
                    over_hemisphere([&](const Direction& out) { return model.brdf(in, out); });
                worst.note(std::fabs(facets.integrated_reflectance(in, FacetFresnel::schlick(0.3)) - direct),
                           [&] { return text(in); });
            }
        }
    }
    worst.check();
}

TEST_CASE("Ashikhmin: the BRDF is (26) with each factor from its own definition") {
    const auto density = NormalDensity::gaussian(0.2, 0.6);
    const AshikhminBrdf model{brushed(), FacetFresnel::schlick(0.04), 0};
    const AshikhminFacets correlated_facets{density, FacetShadowing::correlated};
    WorstCase worst{"rho of (26)", 2 * hts::accuracy::tabulated_area},
        from_14{"rho with (14)", 2 * hts::accuracy::tabulated_area};
    Random random{4};
    for (int i = 0; i < 200; ++i) {
        const Direction in = random_direction(random),
                        out = i % 3 == 0 ? in.mirror() : random_direction(random);
        const Vector3 k1 = in.vector(), k2 = out.vector(), sum = k1 + k2;
        const Vector3 h = (1 / std::sqrt(dot(sum, sum))) * sum;
        const double p = density(h);
        if (p < 1e-200) continue;
        const double projection = density.projection(), f = 0.04 + 0.96 * std::pow(1 - dot(k1, h), 5);
        const double p1 = k1.z * projection / density.projected_area(k1),
                     p2 = k2.z * projection / density.projected_area(k2);
        const auto with = [&](double both) { return p * both * f / (4 * k1.z * k2.z * projection); };  // (11)
        const auto where = [&] { return text(in) + "; " + text(out); };
        worst.note(relative_error(model.brdf(in, out), with(p1 * p2)), where);
        const double phi =
            std::acos(std::clamp(in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi(), -1.0, 1.0)) /
            degree;
        const double t = std::exp(-std::pow(phi / 15, 2));
        from_14.note(relative_error(f * correlated_facets.pair(in, out).lobe,
                                    with((1 - t) * p1 * p2 + t * std::fmin(p1, p2))),
                     where);
    }
    worst.check();
    from_14.check();
}

TEST_CASE("Ashikhmin: reciprocity, and finite values everywhere") {
    const AshikhminFacets velvet{NormalDensity::inverse_gaussian(0.5), FacetShadowing::correlated};
    const AshikhminFacets slanted{NormalDensity::slanted_fibres(0.5, 0.7)};
    const AshikhminFacets plaster{NormalDensity::gaussian(0.5, 0.5)};
    const FacetFresnel fresnel = FacetFresnel::schlick(0.05);
    check_values("coupled diffuse", AshikhminBrdf{brushed(), fresnel, 0.6}, 1e-13);
    check_values("metal", AshikhminBrdf::metal(brushed(), 0.9), 1e-13);
    check_values("velvet", AshikhminBrdf{velvet, fresnel, 0.2}, 1e-13);
    check_values("slanted velvet", AshikhminBrdf{slanted, fresnel, 0}, 1e-13);
    check_values("Lambertian facets", LambertianFacets{plaster, 0.8}, 1e-13);
}

TEST_CASE("Ashikhmin: a mixture from tables of its shares is the mixture") {
    const auto flats = NormalDensity::gaussian(0.1, endless), ends = NormalDensity::gaussian(0.3, endless);
    const AshikhminFacets whole{NormalDensity::mixture({{0.7, flats}, {0.3, ends}})};
    const AshikhminFacets added{{{0.7, AshikhminFacets{flats}}, {0.3, AshikhminFacets{ends}}},
                                FacetShadowing::uncorrelated};
    WorstCase worst{"g(k) of added tables", 2 * hts::accuracy::tabulated_area};
    Random random{8};
    for (int i = 0; i < 300; ++i) {
        const Direction k = random_direction(random);
        worst.note(relative_error(added.projected_area(k), whole.density().projected_area(k.vector())),
                   [&] { return text(k); });
        const Direction out = random_direction(random);
        CHECK(added.pair(k, out).lobe ==
              Approx(whole.pair(k, out).lobe).epsilon(8 * hts::accuracy::tabulated_area));
    }
    worst.check();
}

TEST_CASE("Ashikhmin: the diffuse term returns all that the facets leave") {
    const FacetFresnel glass = FacetFresnel::exact({1.5, 0});
    WorstCase worst{"albedo at rho_d = 1", hts::accuracy::tabulated_reflectance};
    for (const auto& model :
         {AshikhminBrdf{brushed(), FacetFresnel::schlick(0.05), 1}, AshikhminBrdf{brushed(), glass, 1}}) {
        for (const double theta : {0.0, 50.0, 85.0}) {
            const auto in = Direction::from_degrees(theta, 70);
            CHECK(model.albedo(in) == Approx(1).epsilon(1e-12));
            worst.note(
                std::fabs(over_hemisphere([&](const Direction& out) { return model.brdf(in, out); }) - 1),
                [&] { return text(in); });
        }
    }
    worst.check();
    const auto in = Direction::from_degrees(20, 0), aside = Direction::from_degrees(85, 100);
    const AshikhminBrdf half{brushed(), glass, 0.5}, none{brushed(), glass, 0}, all{brushed(), glass, 1};
    CHECK(half.brdf(in, aside) - none.brdf(in, aside) ==
          Approx((all.brdf(in, aside) - none.brdf(in, aside)) / 2).epsilon(1e-9));
    const auto pair = brushed().pair(in, in);
    CHECK(none.brdf(in, in) ==
          Approx(pair.lobe * hts::fresnel(pair.cos_theta_d, {1.5, 0}).unpolarised_reflectance())
              .epsilon(1e-14));
}

TEST_CASE("Ashikhmin: a metal's diffuse light is what its facets lose, none where they lose nothing") {
    const double f0 = 0.7;
    const AshikhminFacets rough{NormalDensity::gaussian(1, 1)}, smooth{NormalDensity::gaussian(0.05, 0.05)};
    const auto in = Direction::from_degrees(30, 0);
    const auto metal = AshikhminBrdf::metal(rough, f0);
    const double lost = f0 - rough.reflectance(in, f0);
    REQUIRE(lost > 0.01);
    CHECK(metal.albedo(in) == Approx(rough.reflectance(in, f0) + f0 * lost));
    CHECK(over_hemisphere([&](const Direction& out) { return metal.brdf(in, out); }) ==
          Approx(metal.albedo(in)).margin(hts::accuracy::tabulated_reflectance));
    // near grazing incidence F exceeds f0 and R(k) too: no diffuse light
    const auto grazing = Direction::from_degrees(70, 0), aside = Direction::from_degrees(70, 90);
    REQUIRE(smooth.reflectance(grazing, f0) > f0);
    CHECK(AshikhminBrdf::metal(smooth, f0).brdf(grazing, aside) ==
          AshikhminBrdf(smooth, FacetFresnel::schlick(f0), 0).brdf(grazing, aside));
}

TEST_CASE("Ashikhmin: Lambertian facets agree with their integral, and flat ones are Lambert's") {
    const double albedo = 0.8;
    WorstCase worst{"Lambertian facets", hts::accuracy::lambertian_facets};
    for (const double sigma : {0.3, 1.0}) {
        const auto density = NormalDensity::gaussian(sigma, sigma);
        const LambertianFacets model{AshikhminFacets{density}, albedo};
        for (const auto& [theta, other, phi] : {std::array{0.0, 40.0, 0.0},
                                                {30.0, 30.0, 0.0},
                                                {30.0, 30.0, 180.0},
                                                {75.0, 50.0, 100.0},
                                                {80.0, 80.0, 30.0}}) {
            const auto in = Direction::from_degrees(theta, 20),
                       out = Direction::from_degrees(other, 20 + phi);
            const Vector3 k1 = in.vector(), k2 = out.vector();
            const double both = over_hemisphere([&](const Direction& h) {
                const Vector3 normal = h.vector();
                return std::fmax(dot(normal, k1), 0) * std::fmax(dot(normal, k2), 0) * density(normal) /
                       std::fmax(normal.z, 1e-300);
            });
            const double expected = albedo / pi * density.projection() * both /
                                    (density.projected_area(k1) * density.projected_area(k2));
            worst.note(std::fabs(model.brdf(in, out) - expected) / (albedo / pi),
                       [&] { return text(in) + "; " + text(out); });
        }
    }
    worst.check();
    const LambertianFacets flat{AshikhminFacets{NormalDensity::gaussian(1e-3, 1e-3)}, albedo};
    const auto in = Direction::from_degrees(50, 0);
    for (const double theta : {0.0, 40.0, 70.0})
        CHECK(flat.brdf(in, Direction::from_degrees(theta, 60)) == Approx(albedo / pi).epsilon(1e-4));
    const LambertianFacets rough{AshikhminFacets{NormalDensity::gaussian(1, 1)}, albedo};
    const auto far = Direction::from_degrees(60, 0);
    CHECK(rough.brdf(far, far) > 1.2 * rough.brdf(far, far.mirror()));  // as Oren and Nayar found
}

TEST_CASE("Ashikhmin: draws fall as the density says, and their mean weight is the albedo") {
    const std::size_t count = hts::testing::exhaustive() ? 1'000'000 : 20'000;
    const auto check = [&](const char* name, const auto& model, double albedo, const Direction& in,
                           double peak) {
        Random random{23};
        double sum = 0, squares = 0, draws = 0, most = 0;
        const auto draw = [&]() -> std::optional<hts::testing::Angles> {
            const double u0 = random.uniform(0, 1), u1 = random.uniform(0, 1);
            const auto drawn = model.sample(in, {u0, u1, random.uniform(0, 1)});
            sum += drawn.weight, squares += drawn.weight * drawn.weight, draws += 1;
            most = std::fmax(most, drawn.weight);
            if (drawn.pdf == 0) return std::nullopt;
            const double phi = std::atan2(drawn.out.sin_phi(), drawn.out.cos_phi());
            return hts::testing::Angles{std::atan2(drawn.out.sin_theta(), drawn.out.cos_theta()),
                                        std::remainder(phi - peak, 2 * pi)};
        };
        const auto density = [&](double theta, double phi) {
            return theta < pi / 2 ? model.pdf(in, Direction::from_angles(theta, phi + peak)) : 0.0;
        };
        const auto fit = hts::testing::fit_of(draw, density, count);
        const double mean = sum / draws, deviation = std::sqrt((squares / draws - mean * mean) / draws);
        INFO(name << ", " << text(in) << ": p " << fit.p_value << ", mean weight " << mean << " +- "
                  << deviation << " of " << albedo << ", largest " << most << ", total " << fit.total
                  << ", none " << fit.none);
        CHECK(fit.p_value > 1e-4);
        CHECK(fit.deviation_of_sum(count) < 5);
        CHECK(std::fabs(mean - albedo) < 4 * deviation + hts::accuracy::tabulated_reflectance);
    };
    const AshikhminBrdf painted{brushed(), FacetFresnel::schlick(0.05), 0.5};
    const AshikhminBrdf grooved{AshikhminFacets{NormalDensity::grooves(40 * degree, 0.2)},
                                FacetFresnel::schlick(0.9), 0};
    for (const double theta : {10.0, 60.0, 85.0}) {
        const auto in = Direction::from_degrees(theta, 30);
        check("painted", painted, painted.albedo(in), in, 210 * degree);
        check("grooves", grooved, grooved.albedo(in), in, 210 * degree);
    }
    const LambertianFacets plaster{AshikhminFacets{NormalDensity::gaussian(0.6, 0.6)}, 0.9};
    const auto in = Direction::from_degrees(60, 0);
    check("plaster", plaster, over_hemisphere([&](const Direction& out) { return plaster.brdf(in, out); }),
          in, 0);
}

TEST_CASE("Ashikhmin: bad parameters are named") {
    using Catch::Contains;
    CHECK_THROWS_WITH(FacetFresnel::schlick(1.5), Contains("f0 1.5: must be from 0 to 1"));
    CHECK_THROWS_WITH(AshikhminBrdf(brushed(), FacetFresnel::schlick(0.5), -1),
                      Contains("diffuse albedo -1"));
    CHECK_THROWS_WITH(AshikhminBrdf::metal(brushed(), std::nan("")), Contains("f0 nan"));
    CHECK_THROWS_WITH(LambertianFacets(brushed(), 0.5), Contains("isotropic"));
}
