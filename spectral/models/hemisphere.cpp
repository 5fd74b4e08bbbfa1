#include "spectral/models/hemisphere.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "spectral/energy/azimuths.hpp"

namespace hts::spectral {

namespace {

HemisphericalReflectance averaged(const Reflectance& reflectance, double theta, std::size_t wavelength) {
    const auto along = [&](double azimuth) {
        return reflectance.albedo(Direction::from_angles(theta, azimuth), wavelength);
    };
    const Properties properties = reflectance.properties();
    if (properties.isotropic) return along(0);
    // both axes of a rough surface are its mirror planes; of others no symmetry is known
    const bool rough = properties.surface.has_value();
    const double first = rough ? properties.surface->azimuth() : 0;
    const double length = (rough ? 0.5 : 2) * std::numbers::pi;
    const auto mean = mean_over_azimuths(
        first, length, rough ? 4 : 16, accuracy::bihemispherical_reflectance / 2, [&](double azimuth) {
            const auto at = along(azimuth);
            return std::array{at.specular, at.directional_diffuse, at.uniform_diffuse};
        });
    return {mean[0], mean[1], mean[2]};
}

}  // namespace

HemisphericalReflectance bihemispherical_reflectance(const Reflectance& reflectance, std::size_t wavelength) {
    std::map<double, HemisphericalReflectance> known;  // the terms share their nodes
    const auto at = [&](double cosine) -> const HemisphericalReflectance& {
        const auto found = known.find(cosine);
        if (found != known.end()) return found->second;
        return known.emplace(cosine, averaged(reflectance, std::acos(cosine), wavelength)).first->second;
    };
    // The rule's error is relative; beside 1 it is absolute, as that of a mean over azimuths. It is that of
    // the 15 points within the 31, far above the error of all, and here each point costs many albedos.
    const bool isotropic = reflectance.properties().isotropic;
    const double beside = isotropic ? 0 : 1;
    const double error = (isotropic ? 1 : 10) * accuracy::bihemispherical_reflectance;
    // in x = sqrt(cos theta), over which the way to the horizon is smooth
    const auto mean = [&](double HemisphericalReflectance::*term) {
        constexpr unsigned levels = 6;
        return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                   [&](double x) { return 4 * x * x * x * (at(x * x).*term + beside); }, 0.0, 1.0, levels,
                   error) -
               beside;
    };
    return {mean(&HemisphericalReflectance::specular), mean(&HemisphericalReflectance::directional_diffuse),
            mean(&HemisphericalReflectance::uniform_diffuse)};
}

}  // namespace hts::spectral
