/// A scene: shapes with materials, lights, uniform light from everywhere, and a camera.
#pragma once

#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "validation/pictures/appearance.hpp"
#include "validation/pictures/shapes.hpp"

namespace hts::validation {

/// Which of an object's materials is at a point of it; index below their number.
using Pattern = std::function<std::size_t(Vector3 point)>;

/// A shape and what it is made of.
struct Object {
    Shape shape;
    std::vector<Appearance> appearances;  ///< at least one
    Pattern pattern{};                    ///< none: the first appearance everywhere
    double turn = 0;                      ///< of the x axis of anisotropic materials about the normal [rad]

    [[nodiscard]] const Appearance& appearance(Vector3 point) const {
        return appearances[pattern ? pattern(point) : 0];
    }
};

/// A point of a light as an illuminated point sees it.
struct LightSample {
    Vector3 direction;  ///< towards it
    double distance;
    double pdf;  ///< density in solid angle of this sample [1/sr]; 0: the light does not shine this way
};

/// A sphere that shines evenly to all sides, or a rectangle to the side of its normal.
class AreaLight {
  public:
    AreaLight(Sphere shape, Spectrum radiance) : shape_{shape}, radiance_{radiance} {}
    AreaLight(Rectangle shape, Spectrum radiance) : shape_{shape}, radiance_{radiance} {}

    [[nodiscard]] const Spectrum& radiance() const noexcept { return radiance_; }
    /// Distance at which a ray meets its shining side; infinity if it does not.
    [[nodiscard]] double distance(const Ray& ray) const noexcept;
    /// A point of it, uniform in solid angle (sphere) or area (rectangle).   u   two numbers in [0, 1)
    [[nodiscard]] LightSample sample(Vector3 from, const std::array<double, 2>& u) const noexcept;
    /// Density of `sample` for the direction of a ray that meets the light at a distance [1/sr].
    [[nodiscard]] double pdf(const Ray& ray, double distance) const noexcept;

  private:
    std::variant<Sphere, Rectangle> shape_;
    Spectrum radiance_;
};

/// A pinhole camera.
class Camera {
  public:
    ///   up is the scene's z, which the line of sight must not follow
    ///   field_of_view   across, [deg] 0 ... 180 exclusive
    Camera(Vector3 place, Vector3 looks_at, double field_of_view);
    /// Through a point of the picture: x from the left, y from the top, 0 ... 1 across its width.
    [[nodiscard]] Ray ray(double x, double y, double height_over_width) const noexcept;
    /// Towards a point of the scene.
    [[nodiscard]] Ray towards(Vector3 point) const noexcept { return {place_, normalised(point - place_)}; }

  private:
    Vector3 place_, right_, up_, forward_;
    double extent_;
};

struct Scene {
    std::vector<Object> objects;
    std::vector<AreaLight> lights;
    Spectrum ambient;  ///< radiance that comes from everywhere, and that a ray sees which meets nothing
    Camera camera;
    double exposure = 1;  ///< what radiance 1 is worth on the picture
};

/// What a ray meets first: an object, a light, or nothing.
struct Sight {
    const Object* object = nullptr;
    const AreaLight* light = nullptr;
    Meeting meeting{};
};
[[nodiscard]] Sight seen(const Scene& scene, const Ray& ray) noexcept;

/// Whether nothing stands between a point and another, `distance` away.
[[nodiscard]] bool is_free(const Scene& scene, const Ray& ray, double distance) noexcept;

}  // namespace hts::validation
