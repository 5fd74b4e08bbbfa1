#include "validation/scattering/twins/profile_twin.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "validation/scattering/profile_scattering.hpp"

using boost::math::quadrature::gauss_kronrod;
using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;

constexpr std::array models{TwinModel::he,
                            TwinModel::he_unified,
                            TwinModel::he_unified_mixing,
                            TwinModel::he_first_order,
                            TwinModel::he_rough_limit,
                            TwinModel::kirchhoff,
                            TwinModel::smith,
                            TwinModel::ssa1,
                            TwinModel::beckmann,
                            TwinModel::ggx};

/// All that a model scatters.
ProfileLobe total(const ProfileTwin& twin, double theta_i) {
    ProfileLobe sum{0, 0};
    for (int piece = 0; piece < 36; ++piece) {
        const double from = (piece - 18) * pi / 36 + 1e-9, to = (piece - 17) * pi / 36 - 1e-9;
        const auto of = [&](double ProfileLobe::*part) {
            return gauss_kronrod<double, 31>::integrate(
                [&](double out) { return twin.lobe(theta_i, out).*part; }, from, to, 3, 1e-9);
        };
        sum.te += of(&ProfileLobe::te);
        sum.tm += of(&ProfileLobe::tm);
    }
    return sum;
}

}  // namespace

TEST_CASE("every twin is reciprocal in TE and in TM, on conductors and on glass") {
    for (const auto& index : {hts::perfect_conductor(), hts::RefractiveIndex{1.5, 0}}) {
        for (const TwinModel model : models) {
            INFO(name(model));
            const ProfileTwin twin{model, {0.25, 1}, index, 0.4};
            for (const auto& [one, other] : {std::pair{0.5, 1.1}, {0.2, 0.9}, {1.2, 0.05}}) {
                const ProfileLobe a = twin.lobe(one, other), b = twin.lobe(other, one);
                CHECK(a.te * std::cos(one) == Approx(b.te * std::cos(other)).epsilon(1e-10));
                CHECK(a.tm * std::cos(one) == Approx(b.tm * std::cos(other)).epsilon(1e-10));
                CHECK(a.te > 0);
            }
        }
    }
}

TEST_CASE("what a smooth conductor scatters by he_unified is what its mirror loses to second order") {
    const RoughnessStatistics smooth{2e-4, 0.7};
    const ProfileTwin twin{TwinModel::he_unified, smooth, hts::perfect_conductor()};
    for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
        INFO(degrees);
        const ProfileLobe scattered = total(twin, degrees * degree),
                          mirror = second_order_mirror(smooth, degrees * degree);
        CHECK(scattered.te == Approx(1 - mirror.te).epsilon(2e-3));
        CHECK(scattered.tm == Approx(1 - mirror.tm).epsilon(5e-3));
    }
}

TEST_CASE("he_unified is He-Torrance on gentle profiles, and SSA-1 on smooth ones") {
    const RoughnessStatistics gentle{0.3, 30}, smooth{2e-4, 0.7};
    const ProfileTwin he{TwinModel::he, gentle, {1.5, 0}}, unified{TwinModel::he_unified, gentle, {1.5, 0}};
    for (const auto& [in, away] : {std::pair{10, -1}, {30, 1}, {50, 2}}) {
        const ProfileLobe a = he.lobe(in * degree, (in + away) * degree),
                          b = unified.lobe(in * degree, (in + away) * degree);
        CHECK(a.te == Approx(b.te).epsilon(1e-3));
        CHECK(a.tm == Approx(b.tm).epsilon(1e-3));
    }
    const ProfileTwin ssa{TwinModel::ssa1, smooth, {1.5, 0}}, first{TwinModel::he_unified, smooth, {1.5, 0}};
    CHECK(ssa.lobe(0.5, 1.0).te == Approx(first.lobe(0.5, 1.0).te).epsilon(1e-4));
    CHECK(ssa.lobe(0.5, -1.0).tm == Approx(first.lobe(0.5, -1.0).tm).epsilon(1e-4));
}

TEST_CASE(
    "Kirchhoff's lobe of a rough profile is that of facets, and facets return all light along the normal") {
    const RoughnessStatistics rough{20, 200};
    const ProfileTwin kirchhoff{TwinModel::kirchhoff, rough, hts::perfect_conductor()},
        limit{TwinModel::he_rough_limit, rough, hts::perfect_conductor()},
        facets{TwinModel::beckmann, rough, hts::perfect_conductor(), 0.2};
    for (const double out : {-0.1, 0.0, 0.15, 0.3}) {
        CHECK(facets.lobe(0, out).te == Approx(kirchhoff.lobe(0, out).te).epsilon(2e-3));
        CHECK(facets.lobe(0, out).te == Approx(limit.lobe(0, out).te).epsilon(2e-3));
    }
    CHECK(total(facets, 0).te == Approx(1).epsilon(1e-3));
    CHECK(total({TwinModel::ggx, rough, hts::perfect_conductor(), 0.05}, 0).te == Approx(1).epsilon(0.02));
}

TEST_CASE("mixing exchanges polarisations and leaves their sum") {
    const RoughnessStatistics steep{0.5, 1};
    const ProfileTwin plain{TwinModel::he_unified, steep, {1.5, 0}},
        mixed{TwinModel::he_unified_mixing, steep, {1.5, 0}};
    const ProfileLobe a = plain.lobe(0.9, 0.9), b = mixed.lobe(0.9, 0.9);
    CHECK(b.te + b.tm == Approx(a.te + a.tm));
    CHECK(b.tm == Approx(0.95 * a.tm + 0.05 * a.te));
}
