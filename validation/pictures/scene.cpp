#include "validation/pictures/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;

/// 1 - cos of the half angle under which a sphere is seen from outside, without cancellation.
double cone(const Sphere& sphere, Vector3 from) {
    const Vector3 towards = sphere.centre() - from;
    const double sine2 = sphere.radius() * sphere.radius() / dot(towards, towards);
    return sine2 >= 1 ? 2 : sine2 / (1 + std::sqrt(1 - sine2));
}

LightSample sampled(const Sphere& sphere, Vector3 from, const std::array<double, 2>& u) {
    const double opening = cone(sphere, from);
    const Vector3 towards = normalised(sphere.centre() - from);
    const Vector3 aside = std::abs(towards.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
    const double cosine = 1 - opening * u[0], sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double azimuth = 2 * pi * u[1];
    const Vector3 direction = normalised(
        Frame::about(towards, aside).outward({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}));
    const auto met = sphere.meeting({from, direction});
    // a ray along the rim may miss by rounding: it then ends beside the centre
    const double distance = met ? met->distance : length(sphere.centre() - from) * cosine;
    return {direction, distance, 1 / (2 * pi * opening)};
}

double density(const Sphere& sphere, const Ray& ray, double /*distance*/) {
    return 1 / (2 * pi * cone(sphere, ray.origin));
}

double density(const Rectangle& rectangle, const Ray& ray, double distance) {
    const double cosine = -dot(rectangle.normal(), ray.direction);
    return cosine > 0 ? distance * distance / (cosine * rectangle.area()) : 0;
}

LightSample sampled(const Rectangle& rectangle, Vector3 from, const std::array<double, 2>& u) {
    const Vector3 towards = rectangle.point(u[0], u[1]) - from;
    const double distance = length(towards);
    const Ray ray{from, (1 / distance) * towards};
    return {ray.direction, distance, density(rectangle, ray, distance)};
}

}  // namespace

double AreaLight::distance(const Ray& ray) const noexcept {
    const auto met = std::visit([&](const auto& shape) { return shape.meeting(ray); }, shape_);
    if (!met || dot(met->frame.z, ray.direction) >= 0) return never;
    return met->distance;
}

LightSample AreaLight::sample(Vector3 from, const std::array<double, 2>& u) const noexcept {
    return std::visit([&](const auto& shape) { return sampled(shape, from, u); }, shape_);
}

double AreaLight::pdf(const Ray& ray, double distance) const noexcept {
    return std::visit([&](const auto& shape) { return density(shape, ray, distance); }, shape_);
}

Camera::Camera(Vector3 place, Vector3 looks_at, double field_of_view)
    : place_{place},
      right_{},
      up_{},
      forward_{normalised(looks_at - place)},
      extent_{2 * std::tan(field_of_view * pi / 360)} {
    if (!(field_of_view > 0 && field_of_view < 180)) {
        throw out_of_range("field of view", field_of_view, "deg", "> 0 and below 180 deg");
    }
    right_ = normalised(cross(forward_, {0, 0, 1}));
    up_ = cross(right_, forward_);
}

Ray Camera::ray(double x, double y, double height_over_width) const noexcept {
    const double across = extent_ * (x - 0.5), along = extent_ * (height_over_width / 2 - y);
    return {place_, normalised(forward_ + across * right_ + along * up_)};
}

Sight seen(const Scene& scene, const Ray& ray) noexcept {
    Sight first;
    first.meeting.distance = never;
    for (const Object& object : scene.objects) {
        const auto met = meeting(object.shape, ray);
        if (!met || met->distance >= first.meeting.distance) continue;
        first = {&object, nullptr, *met};
    }
    for (const AreaLight& light : scene.lights) {
        const double distance = light.distance(ray);
        if (distance >= first.meeting.distance) continue;
        first = {nullptr, &light, {distance, {}}};
    }
    return first;
}

bool is_free(const Scene& scene, const Ray& ray, double distance) noexcept {
    return std::none_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        const auto met = meeting(object.shape, ray);
        return met && met->distance < distance;
    });
}

}  // namespace hts::validation
