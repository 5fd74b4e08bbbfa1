// The adaptive albedo against closed forms, and against plain Gauss rules on fixed
// panels in the outgoing angles.
#include "hts/microfacet/albedo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/microfacet/ashikhmin.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/ward.hpp"

using namespace hts;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double bound = accuracy::directional_albedo;

/// Ends of panels between two values that double in width away from a place.
std::vector<double> ends(double from, double to, const std::vector<double>& places, double finest) {
    std::vector<double> result{from, to};
    for (const double place : places) {
        for (double step = 0; step<to - from; step = step> 0 ? 1.7 * step : finest) {
            for (const double end : {place - step, place + step}) {
                if (end > from && end < to) result.push_back(end);
            }
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

template <class Function>
double panels(const std::vector<double>& ends, Function&& f) {
    double sum = 0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i] - ends[i - 1] > 1e-14)
            sum += boost::math::quadrature::gauss<double, 20>::integrate(f, ends[i - 1], ends[i]);
    }
    return sum;
}

/// Ends of equal panels.
std::vector<double> equal_ends(double from, double to, int count) {
    std::vector<double> result;
    for (int i = 0; i <= count; ++i) result.push_back(from + (to - from) * i / count);
    return result;
}

/// The plain way, light from azimuth 0.
template <class Model>
double plain_albedo(const Model& model, double theta_in, const std::vector<double>& rings,
                    const std::vector<double>& azimuths) {
    const Direction in = Direction::from_angles(theta_in, 0);
    return panels(rings, [&](double theta) {
        return std::sin(theta) * std::cos(theta) * panels(azimuths, [&](double phi) {
                   return model.brdf(in, Direction::from_angles(theta, phi));
               });
    });
}

/// Panels that crowd at the mirror direction and the horizon.
template <class Model>
double crowded_albedo(const Model& model, double theta_in) {
    constexpr double finest = 1e-3;
    return plain_albedo(model, theta_in, ends(0, pi / 2, {theta_in, pi / 2}, finest),
                        ends(0, 2 * pi, {pi / 2, pi, 3 * pi / 2}, finest));
}

/// A Kurt lobe of one width at normal incidence by its one-dimensional integral over
/// theta_h, theta_out = 2 theta_h.
double normal_albedo(double m, double alpha) {
    boost::math::quadrature::tanh_sinh<double> quadrature;
    const auto f = [&](double theta) {
        const double cosine = std::cos(theta), slope = std::tan(theta) / m;
        const double density = std::exp(-slope * slope) / (pi * m * m * std::pow(cosine, 4));
        return 2 * pi * density * std::pow(std::max(0.0, std::cos(2 * theta)), 1 - alpha) * std::sin(theta);
    };
    const double cut = std::min(pi / 4, 8 * m);
    return quadrature.integrate(f, 0.0, cut) + (cut < pi / 4 ? quadrature.integrate(f, cut, pi / 4) : 0);
}

}  // namespace

TEST_CASE("albedo of models that have it in closed form") {
    WorstCase worst{"directional albedo, closed forms", bound};
    for (const double degrees : {0.0, 30.0, 75.0, 89.0, 89.99}) {
        const Direction in = Direction::from_degrees(degrees, 40);
        worst.note(relative_error(directional_albedo(LambertianModel{0.3}, in), 0.3),
                   [&] { return "Lambert at " + shortest(degrees) + " deg"; });
    }
    const Direction normal = Direction::from_degrees(0, 0);
    for (const double n : {0.0, 1.0, 10.0, 1e3, 1e5, 1e7}) {
        worst.note(relative_error(directional_albedo(BlinnPhong{0, {{1, BlinnPhongLobe{n}}}}, normal), 1),
                   [n] { return "Blinn-Phong, n = " + shortest(n); });
        worst.note(
            relative_error(directional_albedo(Lafortune{0, {{1, LafortuneLobe{-1, -1, n}}}}, normal), 1),
            [n] { return "Lafortune, n = " + shortest(n); });
    }
    for (const double m : {1e-4, 0.01, 0.1, 0.5, 2.0}) {
        for (const double alpha : {0.0, 0.5, 1.0}) {
            const Kurt model{0, {{1, {1, m, m, alpha}}}};
            worst.note(relative_error(directional_albedo(model, normal), normal_albedo(m, alpha)),
                       [m, alpha] { return "Kurt, m = " + shortest(m) + ", alpha = " + shortest(alpha); });
        }
    }
    worst.check();
}

