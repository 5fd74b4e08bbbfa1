#include "spectral/energy/energy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>

#include "hts/error.hpp"
#include "spectral/energy/lobe_integral.hpp"

namespace hts::spectral {
namespace {

constexpr double right_angle = std::numbers::pi / 2;

double specular_part(const Surface& surface, const Facets& facets, const Wavelength& wavelength,
                     const View& in) {
    return facet_reflectance(facets, in.direction.cos_theta()) * coherent_fraction(surface, in, wavelength);
}

double directional_diffuse_part(const Surface& surface, const Facets& facets, const Wavelength& wavelength,
                                const View& in) {
    return lobe_integral(
        surface, in, wavelength,
        [&](const PairFactors& pair, const Direction&) {
            return facet_reflectance(facets, pair.cos_theta_d());
        },
        Tolerance{accuracy::hemispherical_reflectance});
}

/// Where in from ... to a function is largest: the best of equally spaced points, refined between its neighbours.
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

double facet_reflectance(const Facets& facets, double cos_theta) noexcept {
    const auto* const index = std::get_if<RefractiveIndex>(&facets);
    return index == nullptr ? 1 : fresnel(cos_theta, *index).unpolarised_reflectance();
}

HemisphericalReflectance directional_hemispherical_reflectance(const Surface& surface, const Facets& facets,
                                                               const Wavelength& wavelength,
                                                               const Direction& in) noexcept {
    const View seen = view(surface, in);
    return {specular_part(surface, facets, wavelength, seen),
            directional_diffuse_part(surface, facets, wavelength, seen), 0};
}

HemisphericalReflectance directional_hemispherical_reflectance(const Surface& surface,
                                                               const RefractiveIndex& index,
                                                               const Wavelength& wavelength,
                                                               const Direction& in,
                                                               const Stokes& light) noexcept {
    const View seen = view(surface, in);
    const double s = (1 + light[1] / light.intensity()) / 2, p = 1 - s;  // shares of the light
    const FresnelAmplitudes mirror = fresnel(in.cos_theta(), index);
    const double specular =
        coherent_fraction(surface, seen, wavelength) * (s * std::norm(mirror.s) + p * std::norm(mirror.p));
    const double diffuse = lobe_integral(
        surface, seen, wavelength,
        [&](const PairFactors& pair, const Direction& out) {
            const JonesMatrix facet = facet_jones(in, out, fresnel(pair.cos_theta_d(), index));
            return s * (std::norm(facet.ss) + std::norm(facet.ps)) +
                   p * (std::norm(facet.sp) + std::norm(facet.pp));
        },
        Tolerance{accuracy::hemispherical_reflectance});
    return {specular, diffuse, 0};
}

HemisphericalReflectance bihemispherical_reflectance(const Surface& surface, const Facets& facets,
                                                     const Wavelength& wavelength) {
    const auto mean = [&](auto&& part) {
        constexpr unsigned levels = 8;
        return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
            [&](double cosine) {
                const View in = view(surface, Direction::from_angles(std::acos(cosine), 0));
                return 2 * cosine * part(surface, facets, wavelength, in);
            },
            0.0, 1.0, levels, accuracy::bihemispherical_reflectance);
    };
    return {mean(specular_part), mean(directional_diffuse_part), 0};
}

DiffuseAlbedoLimit largest_diffuse_albedo(const Surface& surface, const Facets& facets,
                                          const Wavelength& wavelength, double steepest_theta) {
    if (!(steepest_theta >= 0 && steepest_theta <= right_angle)) {
        throw out_of_range("steepest angle of incidence", steepest_theta, "rad", "from 0 to pi/2 rad");
    }
    constexpr double step = right_angle / 30;
    const int intervals = std::max(1, static_cast<int>(std::ceil(steepest_theta / step - 1e-9)));
    const Maximum most = maximum(0, steepest_theta, intervals, [&](double theta) {
        return directional_hemispherical_reflectance(surface, facets, wavelength,
                                                     Direction::from_angles(theta, 0))
            .total();
    });
    return {std::max(0.0, 1 - most.value), most.value, most.place};
}

double diffuse_albedo_from(double measured, const Surface& surface, const Facets& facets,
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
