#include "hts/microfacet/distribution.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>

#include "chi_squared.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::FacetDistribution;
using hts::FacetShape;
using hts::NormalDraw;
using hts::SmithForm;
using hts::Vector3;
using hts::testing::Angles;
using hts::testing::Draw;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;

FacetDistribution distribution(double shape, double width) {
    if (shape == 0) return FacetDistribution::beckmann(width);
    return shape == 1 ? FacetDistribution::phong(width) : FacetDistribution::ggx(width);
}

const std::vector<FacetDistribution>& examples() {
    static const std::vector<FacetDistribution> all{
        FacetDistribution::beckmann(0.1), FacetDistribution::phong(48), FacetDistribution::ggx(0.1),
        FacetDistribution::beckmann(0.8), FacetDistribution::phong(2),  FacetDistribution::ggx(0.8)};
    return all;
}

std::string text(const FacetDistribution& facets, double theta, NormalDraw which) {
    std::ostringstream text;
    text << "shape " << static_cast<int>(facets.shape()) << ", alpha " << facets.alpha() << ", theta "
         << theta << ", draw " << static_cast<int>(which);
    return text.str();
}

}  // namespace

TEST_CASE("facets: D and G_1 agree with 50 digits, G_1 with Smith's integral") {
    const ReferenceTable table{"microfacet/tests/reference/walter_facets.csv"};
    WorstCase density{"D", hts::accuracy::facet_density};
    WorstCase shadowing{"G_1 of Beckmann and GGX", hts::accuracy::facet_shadowing};
    WorstCase phong{"G_1 of Phong", hts::accuracy::phong_shadowing};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto facets = distribution(table(row, "shape"), table(row, "width"));
        const auto v = Direction::from_degrees(table(row, "theta_deg"), 30);
        const auto where = [&] { return table.describe(row, {"shape", "width", "theta_deg"}); };
        if (const double expected = table(row, "density"); expected > 1e-30 * facets.density({0, 0, 1})) {
            density.note(relative_error(facets.density(v.vector()), expected), where);
        }
        WorstCase& worst = facets.shape() == FacetShape::phong ? phong : shadowing;
        worst.note(relative_error(facets.shadowing(v), table(row, "smith")), where);
    }
    density.check();
    shadowing.check();
    phong.check();
}

TEST_CASE("facets: the rational G_1 is within the paper's 0.35 percent and no better") {
    const auto exact = FacetDistribution::beckmann(0.5);
    const auto rational = FacetDistribution::beckmann(0.5, SmithForm::rational);
    WorstCase worst{"rational G_1", hts::accuracy::rational_smith};
    double most = 0;
    for (double theta = 0.01; theta < 90; theta += 0.01) {
        const auto v = Direction::from_degrees(theta, 0);
        const double error = relative_error(rational.shadowing(v), exact.shadowing(v));
        most = std::max(most, error);
        worst.note(error, [&] { return "theta = " + std::to_string(theta); });
    }
    worst.check();
    CHECK(most > hts::accuracy::rational_smith / 4);
}

TEST_CASE("facets: the projected area of all normals and of the visible ones is that of the surface") {
    WorstCase all{"integral of D (m.n), from 1", 3.5e-15};
    WorstCase visible{"integral of the visible normals, from 1", 1.4e-7};
    for (const FacetDistribution& facets : examples()) {
        for (const double theta : {0.0, 80.0}) {
            const auto v = Direction::from_degrees(theta, 0);
            const auto area = [&](NormalDraw which) {
                return hts::testing::integral(
                    [&](double polar, double phi) {
                        return facets.normal_pdf(v, Direction::from_angles(polar, phi).vector(), which);
                    },
                    {0, pi / 2, -pi, pi}, {facets.alpha() * theta / 90, 0, facets.alpha()}, 1e-7);
            };
            for (const auto which : {NormalDraw::all, NormalDraw::widened}) {
                all.note(std::abs(area(which) - 1), [&] { return text(facets, theta, which); });
            }
            visible.note(std::abs(area(NormalDraw::visible) - 1),
                         [&] { return text(facets, theta, NormalDraw::visible); });
        }
    }
    all.check();
    visible.check();
}

TEST_CASE("facets: normals fall as their density says") {
    const std::size_t count = hts::testing::exhaustive() ? 2'000'000 : 40'000;
    WorstCase sums{"density and none, from 1, in standard errors", 4.5};
    double least = 1;
    int number = 0;
    Random random{81};
    for (const FacetDistribution& facets : examples()) {
        for (const auto which : {NormalDraw::visible, NormalDraw::all, NormalDraw::widened}) {
            for (const double theta : {0.0, 50.0, 88.0}) {
                if (which == NormalDraw::all && theta > 0) continue;  // the same at every angle
                if (++number % 4 != 0 && !hts::testing::exhaustive()) continue;
                const auto v = Direction::from_degrees(theta, 70);
                const double centre = 70 * pi / 180;
                const auto draw = [&] {
                    const double u0 = random.uniform(0, 1);
                    const Vector3 m = facets.normal(v, u0, random.uniform(0, 1), which);
                    return Draw{Angles{std::atan2(std::hypot(m.x, m.y), m.z),
                                       std::remainder(std::atan2(m.y, m.x) - centre, 2 * pi)}};
                };
                const auto density = [&](double polar, double phi) {
                    if (polar >= pi / 2) return 0.0;
                    return facets.normal_pdf(v, Direction::from_angles(polar, phi + centre).vector(), which);
                };
                const auto fit = hts::testing::fit_of(draw, density, count);
                INFO(text(facets, theta, which) << ", total " << fit.total);
                CHECK(fit.p_value > 1e-4);
                least = std::min(least, fit.p_value);
                sums.note(fit.deviation_of_sum(count), [&] { return text(facets, theta, which); });
            }
        }
    }
    std::cout << "normals: least p " << least << '\n';
    sums.check();
}

