#include "validation/pictures/integrators.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "validation/pictures/evenly.hpp"

namespace hts::validation {
namespace {

/// How far a ray starts off a surface, in units of the scene.
constexpr double off_surface = 1e-6;
/// Points of each light that a ray by [He91 (12)] takes at a time.
constexpr std::uint32_t light_samples = 4;
/// Mirror rays, or bends of a path, are no longer followed.
constexpr std::uint32_t most_bends = 16;
/// A mirror that returns less than this at every wavelength is none.
constexpr double least_mirror = 1e-4;

/// Dimensions of a sample's numbers: two for the pixel, then these per bend.
constexpr std::uint32_t dimensions_per_bend = 16;

std::array<double, 2> numbers(const PixelSample& sample, std::uint32_t bend, std::uint32_t use,
                              std::uint32_t index) {
    return even_point(stream(sample.seed, sample.pixel, 1 + dimensions_per_bend * bend + use), index);
}

/// The frame as seen from where the ray comes: of a sheet seen from below, turned over.
Frame facing(const Frame& frame, Vector3 along) {
    return dot(frame.z, along) <= 0 ? frame : Frame{frame.x, -frame.y, -frame.z};
}

Direction above(Vector3 local) {
    return Direction::from_vector({local.x, local.y, std::max(local.z, 0.0)});
}

/// An array of equal values, which need no default.
template <class Value, std::size_t... i>
std::array<Value, sizeof...(i)> copies(const Value& value, std::index_sequence<i...> /*indices*/) {
    return {(static_cast<void>(i), value)...};
}

/// Pairs of directions and what light along each is worth, evaluated together.
class Batch {
  public:
    explicit Batch(const SurfacePoint& point) : point_{point} {}

    /// Light from a direction above the horizon: adds factor * radiance * f to the sum.
    void add(const Direction& in, double factor, const Spectrum& radiance) noexcept {
        pairs_[count_] = {in, point_.view};
        lights_[count_] = factor * radiance;
        if (++count_ == capacity) evaluate();
    }
    [[nodiscard]] const Spectrum& sum() noexcept {
        evaluate();
        return sum_;
    }

  private:
    static constexpr std::size_t capacity = 16;

    void evaluate() noexcept {
        std::array<Spectrum, capacity> brdf;
        point_.appearance->brdf(std::span{pairs_}.first(count_), brdf);
        for (std::size_t i = 0; i < count_; ++i) sum_.add(1, brdf[i], lights_[i]);
        count_ = 0;
    }

    const SurfacePoint& point_;
    std::array<DirectionPair, capacity> pairs_ =
        copies(DirectionPair{point_.view, point_.view}, std::make_index_sequence<capacity>{});
    std::array<Spectrum, capacity> lights_;
    std::size_t count_ = 0;
    Spectrum sum_;
};

/// What a point of a light sends to a surface.
struct Illumination {
    Direction in;
    double cosine_over_pdf;  // 0: nothing arrives
    double pdf;
};

Illumination illumination(const Scene& scene, const AreaLight& light, const SurfacePoint& point,
                          const std::array<double, 2>& u) {
    const LightSample sample = light.sample(point.position, u);
    const Vector3 local = point.frame.inward(sample.direction);
    if (!(sample.pdf > 0 && local.z > 0)) return {point.view, 0, 0};
    if (!is_free(scene, {point.position, sample.direction}, sample.distance)) return {point.view, 0, 0};
    return {above(local), local.z / sample.pdf, sample.pdf};
}

/// Light of the lamps that the diffuse terms reflect.
Spectrum lit(const Scene& scene, const SurfacePoint& point, const PixelSample& sample, std::uint32_t bend) {
    Batch batch{point};
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        for (std::uint32_t k = 0; k < light_samples; ++k) {
            const auto u = numbers(sample, bend, l, sample.index * light_samples + k);
            const Illumination from = illumination(scene, scene.lights[l], point, u);
            if (from.cosine_over_pdf == 0) continue;
            batch.add(from.in, from.cosine_over_pdf / light_samples, scene.lights[l].radiance());
        }
    }
    return batch.sum();
}

/// The same of one point of each lamp, for paths: weighted against meeting the lamp by a drawn direction.
Spectrum lit_once(const Scene& scene, const SurfacePoint& point, const PixelSample& sample,
                  std::uint32_t bend) {
    Batch batch{point};
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        const Illumination from =
            illumination(scene, scene.lights[l], point, numbers(sample, bend, 3 + l, sample.index));
        if (from.cosine_over_pdf == 0) continue;
        const double drawn = point.appearance->pdf(point.view, from.in);
        batch.add(from.in, from.cosine_over_pdf * from.pdf / (from.pdf + drawn), scene.lights[l].radiance());
    }
    return batch.sum();
}

