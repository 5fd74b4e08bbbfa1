#include "spectral/energy/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>

#include "hts/error.hpp"
#include "spectral/energy/azimuths.hpp"
#include "spectral/energy/lobe_integral.hpp"

namespace hts::spectral {
namespace {

constexpr double right_angle = std::numbers::pi / 2;

double specular_part(const RoughSurface& surface, const Facets& facets, const Wavelength& wavelength,
                     const Direction& in) {
    return reflected_light(surface, facets, wavelength).mirror(in);
}

double directional_diffuse_part(const RoughSurface& surface, const Facets& facets,
                                const Wavelength& wavelength, const Direction& in) {
    return lobe_integral(
        surface, in, wavelength, reflected_light(surface, facets, wavelength).lobe(in),
        [](const Direction&) { return 1.0; }, Tolerance{accuracy::hemispherical_reflectance});
}

/// Where in from ... to a function is largest: the best of equally spaced points,
/// refined between its neighbours.
struct Maximum {
    double place, value;
};

template <class Function>
Maximum maximum(double from, double to, int intervals, Function&& f) {
    const auto node = [&](int i) { return i == intervals ? to : from + (to - from) * i / intervals; };
    Maximum best{from, f(from)};
    int best_node = 0;
    for (int i = 1; i <= intervals; ++i) {
        const double value = f(node(i));
        if (value > best.value) {
            best = {node(i), value};
            best_node = i;
        }
    }
    constexpr int bits = 13;  // of the place; twice as many of the value
    const auto [place, value] = boost::math::tools::brent_find_minima(
        [&](double x) { return -f(x); }, node(std::max(best_node - 1, 0)),
        node(std::min(best_node + 1, intervals)), bits);
    return -value > best.value ? Maximum{place, -value} : best;
}

}  // namespace

HemisphericalReflectance directional_hemispherical_reflectance(const RoughSurface& surface,
                                                               const Facets& facets,
                                                               const Wavelength& wavelength,
                                                               const Direction& in) noexcept {
    return {specular_part(surface, facets, wavelength, in),
            directional_diffuse_part(surface, facets, wavelength, in), 0};
}

HemisphericalReflectance directional_hemispherical_reflectance(const RoughSurface& surface,
                                                               const CoatedIndex& index,
                                                               const Wavelength& wavelength,
                                                               const Direction& in,
                                                               const Stokes& light) noexcept {
    const double s = (1 + light[1] / light.intensity()) / 2;
    const ReflectedLight reflected = reflected_light(surface, index, wavelength, {s, 1 - s});
    const double diffuse = lobe_integral(
        surface, in, wavelength, reflected.lobe(in), [](const Direction&) { return 1.0; },
        Tolerance{accuracy::hemispherical_reflectance});
    return {reflected.mirror(in), diffuse, 0};
}

HemisphericalReflectance bihemispherical_reflectance(const RoughSurface& surface, const Facets& facets,
                                                     const Wavelength& wavelength) {
    const auto along = [&](auto&& part, double theta) {
        const auto at = [&](double azimuth) {
            return std::array{part(surface, facets, wavelength, Direction::from_angles(theta, azimuth))};
        };
        if (surface.isotropic()) return at(0)[0];
        return mean_over_azimuths(surface.azimuth(), right_angle, 4,
                                  accuracy::bihemispherical_reflectance / 2, at)[0];
    };
    // the rule's error is relative; beside 1 it is absolute, as that of a mean over azimuths
    const double beside = surface.isotropic() ? 0 : 1;
    const auto mean = [&](auto&& part) {
        constexpr unsigned levels = 8;
        return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
                   [&](double cosine) { return 2 * cosine * (along(part, std::acos(cosine)) + beside); }, 0.0,
                   1.0, levels, accuracy::bihemispherical_reflectance) -
               beside;
    };
    return {mean(specular_part), mean(directional_diffuse_part), 0};
}

DiffuseAlbedoLimit largest_diffuse_albedo(const RoughSurface& surface, const Facets& facets,
                                          const Wavelength& wavelength, double steepest_theta) {
    if (!(steepest_theta >= 0 && steepest_theta <= right_angle)) {
        throw out_of_range("steepest angle of incidence", steepest_theta, "rad", "from 0 to pi/2 rad");
    }
    constexpr double step = right_angle / 30;
    const int intervals = std::max(1, static_cast<int>(std::ceil(steepest_theta / step - 1e-9)));
    const auto most_along = [&](double azimuth) {
        return maximum(0, steepest_theta, intervals, [&](double theta) {
            return directional_hemispherical_reflectance(surface, facets, wavelength,
                                                         Direction::from_angles(theta, azimuth))
                .total();
        });
    };
    Maximum most = most_along(surface.azimuth());
    if (!surface.isotropic()) {
        const Maximum across = most_along(surface.azimuth() + right_angle);
        if (across.value > most.value) most = across;
    }
    return {std::max(0.0, 1 - most.value), most.value, most.place};
}

double diffuse_albedo_from(double measured, const RoughSurface& surface, const Facets& facets,
                           const Wavelength& wavelength, const Direction& in) {
    const double lobes = directional_hemispherical_reflectance(surface, facets, wavelength, in).total();
    if (!(measured >= lobes && measured <= 1)) {
        throw out_of_range("measured reflectance", measured, "",
                           std::string{"from "}
                               .append(shortest(lobes))
                               .append(" (specular and directional-diffuse terms of the material) to 1"));
    }
    return measured - lobes;
}

}  // namespace hts::spectral
