/// What every model of hts/microfacet/ offers at one wavelength, so that whatever uses one takes them all.
///
/// A model is a plain value: its constructor checks the parameters (hts::Error), its calls are const, noexcept, total
/// and allocate nothing. Directions point away from the surface as everywhere (direction.hpp); unpolarised light.
#pragma once

#include <array>
#include <concepts>

#include "hts/direction.hpp"

namespace hts {

/// Three numbers in [0, 1), independent and uniform; equal numbers draw equal directions.
using Uniforms = std::array<double, 3>;

/// A direction drawn by a model. `weight` and `pdf` are 0 where nothing was drawn (below the horizon, absorbed).
struct DrawnDirection {
    Direction out;
    double weight;  ///< brdf cos theta_out / pdf   [1]; its mean is the albedo
    double pdf;     ///< density in solid angle of drawing `out`, whatever lobe it came from   [1/sr]
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
    noexcept->std::same_as<DrawnDirection>;
};

/// A model that lets light through as well. `behind` leads to a viewer on the far side, its polar angle measured from the
/// inward normal, its azimuth that of the front: straight on through the surface from (theta, phi) is (theta, phi + 180 deg).
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
