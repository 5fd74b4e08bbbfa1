/// Models made of a diffuse term and weighted lobes, f = kd/pi + sum_l ks_l lobe_l(in, out) [Kurt10 (14)],
/// and how directions are drawn from them: the sum, its density and its sampling are here once, a model
/// adds the shape of its lobe.
///
/// Half directions: the facet that mirrors `in` into `out` has the normal h = (in + out)/|in + out| and sees
/// both under theta_d, cos theta_d = in.h = out.h. A density p(h) of normals is one of p/(4 cos
/// theta_d) of outgoing directions.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "hts/microfacet/spectrum.hpp"

namespace hts {

/// The facet that mirrors one direction into another, both above the horizon.
struct HalfDirection {
    Vector3 normal;      ///< unit length, z > 0
    double slope_x;      ///< normal.x / normal.z; with slope_y the tangent of theta_h
    double slope_y;      ///< normal.y / normal.z
    double cos_theta_d;  ///< in.h = out.h
};

[[nodiscard]] HalfDirection half_direction(const Direction& in, const Direction& out) noexcept;

/// `in` mirrored by a facet, 2 (in.h) h - in: a unit vector, perhaps below the horizon.
[[nodiscard]] Vector3 mirrored(const Direction& in, Vector3 normal) noexcept;

/// Schlick's approximation of the Fresnel reflectance, f0 + (1 - f0)(1 - cos)^5 [Kurt10 (12)].
[[nodiscard]] inline double schlick(double f0, double cosine) noexcept {
    const double rest = 1 - cosine, square = rest * rest;
    return f0 + (1 - f0) * square * square * rest;
}

/// The strength (see LobeShape) of a lobe with Schlick's reflectance: that at the angle of incidence, at
/// least 0.05, since facets at other angles reflect even where this one is 0.
[[nodiscard]] double schlick_strength(double f0, const Direction& in) noexcept;

/// Unit vector of polar angle theta and azimuth phi with cos theta = `base`^(1/(exponent + 1)): for a uniform
/// base in (0, 1] the density of theta is (exponent + 1) cos^exponent theta sin theta.
[[nodiscard]] Vector3 cosine_power_vector(double base, double exponent, double cos_phi,
                                          double sin_phi) noexcept;

/// Unit vector with the density cos theta / pi over the hemisphere.
[[nodiscard]] Vector3 cosine_vector(double u1, double u2) noexcept;

/// Whether both are above the horizon; a cosine below 1e-30 counts as on it, so that no
/// product of cosines underflows.
[[nodiscard]] inline bool above_horizon(const Direction& in, const Direction& out) noexcept {
    constexpr double on_horizon = 1e-30;
    return in.cos_theta() > on_horizon && out.cos_theta() > on_horizon;
}

/// Checks of parameters; each returns its value or throws hts::Error naming the quantity.
[[nodiscard]] double checked_reflectance(const char* quantity, double value);   ///< 0 ... 1
[[nodiscard]] double checked_reflectivity(const char* quantity, double value);  ///< 0 ... 1e6
[[nodiscard]] double checked_exponent(const char* quantity, double value);      ///< 0 ... 1e8

/// A direction that a model drew, with the model's own weight and density; nothing drawn if
/// it lies below the horizon.
template <ReflectanceModel Model>
[[nodiscard]] Draw weighted(const Model& model, const Direction& in, Vector3 drawn) noexcept {
    if (!(drawn.z > 0)) return Draw::none(in);
    const Direction out = Direction::from_vector(drawn);
    const double pdf = model.pdf(in, out);
    if (!(pdf > 0)) return Draw::none(in);
    return {out, model.brdf(in, out) * out.cos_theta() / pdf, pdf};
}

/// The shape of a lobe, for reflectivity 1 and directions above the horizon.
///   brdf       [1/sr]
///   pdf        [1/sr] of `draw`; its integral over the hemisphere is at most 1
///   draw       a unit vector from two uniform numbers, perhaps below the horizon
///   strength   about the lobe's albedo, by which one lobe is chosen rather than another   [1]   >= 0
template <class Shape>
concept LobeShape = requires(const Shape& shape, const Direction& in, const Direction& out, double u) {
    { shape.brdf(in, out) }
    noexcept->std::same_as<double>;
    { shape.pdf(in, out) }
    noexcept->std::same_as<double>;
    { shape.draw(in, u, u) }
    noexcept->std::same_as<Vector3>;
    { shape.strength(in) }
    noexcept->std::same_as<double>;
};

/// What lobes that differ in their reflectance alone share.
struct LobeGeometry {
    double mirrors;    ///< BRDF of the lobe for facets that reflect all light [1/sr]
    double incidence;  ///< schlick(0, cos theta_d)

