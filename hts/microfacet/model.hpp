/// What every reflectance model offers at one wavelength, so that whatever uses one takes them all.
///
/// A model is a plain value: its constructor checks the parameters (hts::Error), its calls are const,
/// noexcept, total and allocate nothing. Directions point away from the surface as everywhere
/// (direction.hpp); unpolarised light.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "hts/direction.hpp"

namespace hts {

/// Three numbers in [0, 1), independent and uniform; equal numbers draw equal directions.
using Uniforms = std::array<double, 3>;

/// Which term a direction was drawn from.
enum class Lobe {
    none,  ///< the draw fell below the horizon, or nothing is reflected
    specular,
    directional_diffuse,
    uniform_diffuse,
};

/// "none", "specular", "directional_diffuse", "uniform_diffuse".
[[nodiscard]] constexpr const char* name(Lobe lobe) noexcept {
    constexpr std::array names{"none", "specular", "directional_diffuse", "uniform_diffuse"};
    return names[static_cast<std::size_t>(lobe)];
}

/// A direction drawn.
struct Draw {
    Direction out;  ///< the mirror direction for Lobe::none
    /// brdf cos theta_out / pdf, of a specular draw reflectance / pdf [1]; 0 of none. Its mean is the albedo.
    double weight;
    /// Density in solid angle of drawing `out`, whatever diffuse lobe it came from [1/sr]; of a specular draw
    /// the probability of the delta [1]; 0 of none.
    double pdf;
    Lobe lobe = Lobe::directional_diffuse;

    /// Nothing drawn.
    [[nodiscard]] static Draw none(const Direction& in) noexcept { return {in.mirror(), 0, 0, Lobe::none}; }
};

/// A reflectance model at one wavelength.
///   brdf     [1/sr]; 0 on and below the horizon
///   pdf      [1/sr] of `sample` drawing `out`; its integral over the hemisphere is at most 1
///   sample   mean weight: the directional-hemispherical reflectance
template <class Model>
concept ReflectanceModel = requires(const Model& model, const Direction& in, const Direction& out,
                                    const Uniforms& uniforms) {
    { model.brdf(in, out) }
    noexcept->std::same_as<double>;
    { model.pdf(in, out) }
    noexcept->std::same_as<double>;
    { model.sample(in, uniforms) }
    noexcept->std::same_as<Draw>;
};

/// A model that lets light through as well. `behind` leads to a viewer on the far side, its polar angle
/// measured from the inward normal, its azimuth that of the front: straight on through the surface from
/// (theta, phi) is (theta, phi + 180 deg).
///   transmits   whether it does at all; then
///   btdf        radiance that leaves along `behind` per irradiance from `in` [1/sr]; 0 on the horizon
template <class Model>
concept TransmittingModel = ReflectanceModel<Model> &&
    requires(const Model& model, const Direction& in, const Direction& behind) {
    { model.transmits() }
    noexcept->std::same_as<bool>;
    { model.btdf(in, behind) }
    noexcept->std::same_as<double>;
};

}  // namespace hts