TEST_CASE("albedo against plain quadrature in the outgoing angles") {
    WorstCase worst{"directional albedo, plain quadrature", bound};
    const auto note = [&](const std::string& name, const auto& model, double degrees) {
        const double theta = degrees * pi / 180;
        worst.note(relative_error(directional_albedo(model, Direction::from_angles(theta, 0)),
                                  crowded_albedo(model, theta)),
                   [&] { return name + " at " + shortest(degrees) + " deg"; });
    };
    for (const double degrees : {35.0, 70.0, 85.0}) {
        note("Kurt", Kurt{0.2, {{0.5, {0.3, 0.1, 0.4, 0.2}}}}, degrees);
        note("Ward", Ward{0, {{1, {0.3, 0.3}}}}, degrees);
        note("Ashikhmin-Shirley", AshikhminShirley{0.5, {0.1, 20, 200}}, degrees);
        note("Lafortune, back to the light", Lafortune{0, {{1, {0.7, 0.9, 40}}}}, degrees);
        note("Oren-Nayar", OrenNayar{1, 0.5}, degrees);
    }
    worst.check();
}

TEST_CASE("albedo where the BRDF has kinks anywhere") {
    WorstCase worst{"directional albedo, Cook and Torrance's grooves", bound};
    const CookTorrance model{0, {{1, {0.9, 0.3}}}};
    for (const double degrees : {35.0, 65.0}) {
        const double theta = degrees * pi / 180;
        const double plain =
            plain_albedo(model, theta, equal_ends(0, pi / 2, 79), equal_ends(0, 2 * pi, 314));
        worst.note(relative_error(directional_albedo(model, Direction::from_angles(theta, 0)), plain),
                   [&] { return shortest(degrees) + " deg"; });
    }
    worst.check();
}

TEST_CASE("an albedo is as near as was asked for") {
    const AshikhminBrdf brushed{
        AshikhminFacets{NormalDensity::gaussian(0.1, std::numeric_limits<double>::infinity())},
        FacetFresnel::schlick(0.1), 0.2};
    const auto note = [](WorstCase& worst, const auto& model, double tolerance, double finest) {
        for (const double degrees : {0.0, 30.0, 75.0}) {
            const Direction in = Direction::from_degrees(degrees, 10);
            worst.note(relative_error(directional_albedo(model, in, Tolerance{tolerance}),
                                      directional_albedo(model, in, Tolerance{finest})),
                       [&] { return shortest(degrees) + " deg"; });
        }
    };
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        WorstCase worst{"directional albedo to " + shortest(tolerance), tolerance};
        note(worst, Kurt{0.2, {{0.5, {0.3, 0.1, 0.4, 0.2}}}}, tolerance, 1e-12);
        note(worst, Ward{0, {{1, {0.3, 0.3}}}}, tolerance, 1e-12);
        note(worst, Lafortune{0, {{1, {0.7, 0.9, 40}}}}, tolerance, 1e-12);
        note(worst, CookTorrance{0, {{1, {0.9, 0.3}}}}, tolerance, 1e-12);
        note(worst, brushed, tolerance, 1e-6);  // interpolates: kinks along every line of a table
        worst.check();
    }
}

TEST_CASE("narrow lobes are not missed") {
    // Facets of vanishing slope are a mirror, whatever the azimuth; the shadowing of grooves is 1 then.
    for (const double m : {1e-2, 1e-4, 1e-6}) {
        for (const double degrees : {0.0, 20.0, 60.0, 80.0}) {
            const Direction in = Direction::from_degrees(degrees, 33);
            INFO("m " << m << ", " << degrees << " deg");
            const double tolerance = 3 * m * m / (in.cos_theta() * in.cos_theta()) + 2 * bound;
            CHECK(std::abs(directional_albedo(CookTorrance{0, {{1, {1, m}}}}, in) - 1) < tolerance);
            const Kurt anisotropic{0, {{1, {1, m, 30 * m, 0.5}}}};
            const double wide = 30 * m / in.cos_theta();
            CHECK(std::abs(directional_albedo(anisotropic, in) - 1) < wide * wide + 2 * bound);
        }
    }
}

TEST_CASE("on the horizon the albedo is 0, and a BRDF of 0 has none") {
    CHECK(directional_albedo(LambertianModel{1}, Direction::from_degrees(90, 0)) == 0);
    CHECK(directional_albedo(LambertianModel{0}, Direction::from_degrees(30, 0)) == 0);
}