    /// The lobe's BRDF for Schlick's reflectance [1/sr].   f0   at normal incidence; 1 of lobes without
    [[nodiscard]] double brdf(double f0) const noexcept { return (f0 + (1 - f0) * incidence) * mirrors; }
};

/// A lobe that is its geometry times Schlick's reflectance, so that many wavelengths
/// cost little more than one.
///   same_facets   whether the geometry of two lobes is the same
template <class Shape>
concept FacetLobeShape = LobeShape<Shape> &&
    requires(const Shape& shape, const Direction& in, const Direction& out) {
    { shape.geometry(in, out) }
    noexcept->std::same_as<LobeGeometry>;
    { shape.f0() }
    noexcept->std::same_as<double>;
    { shape.same_facets(shape) }
    noexcept->std::same_as<bool>;
};

/// A lobe and its specular reflectivity.
template <LobeShape Shape>
struct WeightedLobe {
    double ks;  ///< [1]
    Shape shape;
};

/// A Lambertian term and any number of lobes.
template <LobeShape Shape>
class DiffuseAndLobes {
  public:
    ///   kd   diffuse albedo, 0 ... 1      ks   of each lobe, 0 ... 1e6; else hts::Error
    DiffuseAndLobes(double kd, std::vector<WeightedLobe<Shape>> lobes)
        : kd_{checked_reflectance("diffuse albedo kd", kd)}, lobes_{std::move(lobes)} {
        for (const auto& lobe : lobes_)
            static_cast<void>(checked_reflectivity("specular reflectivity ks", lobe.ks));
    }

    [[nodiscard]] double kd() const noexcept { return kd_; }
    [[nodiscard]] const std::vector<WeightedLobe<Shape>>& lobes() const noexcept { return lobes_; }

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }

    [[nodiscard]] bool shares_geometry(const DiffuseAndLobes& other) const noexcept requires
        FacetLobeShape<Shape> {
        return std::ranges::equal(lobes_, other.lobes_,
                                  [](const auto& a, const auto& b) { return a.shape.same_facets(b.shape); });
    }
    static void brdf(std::span<const DiffuseAndLobes> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept {
        brdf(alike, std::identity{}, in, out, result);
    }
    /// The same for models that hold such parts: parts(model) or model.*parts.
    template <class Model, class Parts>
    static void brdf(std::span<const Model> alike, Parts parts, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept {
        if (!above_horizon(in, out)) return std::fill(result.begin(), result.end(), 0.0);
        for (std::size_t i = 0; i < alike.size(); ++i) result[i] = std::invoke(parts, alike[i]).kd_ / pi;
        const auto& lobes = std::invoke(parts, alike.front()).lobes_;
        for (std::size_t l = 0; l < lobes.size(); ++l) {
            const auto add = [&](const auto& value) {
                for (std::size_t i = 0; i < alike.size(); ++i) {
                    const WeightedLobe<Shape>& lobe = std::invoke(parts, alike[i]).lobes_[l];
                    result[i] += lobe.ks * value(lobe.shape);
                }
            };
            if constexpr (FacetLobeShape<Shape>) {
                const LobeGeometry geometry = lobes[l].shape.geometry(in, out);
                add([&](const Shape& shape) { return geometry.brdf(shape.f0()); });
            } else {
                add([&](const Shape& shape) { return shape.brdf(in, out); });
            }
        }
    }

    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        const double all = strength(in);
        if (!above_horizon(in, out) || !(all > 0)) return 0;
        double sum = kd_ * out.cos_theta() / pi;
        for (const auto& lobe : lobes_) sum += lobe.ks * lobe.shape.strength(in) * lobe.shape.pdf(in, out);
        return sum / all;
    }

    /// A lobe is chosen in proportion to its strength, then a direction from it.
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        return weighted(*this, in, draw(in, u));
    }

    /// What `sample` draws, without its weight: a unit vector, perhaps below the horizon.
    [[nodiscard]] Vector3 draw(const Direction& in, const Uniforms& u) const noexcept {
        double left = u[0] * strength(in) - kd_;
        for (const auto& lobe : lobes_) {
            if (left < 0) break;
            left -= lobe.ks * lobe.shape.strength(in);
            if (left < 0) return lobe.shape.draw(in, u[1], u[2]);
        }
        return cosine_vector(u[1], u[2]);
    }

  private:
    static constexpr double pi = std::numbers::pi;

    [[nodiscard]] double strength(const Direction& in) const noexcept {
        double sum = kd_;
        for (const auto& lobe : lobes_) sum += lobe.ks * lobe.shape.strength(in);
        return sum;
    }

    double kd_;
    std::vector<WeightedLobe<Shape>> lobes_;
};

}  // namespace hts
