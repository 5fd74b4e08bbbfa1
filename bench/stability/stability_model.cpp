#include "bench/stability/stability_model.hpp"

#include "hts/terms.hpp"
#include "hts/tests/reference/reference_model.hpp"

namespace hts::bench {
namespace {

reference::Point exact(const ModelPoint& p) {
    return {p.wavelength,         p.theta_i, p.phi_i, p.theta_r, p.phi_r, p.n, p.k, p.rms_roughness,
            p.correlation_length, 0};
}

}  // namespace

double reference_phi(double g, double t) {
    return static_cast<double>(reference::phi_sums(g, t).phi);
}

ModelValues engine_model(const ModelPoint& p) {
    const Surface surface{p.rms_roughness, p.correlation_length};
    const auto wavelength = Wavelength::from_micrometres(p.wavelength);
    const RefractiveIndex index{p.n, p.k};
    const View in = view(surface, Direction::from_degrees(p.theta_i, p.phi_i));
    const View out = view(surface, Direction::from_degrees(p.theta_r, p.phi_r));
    return {directional_diffuse(PairFactors{surface, in, out}, wavelength, index).brdf,
            specular_reflectance(surface, in, wavelength, index).value()};
}

ModelValues reference_model(const ModelPoint& point) {
    const reference::Reflection f = reference::reflection(exact(point));
    return {static_cast<double>(f.directional_diffuse), static_cast<double>(f.specular_reflectance)};
}

double reference_rough_limit(const ModelPoint& point) {
    // what the limit needs of the reflection does not depend on wavelength
    ModelPoint ordinary = point;
    ordinary.wavelength = point.rms_roughness;
    const reference::Reflection f = reference::reflection(exact(ordinary));
    return static_cast<double>(reference::geometric_optics_limit(exact(point), f));
}

double reference_mirror(const ModelPoint& point) {
    const reference::Real cosine = cos(reference::radians(point.theta_i));
    return static_cast<double>(reference::fresnel(cosine, {point.n, point.k}).unpolarised());
}

}  // namespace hts::bench
