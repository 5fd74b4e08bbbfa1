#include "validation/pictures/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "comparison.hpp"

using namespace hts::validation;
using hts::Vector3;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

Vector3 random_point(Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Ray random_ray(Random& random) {
    const Vector3 from = random_point(random, 4);
    return {from, normalised(random_point(random, 1) - from)};
}

double off(Vector3 a, Vector3 b) {
    return length(a - b);
}

/// How far a frame is from three unit vectors at right angles, right-handed.
double crookedness(const Frame& frame) {
    return off(cross(frame.x, frame.y), frame.z) + std::abs(dot(frame.x, frame.y)) +
           std::abs(length(frame.x) - 1) + std::abs(length(frame.z) - 1);
}

}  // namespace

TEST_CASE("rays meet shapes where closed forms say") {
    const Sphere sphere{{1, 2, 3}, 2};
    const auto met = sphere.meeting({{1, -8, 3}, {0, 1, 0}});
    REQUIRE(met);
    CHECK(met->distance == Approx(8).margin(1e-14));
    CHECK(off(met->frame.z, {0, -1, 0}) < 1e-14);
    CHECK(off(met->frame.x, {1, 0, 0}) < 1e-14);  // east
    CHECK(off(met->frame.y, {0, 0, 1}) < 1e-14);  // north
    CHECK_FALSE(sphere.meeting({{1, -8, 3}, {0, -1, 0}}));
    CHECK_FALSE(sphere.meeting({{3.0001, -8, 3}, {0, 1, 0}}));

    const Cylinder cylinder{{0, 0, 1}, 0.5, 2};
    CHECK(cylinder.meeting({{-3, 0, 2}, {1, 0, 0}})->distance == Approx(2.5).margin(1e-14));
    const auto on_top = cylinder.meeting({{0.3, 0.3, 9}, {0, 0, -1}});
    CHECK(on_top->distance == Approx(6).margin(1e-14));
    CHECK(off(on_top->frame.z, {0, 0, 1}) == 0);
    CHECK(off(cylinder.meeting({{0.3, 0.3, -9}, {0, 0, 1}})->frame.z, {0, 0, -1}) == 0);
    CHECK_FALSE(cylinder.meeting({{-3, 0, 3.001}, {1, 0, 0}}));

    const Box box{{0, 0, 0}, {2, 2, 2}, std::numbers::pi / 4};  // a corner towards the ray
    const auto corner = box.meeting({{-5, 1e-3, 1}, {1, 0, 0}});
    CHECK(corner->distance == Approx(5 - std::sqrt(2) + 1e-3).margin(1e-12));
    CHECK(std::abs(dot(corner->frame.z, {1, 0, 0})) == Approx(std::sqrt(0.5)));

    const Rectangle rectangle{{0, 0, 1}, {3, 0, 0}, {0, 2, 0}};
    const auto inside = rectangle.meeting({{1, 1, 5}, {0, 0, -1}});
    CHECK(inside->distance == Approx(4).margin(1e-14));
    CHECK(off(inside->frame.z, {0, 0, 1}) < 1e-15);
    CHECK_FALSE(rectangle.meeting({{3.01, 1, 5}, {0, 0, -1}}));
    CHECK_FALSE(rectangle.meeting({{1, 1, 5}, {1, 0, 0}}));
}

TEST_CASE("rays that leave a surface do not meet it again") {
    const Shape shapes[]{Sphere{{0.1, 0.2, 0.3}, 1}, Cylinder{{0, 0, -1}, 0.7, 2},
                         Box{{0, 0, -1}, {1, 1.5, 2}, 0.3}};
    Random random{1};
    std::size_t met_once = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray = random_ray(random);
        for (const Shape& shape : shapes) {
            const auto met = meeting(shape, ray);
            if (!met || dot(met->frame.z, ray.direction) > -0.01) continue;
            ++met_once;
            const Vector3 away =
                normalised(ray.direction - 2 * dot(ray.direction, met->frame.z) * met->frame.z);
            CHECK_FALSE(meeting(shape, {ray.at(met->distance), away}));
        }
    }
    CHECK(met_once > 300);
}

TEST_CASE("points that rays meet lie on the shape, with a frame at right angles") {
    const Vector3 centre{0.2, -0.1, 0.3};
    const std::vector<Fold> folds{{0.2, 3, 1, 0.5}, {0.1, -2, 4, 1}};
    const Sphere sphere{centre, 1.2};
    const Cloth cloth{centre, 2, folds};
    WorstCase on_sphere{"distance from a sphere", 2e-14},
        on_cloth{"height above a cloth", hts::accuracy::cloth_height}, frames{"frame of a meeting", 2e-15};
    Random random{2};
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = random_ray(random);
        const auto where = [&] { return "ray " + std::to_string(i); };
        if (const auto met = sphere.meeting(ray)) {
            on_sphere.note(std::abs(length(ray.at(met->distance) - centre) - 1.2), where);
            frames.note(crookedness(met->frame), where);
        }
        if (const auto met = cloth.meeting(ray)) {
            const Vector3 point = ray.at(met->distance);
            on_cloth.note(std::abs(point.z - centre.z - cloth.height(point.x - centre.x, point.y - centre.y)),
                          where);
            frames.note(crookedness(met->frame), where);
        }
    }
    on_sphere.check();
    on_cloth.check();
    frames.check();
}

TEST_CASE("a ray meets the first fold of a cloth, and its normal is that of the height") {
    const Cloth cloth{{0, 0, 0}, 3, {{0.3, 2, 0, 0}, {0.2, 0, 3, 0.7}}};
    Random random{3};
    for (int i = 0; i < 300; ++i) {
        const Vector3 from{random.uniform(-2, 2), random.uniform(-2, 2), 1.5};
        const Ray ray{from, normalised({random.uniform(-1, 1), random.uniform(-1, 1), -1})};
        const auto met = cloth.meeting(ray);
        if (!met) continue;
        double first = 0;  // the same by small steps
        const auto above = [&](double distance) {
            const Vector3 point = ray.at(distance);
            return point.z - cloth.height(point.x, point.y);
        };
        while (above(first) > 0) first += 1e-3;
        CHECK(met->distance == Approx(first).margin(2e-3));
        const Vector3 point = ray.at(met->distance);
        const auto slope = [&](double dx, double dy) {
            return (cloth.height(point.x + dx, point.y + dy) - cloth.height(point.x - dx, point.y - dy)) /
                   2e-5;
        };
        CHECK(off(met->frame.z, normalised({-slope(1e-5, 0), -slope(0, 1e-5), 1})) < 1e-8);
    }
}

TEST_CASE("impossible shapes are refused by name") {
    CHECK_THROWS_WITH((Sphere{{0, 0, 0}, 0}), "radius of a sphere 0: must be > 0 and finite");
    CHECK_THROWS_WITH((Cylinder{{0, 0, 0}, 1, -1}), "height of a cylinder -1: must be > 0 and finite");
    CHECK_THROWS_WITH((Box{{0, 0, 0}, {1, 0, 1}, 0}), "edge of a box 0: must be > 0 and finite");
    CHECK_THROWS_WITH((Rectangle{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), Catch::Contains("edges at right angles"));
    CHECK_THROWS_WITH((Cloth{{0, 0, 0}, std::nan(""), {}}), Catch::Contains("half the edge of a cloth"));
}
