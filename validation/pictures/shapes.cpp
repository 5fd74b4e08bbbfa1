#include "validation/pictures/shapes.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "hts/error.hpp"

namespace hts::validation {
namespace {

constexpr Vector3 up{0, 0, 1};

double checked_length(const char* quantity, double value) {
    if (!(value > 0 && std::isfinite(value))) throw out_of_range(quantity, value, "", "> 0 and finite");
    return value;
}

/// East of a point seen from an upright axis; x at the pole.
Vector3 east(Vector3 normal) {
    const Vector3 along = cross(up, normal);
    return dot(along, along) > 1e-24 ? along : Vector3{1, 0, 0};
}

/// The smaller root of a t^2 + 2 b t + c = 0 from shortest_distance on, infinity if there is none.
double first_root(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0 && a > 0)) return never;
    const double q = -b - std::copysign(std::sqrt(discriminant), b);
    const auto [near, far] = std::minmax({q / a, q == 0 ? 0.0 : c / q});
    if (near >= shortest_distance) return near;
    return far >= shortest_distance ? far : never;  // NOLINT(bugprone-narrowing-conversions): all are double
}

/// Two planes at +-half: where the ray enters and leaves, and through which it enters.
struct Slab {
    double enter, leave;
};

Slab slab(double origin, double direction, double half) {
    if (direction == 0) return std::abs(origin) <= half ? Slab{-never, never} : Slab{never, -never};
    const double a = (-half - origin) / direction, b = (half - origin) / direction;
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Sphere::Sphere(Vector3 centre, double radius)
    : centre_{centre}, radius_{checked_length("radius of a sphere", radius)} {}

std::optional<Meeting> Sphere::meeting(const Ray& ray) const noexcept {
    const Vector3 from = ray.origin - centre_;
    const double distance = first_root(1, dot(from, ray.direction), dot(from, from) - radius_ * radius_);
    if (distance == never) return std::nullopt;
    const Vector3 normal = normalised(ray.at(distance) - centre_);
    return Meeting{distance, Frame::about(normal, east(normal))};
}

Cylinder::Cylinder(Vector3 base, double radius, double height)
    : base_{base},
      radius_{checked_length("radius of a cylinder", radius)},
      height_{checked_length("height of a cylinder", height)} {}

std::optional<Meeting> Cylinder::side(const Ray& ray) const noexcept {
    const Vector3 from = ray.origin - base_;
    const auto [dx, dy, dz] = ray.direction;
    const double distance = first_root(dx * dx + dy * dy, from.x * dx + from.y * dy,
                                       from.x * from.x + from.y * from.y - radius_ * radius_);
    if (distance == never) return std::nullopt;
    const Vector3 point = from + distance * ray.direction;
    if (point.z < 0 || point.z > height_) return std::nullopt;
    const Vector3 normal = normalised({point.x, point.y, 0});
    return Meeting{distance, Frame::about(normal, east(normal))};
}

std::optional<Meeting> Cylinder::lid(const Ray& ray, double height, double towards) const noexcept {
    const double distance = (base_.z + height - ray.origin.z) / ray.direction.z;
    if (!(distance >= shortest_distance && distance < never)) return std::nullopt;
    const Vector3 point = ray.at(distance) - base_;
    if (point.x * point.x + point.y * point.y > radius_ * radius_) return std::nullopt;
    return Meeting{distance, Frame::about(towards * up, {1, 0, 0})};
}

std::optional<Meeting> Cylinder::meeting(const Ray& ray) const noexcept {
    std::optional<Meeting> first = side(ray);
    for (const auto& other : {lid(ray, height_, 1), lid(ray, 0, -1)}) {
        if (other && (!first || other->distance < first->distance)) first = other;
    }
    return first;
}

Box::Box(Vector3 base, Vector3 edges, double turn)
    : centre_{base + Vector3{0, 0, edges.z / 2}},
      half_{0.5 * edges},
      frame_{Frame::about(up, {1, 0, 0}).turned(turn)} {
    for (const double edge : {edges.x, edges.y, edges.z}) checked_length("edge of a box", edge);
}

std::optional<Meeting> Box::meeting(const Ray& ray) const noexcept {
    const Vector3 from = frame_.inward(ray.origin - centre_), along = frame_.inward(ray.direction);
    const std::array slabs{slab(from.x, along.x, half_.x), slab(from.y, along.y, half_.y),
                           slab(from.z, along.z, half_.z)};
    const std::array axes{(along.x < 0 ? 1.0 : -1.0) * frame_.x, (along.y < 0 ? 1.0 : -1.0) * frame_.y,
                          (along.z < 0 ? 1.0 : -1.0) * frame_.z};
    const auto last = std::max_element(slabs.begin(), slabs.end(),
                                       [](const Slab& a, const Slab& b) { return a.enter < b.enter; });
    const auto leave = std::min_element(slabs.begin(), slabs.end(), [](const Slab& a, const Slab& b) {
                           return a.leave < b.leave;
                       })->leave;
    if (!(last->enter >= shortest_distance && last->enter <= leave)) return std::nullopt;
    const Vector3 normal = axes[static_cast<std::size_t>(last - slabs.begin())];
    const Vector3 about = cross(up, normal);
    return Meeting{last->enter, Frame::about(normal, dot(about, about) > 0.5 ? about : frame_.x)};
}

Rectangle::Rectangle(Vector3 corner, Vector3 first_edge, Vector3 second_edge)
    : corner_{corner},
      frame_{},
      first_length_{checked_length("edge of a rectangle", length(first_edge))},
      second_length_{checked_length("edge of a rectangle", length(second_edge))} {
    const double cosine = dot(first_edge, second_edge) / (first_length_ * second_length_);
    if (std::abs(cosine) > 1e-9) {
        throw out_of_range("cosine between the edges of a rectangle", cosine, "", "0: edges at right angles");
    }
    frame_ = Frame::about(normalised(cross(first_edge, second_edge)), first_edge);
}

std::optional<Meeting> Rectangle::meeting(const Ray& ray) const noexcept {
    const double distance = dot(corner_ - ray.origin, frame_.z) / dot(ray.direction, frame_.z);
    if (!(distance >= shortest_distance && distance < never)) return std::nullopt;
    const auto [u, v] = coordinates(ray.at(distance));
    if (u < 0 || u > 1 || v < 0 || v > 1) return std::nullopt;
    return Meeting{distance, frame_};
}

Cloth::Cloth(Vector3 centre, double half_edge, std::vector<Fold> folds)
    : centre_{centre},
      half_edge_{checked_length("half the edge of a cloth", half_edge)},
      folds_{std::move(folds)} {
    for (const auto& [amplitude, kx, ky, phase] : folds_) {
        steepest_ += std::abs(amplitude) * std::hypot(kx, ky);
        highest_ += std::abs(amplitude);
    }
}

double Cloth::height(double x, double y) const noexcept {
    double sum = 0;
    for (const auto& [amplitude, kx, ky, phase] : folds_)
        sum += amplitude * std::cos(kx * x + ky * y + phase);
    return sum;
}

double Cloth::above(Vector3 point) const noexcept {
    const Vector3 from = point - centre_;
    return from.z - height(from.x, from.y);
}

Vector3 Cloth::normal(Vector3 point) const noexcept {
    const Vector3 from = point - centre_;
    Vector3 normal{0, 0, 1};
    for (const auto& [amplitude, kx, ky, phase] : folds_) {
        const double slope = -amplitude * std::sin(kx * from.x + ky * from.y + phase);
        normal = normal - slope * Vector3{kx, ky, 0};
    }
    return normalised(normal);
}

std::optional<Meeting> Cloth::meeting(const Ray& ray) const noexcept {
    const Vector3 from = ray.origin - centre_;
    const Slab x = slab(from.x, ray.direction.x, half_edge_), y = slab(from.y, ray.direction.y, half_edge_);
    const Slab z = slab(from.z, ray.direction.z, highest_ + shortest_distance);
    const double end = std::min({x.leave, y.leave, z.leave});
    double distance = std::max({x.enter, y.enter, z.enter, shortest_distance});
    if (!(distance < end)) return std::nullopt;
    // the height above the cloth changes by at most `rate` per unit of distance
    const double rate = std::abs(ray.direction.z) + steepest_ * std::hypot(ray.direction.x, ray.direction.y);
    const double side = above(ray.at(distance)) < 0 ? -1 : 1;
    constexpr double least_step = 1e-4;
    double before = distance;
    double height = side * above(ray.at(distance));
    while (height > 0) {
        before = distance;
        distance += std::max(height / rate, least_step);
        if (distance > end) return std::nullopt;
        height = side * above(ray.at(distance));
    }
    while (rate * (distance - before) > accuracy::cloth_height) {
        const double middle = (before + distance) / 2;
        (side * above(ray.at(middle)) > 0 ? before : distance) = middle;
    }
    return Meeting{before, Frame::about(normal(ray.at(before)), {1, 0, 0})};
}

std::optional<Meeting> meeting(const Shape& shape, const Ray& ray) noexcept {
    return std::visit([&](const auto& each) { return each.meeting(ray); }, shape);
}

}  // namespace hts::validation