TEST_CASE("facets: Beckmann's visible slopes invert their distribution function") {
    // P(q) = (erfc(-q)/2 + t exp(-q^2)/(2 sqrt pi)) G_1 of the slope drawn is the uniform number
    Random random{82};
    WorstCase worst{"distribution function at the drawn slope", hts::accuracy::visible_draw};
    for (int i = 0; i < 20000; ++i) {
        const double alpha = random.logarithmic(1e-4, 5);
        const auto v = Direction::from_degrees(random.uniform(0.01, 89.99), 0);
        const double u = i % 3 == 0 ? 1 - random.logarithmic(1e-15, 1) : random.uniform(1e-15, 1);
        const auto facets = FacetDistribution::beckmann(alpha);
        const Vector3 m = facets.normal(v, u, 0.3, NormalDraw::visible);
        const double q = -m.x / m.z / alpha;
        const double t = alpha * v.sin_theta() / v.cos_theta();
        const double p = (std::erfc(-q) + t * std::exp(-q * q) / std::sqrt(pi)) / 2 * facets.shadowing(v);
        worst.note(std::abs(p - u), [&] { return text(facets, 0, NormalDraw::visible); });
    }
    worst.check();
}

TEST_CASE("facets: limits") {
    const auto normal = Direction::from_degrees(0, 0);
    const auto horizon = Direction::from_degrees(90, 0);
    for (const FacetDistribution& facets : examples()) {
        CHECK(facets.shadowing(normal) == 1);
        CHECK(facets.shadowing(horizon) == 0);
        CHECK(facets.density({0, 0, -1}) == 0);
        CHECK(facets.density({1, 0, 0}) == 0);
        CHECK(facets.density({0.2, 0.1, 0.5}) == Approx(facets.density({0.4, 0.2, 1})).epsilon(1e-14));
    }
    // a sphere's facets: Phong's exponent 0 is GGX of width 1
    CHECK(FacetDistribution::phong(0).density({0.3, 0, 0.4}) == Approx(1 / pi).epsilon(1e-14));
    CHECK(FacetDistribution::ggx(1).density({0.3, 0, 0.4}) == Approx(1 / pi).epsilon(1e-14));
    // alpha_p = 2/alpha_b^2 - 2: alike where narrow
    const double alpha = 0.01;
    CHECK(FacetDistribution::phong(2 / (alpha * alpha) - 2).density({0.01, 0, 1}) ==
          Approx(FacetDistribution::beckmann(alpha).density({0.01, 0, 1})).epsilon(1e-3));
    CHECK(FacetDistribution::phong(2 / (alpha * alpha) - 2).alpha() == Approx(alpha).epsilon(1e-12));
}

TEST_CASE("facets: no draw and no density is NaN anywhere") {
    Random random{83};
    const std::vector<double> ends{0, 0x1p-53, 0.5, 1 - 0x1p-53};
    for (int i = 0; i < 30000; ++i) {
        const double shape = random.one_of({0, 1, 2});
        const double width =
            shape == 1 ? random.one_of({0, 1e-3, 50, 1e12}) : random.one_of({1e-6, 1e-3, 1, 1e3});
        const auto facets = distribution(shape, width);
        const auto v = Direction::from_degrees(random.one_of({0, 1e-9, 40, 89, 90 - 1e-10, 90}), 20);
        const auto which = static_cast<NormalDraw>(random.one_of({0, 1, 2}));
        const Vector3 m = facets.normal(v, random.one_of(ends), random.one_of(ends), which);
        const double pdf = facets.normal_pdf(v, m, which);
        INFO(text(facets, std::acos(v.cos_theta()), which) << " m " << m.x << ' ' << m.y << ' ' << m.z);
        CHECK(dot(m, m) == Approx(1).epsilon(1e-14));
        CHECK(m.z >= 0);
        CHECK(pdf >= 0);
        CHECK(std::isfinite(pdf));
        CHECK(std::isfinite(facets.density(m)));
    }
}

TEST_CASE("facets: widths that cannot be are refused") {
    CHECK_THROWS_WITH(FacetDistribution::beckmann(0), "facet width alpha 0: must be from 1e-06 to 1000");
    CHECK_THROWS_WITH(FacetDistribution::ggx(-1), "facet width alpha -1: must be from 1e-06 to 1000");
    CHECK_THROWS_WITH(FacetDistribution::phong(-0.5), "Phong exponent -0.5: must be from 0 to 1e+12");
    CHECK_THROWS_AS(FacetDistribution::ggx(std::numeric_limits<double>::quiet_NaN()), hts::Error);
}
