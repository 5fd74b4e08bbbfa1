#include "validation/scattering/rays/facet_tracing.hpp"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "comparison.hpp"

using namespace hts::validation;
using hts::Vector3;
using hts::testing::Random;
using Ray = FacetSurface::Ray;

namespace {

constexpr double pi = std::numbers::pi;

/// Grooves along y: 0 and `height` by turns at steps of 1.
FacetSurface grooves(double height) {
    RandomField field{1, 8, std::vector<double>(64), {}, {}};
    for (std::size_t i = 0; i < 64; ++i) field.height[i] = i % 2 == 0 ? 0 : height;
    return FacetSurface{field};
}

TracingSettings small() {
    TracingSettings settings;
    settings.surfaces = 4;
    settings.samples_per_tau = 8;
    settings.points = settings.rays = 2000;
    return settings;
}

}  // namespace

TEST_CASE("a ray meets the facet that it must, and none where it leaves") {
    const FacetSurface surface = grooves(1);
    for (const double y : {0.3, 3.7, -5.25}) {
        const auto hit = surface.first_hit({{0.25, y, 5}, {0, 0, -1}});
        REQUIRE(hit);
        CHECK(hit->point.z == Approx(0.25));
        CHECK(hit->normal.x == Approx(-1));
        CHECK(hit->normal.y == Approx(0).margin(1e-12));
        // over the ridge at x = 1, down to where z = x - 2 on the way to the one at 3
        const auto slanted = surface.first_hit({{-0.75, y, 1.8}, {1, 0, -0.25}});
        REQUIRE(slanted);
        CHECK(slanted->point.x == Approx(2.89));
        CHECK(slanted->point.z == Approx(0.89));
    }
    CHECK_FALSE(surface.first_hit({{0.2, 0.1, 0.2}, {0, 0, 1}}));
    CHECK_FALSE(surface.first_hit({{0.2, 0.1, 2}, {1, 0, 0}}));
    CHECK(surface.first_hit({{0.2, 0.1, 0.2}, {1, 0.01, 0}}));
    CHECK(surface.at(0.25, 0.5).point.z == Approx(0.25));
}

TEST_CASE("rays meet random surfaces where a fine search along them does") {
    const FacetSurface surface{random_field({0.4, 1}, 0.125, 64, 5)};
    Random random{11};
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const double azimuth = random.uniform(0, 2 * pi), down = random.uniform(-1.2, 0.3);
        const Ray ray{{random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(0.2, 2)},
                      {std::cos(azimuth), std::sin(azimuth), down}};
        if (ray.origin.z <= surface.at(ray.origin.x, ray.origin.y).point.z) continue;
        double searched = -1;
        for (double t = 0; t < 25 && searched < 0; t += 1e-3) {
            const Vector3 at = ray.origin + t * ray.direction;
            if (at.z < surface.at(at.x, at.y).point.z) searched = t;
        }
        const auto hit = surface.first_hit(ray);
        const Vector3 way = hit ? hit->point - ray.origin : Vector3{0, 0, 0};
        const double met = std::sqrt(dot(way, way) / dot(ray.direction, ray.direction));
        CHECK((hit && met < 25) == (searched >= 0));
        if (!hit || searched < 0) continue;
        ++hits;
        CHECK(met == Approx(searched).margin(1.1e-3));
        CHECK(hit->point.z == Approx(surface.at(hit->point.x, hit->point.y).point.z).margin(1e-9));
    }
    CHECK(hits > 150);
}

TEST_CASE("gently rough mirrors send all light on after one reflection, steep ones not") {
    const TracedLight gentle = traced_light(0.02, 30, small());
    CHECK(gentle.bounces.once == 1);
    CHECK(gentle.bounces.he_torrance == Approx(1).epsilon(3e-3));
    const TracedLight steep = traced_light(1, 0, small());
    CHECK(steep.bounces.once < 0.3);
    CHECK(steep.bounces.once + steep.bounces.more == Approx(1).epsilon(1e-12));
    CHECK(steep.bounces.lost == 0);
    // the lobe of gentle slopes is Beckmann's, which both closed forms then are
    double traced = 0, model = 0;
    for (const LobePoint& point : gentle.lobe) {
        traced += point.traced;
        model += point.he_torrance;
        CHECK(point.smith == Approx(point.he_torrance).epsilon(1e-3).margin(1e-6));
    }
    CHECK(traced == Approx(model).epsilon(0.05));
}

TEST_CASE("what is lit of explicit surfaces is what a search for the horizon along profiles finds") {
    for (const auto& [slope, degrees] : {std::pair{0.25, 60.0}, {0.1, 85.0}}) {
        const double rise = 1 / std::tan(degrees * pi / 180);
        double lit = 0, all = 0;
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            const RandomProfile profile = random_profile({slope, 1}, 1.0 / 32, 32768, seed);
            const std::size_t n = profile.height.size();
            double horizon = -1e9;  // highest yet, above a line that rises towards the light
            for (std::size_t i = 0; i < 2 * n; ++i) {
                const double height = profile.height[i % n] + rise * static_cast<double>(i) / 32;
                if (i >= n) {
                    lit += height >= horizon ? 1 : 0;
                    ++all;
                }
                horizon = std::fmax(horizon, height);
            }
        }
        TracingSettings settings = small();
        settings.samples_per_tau = 12;
        const ShadowingPoint traced = shadowing_points(slope, {degrees}, settings)[0];
        std::printf("lit, sigma0/tau %.2f, %.0f deg: rays %.4f +- %.4f, profiles %.4f, Smith %.4f\n", slope,
                    degrees, traced.lit, traced.lit_error, lit / all, traced.smith);
        CHECK(traced.lit == Approx(lit / all).margin(4 * traced.lit_error + 0.005));
    }
}

TEST_CASE("what is lit of explicit surfaces is nearly Smith's share, whatever the number of threads") {
    const std::vector<double> angles{45, 60};
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const auto one = shadowing_points(0.25, angles, small());
    omp_set_num_threads(3);
    const auto three = shadowing_points(0.25, angles, small());
    omp_set_num_threads(threads);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        CHECK(one[i].lit == three[i].lit);
        CHECK(one[i].lit_error == three[i].lit_error);
        CHECK(one[i].lit == Approx(one[i].smith).margin(0.02 + 3 * one[i].lit_error));
        CHECK(one[i].lit_and_seen <= one[i].lit);
    }
}