/// Weight of light met by a direction drawn with a density, against sampling the light.
double balance(const Ray& ray, const Sight& sight, double drawn_pdf) {
    if (drawn_pdf == 0) return 1;
    return drawn_pdf / (drawn_pdf + sight.light->pdf(ray, sight.meeting.distance));
}

/// A path on its way: what its light is worth at the camera.
struct Path {
    Ray ray;
    Spectrum worth = Spectrum::grey(1);
    double drawn_pdf = 0;  // of the direction; 0 if it came from the camera or a mirror

    /// Draws the next direction; false where the path ends.
    bool bend(const SurfacePoint& point, const PixelSample& sample, std::uint32_t bend) noexcept {
        const auto [a, b] = numbers(sample, bend, 0, sample.index);
        const auto [c, d] = numbers(sample, bend, 1, sample.index);
        const SpectralDraw drawn = point.appearance->draw(point.view, {a, b, c, d});
        if (!(drawn.pdf > 0)) return false;
        ray = point.towards(drawn.out);
        if (drawn.lobe == Lobe::specular) {
            worth = (1 / drawn.pdf) * worth * point.appearance->specular_reflectance(point.view);
            drawn_pdf = 0;
        } else {
            worth =
                (drawn.out.cos_theta() / drawn.pdf) * worth * point.appearance->brdf({drawn.out, point.view});
            drawn_pdf = drawn.pdf;
        }
        return survives(sample, bend);
    }

  private:
    /// Russian roulette by what is left.
    bool survives(const PixelSample& sample, std::uint32_t bend) noexcept {
        if (bend < 3) return true;
        const double chance = std::min(0.95, worth.largest());
        if (!(numbers(sample, bend, 2, sample.index)[0] < chance)) return false;
        worth = (1 / chance) * worth;
        return true;
    }
};

}  // namespace

SurfacePoint::SurfacePoint(const Ray& ray, const Sight& sight) noexcept
    : position{ray.at(sight.meeting.distance)},
      frame{facing(sight.meeting.frame.turned(sight.object->turn), ray.direction)},
      view{above(frame.inward(-ray.direction))},
      appearance{&sight.object->appearance(position)} {
    position = position + off_surface * frame.z;
}

Spectrum ray_radiance(const Scene& scene, const Ray& ray, const PixelSample& sample) noexcept {
    Spectrum sum, worth = Spectrum::grey(1);
    Ray current = ray;
    for (std::uint32_t bend = 0; bend < most_bends; ++bend) {
        const Sight sight = seen(scene, current);
        if (sight.object == nullptr) {
            sum.add(1, worth, sight.light != nullptr ? sight.light->radiance() : scene.ambient);
            break;
        }
        const SurfacePoint point{current, sight};
        sum.add(1, worth, lit(scene, point, sample, bend));
        sum.add(1, worth, point.appearance->diffuse_albedo() * scene.ambient);
        if (!point.appearance->has_specular()) break;
        worth = worth * point.appearance->specular_reflectance(point.view);
        if (worth.largest() < least_mirror) break;
        current = point.towards(point.view.mirror());
    }
    return sum;
}

Spectrum path_radiance(const Scene& scene, const Ray& ray, const PixelSample& sample) noexcept {
    Spectrum sum;
    Path path{ray};
    for (std::uint32_t bend = 0; bend < most_bends; ++bend) {
        const Sight sight = seen(scene, path.ray);
        if (sight.object == nullptr) {
            if (sight.light == nullptr)
                sum.add(1, path.worth, scene.ambient);
            else
                sum.add(balance(path.ray, sight, path.drawn_pdf), path.worth, sight.light->radiance());
            break;
        }
        const SurfacePoint point{path.ray, sight};
        sum.add(1, path.worth, lit_once(scene, point, sample, bend));
        if (!path.bend(point, sample, bend)) break;
    }
    return sum;
}

}  // namespace hts::validation
