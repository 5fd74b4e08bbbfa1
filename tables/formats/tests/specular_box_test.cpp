#include "tables/formats/specular_box.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "materials.hpp"

using namespace hts;
using namespace hts::tables;

namespace {

const auto grid = spectral::WavelengthGrid::from_micrometres({0.45, 0.6});

/// A direction `apart` from the mirror direction, turned by `turn` about it.
Vector3 near_mirror(const Direction& in, double apart, double turn) {
    const Vector3 axis = in.mirror().vector();
    const Vector3 across{-in.mirror().sin_phi(), in.mirror().cos_phi(), 0};
    return std::cos(apart) * axis +
           std::sin(apart) * (std::cos(turn) * across + std::sin(turn) * cross(axis, across));
}

}  // namespace

TEST_CASE("the box returns the specular reflectance, within its solid angle alone") {
    const auto plain = testing::brdf_of("smooth-plastic.json", grid);
    constexpr double solid_angle = 0.05;
    const auto boxed = with_specular_box(plain, solid_angle);
    const double half_angle = std::acos(1 - solid_angle / (2 * std::numbers::pi));
    std::vector<double> with(2), without(2), mirror(2), sum(2);
    for (const double theta : {0., 30., 75.}) {
        const Direction in = Direction::from_degrees(theta, 20);
        plain.specular_reflectance(in, mirror);
        sum = {0, 0};
        constexpr int n = 100;  // midpoints in the cosine of the angle and in the turn
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double apart = std::acos(1 - (i + 0.5) / n * (1 - std::cos(half_angle)));
                const Direction out =
                    Direction::from_vector(near_mirror(in, apart, 2 * std::numbers::pi * (j + 0.5) / n));
                boxed.brdf({in, out}, with);
                plain.brdf({in, out}, without);
                for (std::size_t k = 0; k < 2; ++k)
                    sum[k] += (with[k] - without[k]) * out.cos_theta() * solid_angle / (n * n);
            }
        }
        for (std::size_t k = 0; k < 2; ++k) CHECK(sum[k] == Approx(mirror[k]).epsilon(1e-6));
        const Direction outside = Direction::from_vector(near_mirror(in, half_angle * 1.0001, 1));
        boxed.brdf({in, outside}, with);
        plain.brdf({in, outside}, without);
        CHECK(with == without);
        boxed.specular_reflectance(in, mirror);
        CHECK(mirror == std::vector<double>{0, 0});
    }
    CHECK_FALSE(boxed.properties().polarised);
}

TEST_CASE("the lobe of facets returns the specular reflectance, within its tilt alone") {
    const auto plain = testing::brdf_of("smooth-plastic.json", grid);
    constexpr double solid_angle = 0.01;
    const auto spread = with_specular_lobe(plain, solid_angle);
    const double tilt = specular_lobe_tilt(solid_angle);
    std::vector<double> with(2), without(2), mirror(2), sum(2);
    for (const double theta : {0., 30., 75.}) {
        const Direction in = Direction::from_degrees(theta, 20);
        plain.specular_reflectance(in, mirror);
        sum = {0, 0};
        constexpr int n = 200;  // midpoints in the cosine of the tilt and in its azimuth
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double angle = std::acos(1 - (i + 0.5) / n * (1 - std::cos(tilt)));
                const Vector3 m =
                    Direction::from_angles(angle, 2 * std::numbers::pi * (j + 0.5) / n).vector();
                const double facing = dot(in.vector(), m);
                const Direction out = Direction::from_vector(2 * facing * m - in.vector());
                spread.brdf({in, out}, with);
                plain.brdf({in, out}, without);
                const double solid_angle_of_view =
                    2 * std::numbers::pi * (1 - std::cos(tilt)) / (n * n) * 4 * facing;
                for (std::size_t k = 0; k < 2; ++k)
                    sum[k] += (with[k] - without[k]) * out.cos_theta() * solid_angle_of_view;
            }
        }
        for (std::size_t k = 0; k < 2; ++k) CHECK(sum[k] == Approx(mirror[k]).epsilon(1e-4));
        const Vector3 aside = Direction::from_angles(tilt * 1.0001, 1).vector();
        const Direction outside = Direction::from_vector(2 * dot(in.vector(), aside) * aside - in.vector());
        spread.brdf({in, outside}, with);
        plain.brdf({in, outside}, without);
        CHECK(with == without);
        spread.specular_reflectance(in, mirror);
        CHECK(mirror == std::vector<double>{0, 0});
    }
    // at the mirror direction of light along the normal it is as high as the box
    const Direction up = Direction::from_degrees(0, 0);
    with_specular_box(plain, 1e-4).brdf({up, up}, without);
    with_specular_lobe(plain, 1e-4).brdf({up, up}, with);
    CHECK(with[0] == Approx(without[0]).epsilon(1e-3));
    CHECK_THROWS_WITH(with_specular_lobe(plain, 0), Catch::Contains("from 1e-9 to 1 sr"));
}

TEST_CASE("a box of no size or of half the sphere is refused") {
    const auto plain = testing::brdf_of("smooth-plastic.json", grid);
    CHECK_THROWS_WITH(with_specular_box(plain, 0), Catch::Contains("solid angle of the specular box 0 sr"));
    CHECK_THROWS_WITH(with_specular_box(plain, 7), Catch::Contains("from 1e-9 to 1 sr"));
    CHECK_THROWS(with_specular_box(plain, std::nan("")));
}
