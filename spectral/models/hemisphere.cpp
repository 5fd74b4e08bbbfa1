#include "spectral/models/hemisphere.hpp"

#include <cmath>
#include <map>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "hts/error.hpp"

namespace hts::spectral {

HemisphericalReflectance bihemispherical_reflectance(const Reflectance& reflectance, std::size_t wavelength) {
    if (!reflectance.properties().isotropic)
        throw Error{reflectance.name() + ": reflectance of uniform light: must be of an isotropic surface"};
    std::map<double, HemisphericalReflectance> known;  // the terms share their nodes
    const auto at = [&](double cosine) -> const HemisphericalReflectance& {
        const auto found = known.find(cosine);
        if (found != known.end()) return found->second;
        const Direction in = Direction::from_angles(std::acos(cosine), 0);
        return known.emplace(cosine, reflectance.albedo(in, wavelength)).first->second;
    };
    // in x = sqrt(cos theta), over which the way to the horizon is smooth
    const auto mean = [&](double HemisphericalReflectance::*term) {
        constexpr unsigned levels = 6;
        return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
            [&](double x) { return 4 * x * x * x * (at(x * x).*term); }, 0.0, 1.0, levels,
            accuracy::bihemispherical_reflectance);
    };
    return {mean(&HemisphericalReflectance::specular), mean(&HemisphericalReflectance::directional_diffuse),
            mean(&HemisphericalReflectance::uniform_diffuse)};
}

}  // namespace hts::spectral
