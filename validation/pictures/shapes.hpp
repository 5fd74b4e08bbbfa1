/// Shapes of a scene and where a ray meets them, in closed form but for the folds of a cloth.
///
/// Every shape says at the point met which way is outward and, for anisotropic surfaces, which way along the
/// surface its x axis runs. Shapes are seen from outside; cloth and rectangles have two sides, of which the
/// normal is the upper one.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "validation/pictures/frame.hpp"

namespace hts::accuracy {
/// Of the height of the point where a ray meets a Cloth above it, in units of the scene.
inline constexpr double cloth_height = 1e-9;
}  // namespace hts::accuracy

namespace hts::validation {

struct Ray {
    Vector3 origin;
    Vector3 direction;  ///< of unit length

    [[nodiscard]] Vector3 at(double distance) const noexcept { return origin + distance * direction; }
};

/// Where a ray meets a shape.
struct Meeting {
    double distance;
    Frame frame;
};

/// The shortest distance that counts, so that a ray which starts on a surface leaves it.
inline constexpr double shortest_distance = 1e-7;
/// The distance of what a ray does not meet.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// x runs east, y towards the pole on top.
class Sphere {
  public:
    ///   radius   > 0, else hts::Error
    Sphere(Vector3 centre, double radius);
    [[nodiscard]] std::optional<Meeting> meeting(const Ray& ray) const noexcept;
    [[nodiscard]] Vector3 centre() const noexcept { return centre_; }
    [[nodiscard]] double radius() const noexcept { return radius_; }

  private:
    Vector3 centre_;
    double radius_;
};

/// Upright and closed; x runs about the axis, on top and bottom along the scene's x.
class Cylinder {
  public:
    ///   base   centre of the bottom     radius, height   > 0, else hts::Error
    Cylinder(Vector3 base, double radius, double height);
    [[nodiscard]] std::optional<Meeting> meeting(const Ray& ray) const noexcept;

  private:
    [[nodiscard]] std::optional<Meeting> side(const Ray& ray) const noexcept;
    [[nodiscard]] std::optional<Meeting> lid(const Ray& ray, double height, double towards) const noexcept;

    Vector3 base_;
    double radius_, height_;
};

/// Upright, turned about the vertical; x runs about it, on top and bottom along the first edge.
class Box {
  public:
    ///   base   centre of the bottom     edges   > 0, else hts::Error     turn   [rad]
    Box(Vector3 base, Vector3 edges, double turn);
    [[nodiscard]] std::optional<Meeting> meeting(const Ray& ray) const noexcept;

  private:
    Vector3 centre_, half_;
    Frame frame_;
};

/// Part of a plane; x runs along the first edge, the normal is first edge x second edge.
class Rectangle {
  public:
    ///   edges   at right angles and longer than 0, else hts::Error
    Rectangle(Vector3 corner, Vector3 first_edge, Vector3 second_edge);
    [[nodiscard]] std::optional<Meeting> meeting(const Ray& ray) const noexcept;
    /// A point of it.   u, v   0 ... 1 along the edges
    [[nodiscard]] Vector3 point(double u, double v) const noexcept {
        return corner_ + (u * first_length_) * frame_.x + (v * second_length_) * frame_.y;
    }
    /// u and v of a point of its plane.
    [[nodiscard]] std::array<double, 2> coordinates(Vector3 point) const noexcept {
        return {dot(point - corner_, frame_.x) / first_length_,
                dot(point - corner_, frame_.y) / second_length_};
    }
    [[nodiscard]] double area() const noexcept { return first_length_ * second_length_; }
    [[nodiscard]] Vector3 normal() const noexcept { return frame_.z; }

  private:
    Vector3 corner_;
    Frame frame_;
    double first_length_, second_length_;
};

/// A wave of a folded cloth: amplitude cos(kx x + ky y + phase).
struct Fold {
    double amplitude, kx, ky, phase;
};

/// A square of folded cloth, a height over the plane; x runs along the scene's x.
class Cloth {
  public:
    ///   half_edge   of the square, > 0, else hts::Error
    Cloth(Vector3 centre, double half_edge, std::vector<Fold> folds);
    /// Steps that the steepest fold allows, then halving.    error   accuracy::cloth_height
    [[nodiscard]] std::optional<Meeting> meeting(const Ray& ray) const noexcept;
    /// Height above the plane of the centre.
    [[nodiscard]] double height(double x, double y) const noexcept;

  private:
    [[nodiscard]] double above(Vector3 point) const noexcept;
    [[nodiscard]] Vector3 normal(Vector3 point) const noexcept;

    Vector3 centre_;
    double half_edge_;
    std::vector<Fold> folds_;
    double steepest_ = 0, highest_ = 0;
};

using Shape = std::variant<Sphere, Cylinder, Box, Rectangle, Cloth>;

/// The first meeting from shortest_distance on.
[[nodiscard]] std::optional<Meeting> meeting(const Shape& shape, const Ray& ray) noexcept;

}  // namespace hts::validation
