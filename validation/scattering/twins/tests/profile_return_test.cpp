#include "validation/scattering/twins/profile_return.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "comparison.hpp"
#include "hts/shadowing.hpp"

using boost::math::quadrature::gauss_kronrod;
using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi;

/// cos theta (1 + Lambda)
double seen(const hts::Surface& surface, double theta) {
    const auto direction = hts::Direction::from_angles(std::fabs(theta), 0);
    return direction.cos_theta() + visibility(surface, direction).masked;
}

}  // namespace

TEST_CASE("with m the facets of a mirror return all light, by a quadrature over angles of its own") {
    hts::testing::WorstCase worst{"light returned by a profile of mirrors", 1e-5};
    for (const double slope : {0.05, 0.1, 0.25, 0.4, 0.5}) {
        const hts::Surface surface{slope, 1};
        const ProfileReturn m{{slope, 1}};
        for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0}) {
            const double theta = degrees * pi / 180, alpha = 2 * slope;
            const auto lobe = [&](double out) {
                const double p = std::tan((out - theta) / 2) / alpha;
                const double density = std::exp(-p * p) / (std::sqrt(pi) * alpha);
                // 1/(1 + Lambda_i + Lambda_r), each Lambda masked/cos theta
                const double ci = std::cos(theta), cr = std::cos(out);
                const double shadowing =
                    ci * cr / (seen(surface, theta) * cr + (seen(surface, out) - cr) * ci);
                return facet_lobe(density, theta, out) * shadowing * m(theta) * m(out);
            };
            double returned = 0;  // in pieces, since the lobe may be narrow
            for (int piece = 0; piece < 36; ++piece)
                returned += gauss_kronrod<double, 31>::integrate(lobe, (piece - 18) * pi / 36 + 1e-12,
                                                                 (piece - 17) * pi / 36 - 1e-12, 4, 1e-10);
            worst.note(std::fabs(returned - 1), [=] {
                return "slope " + std::to_string(slope) + ", " + std::to_string(degrees) + " deg";
            });
        }
        CHECK(m.single() > 0.5);
        CHECK(m.single() <= 1 + 1e-9);
    }
    worst.check();
}

TEST_CASE("m of a plane is 1, and nothing is reflected twice by it") {
    const ProfileReturn plane{{0, 1}};
    CHECK(plane(0.7) == 1);
    CHECK(plane.single() == 1);
    CHECK(ProfileReturn{{0.02, 1}}(0.3) == Approx(1).epsilon(1e-5));
}
