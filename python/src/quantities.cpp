#include "quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "hts/he_torrance_gradient.hpp"
#include "spectral/energy/judgement.hpp"

namespace hts::python::quantity {
namespace {

using spectral::Reflectance;
using Pair = DirectionPair;
using Pairs = std::span<const Pair>;
using Values = std::span<double>;

/// f(reflectance, pair, values) for each pair, into its share of the places.
template <class Function>
auto pair_by_pair(Function f) {
    return [f](const Reflectance& of, Pairs pairs, Values values) {
        const std::size_t each = values.size() / pairs.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) f(of, pairs[i], values.subspan(i * each, each));
    };
}

/// One number for each pair of directions, or for each direction of light.
template <class Function>
Quantity numbers(const char* name, bool views, Function f, bool slow = false) {
    return {name, {}, views, false, slow, pair_by_pair(f), {}};
}

/// f(reflectance, pair, matrices): a Mueller matrix for each.
template <class Function>
Quantity matrices(const char* name, bool views, Function f) {
    const auto of_pair = [f](const Reflectance& of, const Pair& pair, Values values) {
        thread_local std::vector<Mueller> all;
        all.resize(of.size());
        f(of, pair, std::span{all});
        auto to = values.begin();
        for (const Mueller& matrix : all) to = std::ranges::copy(matrix.elements(), to).out;
    };
    return {name, {4, 4}, views, false, false, pair_by_pair(of_pair), {}};
}

/// f(reflectance, light, wavelength): a directional-hemispherical reflectance.
template <class Function>
Quantity albedos(const char* name, Function f) {
    const auto of_pair = [f](const Reflectance& of, const Pair& pair, Values values) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(of, pair.in, i).total();
    };
    return numbers(name, false, of_pair, true);
}

constexpr std::size_t derivative_count = 11;

template <class Value>
std::array<Value, derivative_count> in_order(const Gradient<Value>& by) {
    return {by.rms_roughness,
            by.correlation_length,
            by.n,
            by.k,
            by.diffuse_albedo,
            by.theta_i,
            by.theta_r,
            by.phi,
            by.correlation_length_x,
            by.correlation_length_y,
            by.azimuth};
}

double* put(double value, double* to) {
    *to = value;
    return to + 1;
}
double* put(const Mueller& matrix, double* to) {
    return std::ranges::copy(matrix.elements(), to).out;
}

/// How sigma_0 over all frequencies goes with the lengths where the roughness is stated for a band:
/// derivatives of ln sigma_0 by ln tau_x and by ln tau_y, differences of the band's share.
ByAxes log_roughness_by_axes(const spectral::RoughSurface& surface) {
    constexpr double step = 1e-4;
    const auto log_share = [&](double along, double across) {
        const auto& lengths = surface.correlation_lengths();
        Surface other = Surface::anisotropic(surface.rms_roughness(),
                                             {lengths.along * (1 + along), lengths.across * (1 + across)},
                                             surface.axis());
        if (surface.correlation()) other = other.correlated(*surface.correlation());
        return std::log(other.variance_share(surface.band()->from, surface.band()->to));
    };
    const auto half_slope = [&](double along, double across) {
        return (log_share(step * along, step * across) - log_share(-step * along, -step * across)) /
               (4 * step);
    };
    return {-half_slope(1, 0), -half_slope(0, 1), 0};
}

/// By the roughness of the band, and by the lengths with that kept.
template <class Value>
void state_for_band(Gradient<Value>& by, const spectral::RoughSurface& surface) {
    const double sigma = surface.rms_roughness();
    const auto& [along, across] = surface.correlation_lengths();
    const ByAxes moved = log_roughness_by_axes(surface);
    const auto by_log_roughness = sigma * by.rms_roughness;
    by.correlation_length =
        by.correlation_length + ((moved.x + moved.y) / surface.correlation_length()) * by_log_roughness;
    by.correlation_length_x = by.correlation_length_x + (moved.x / along) * by_log_roughness;
    by.correlation_length_y = by.correlation_length_y + (moved.y / across) * by_log_roughness;
    by.rms_roughness =
        (1 / std::sqrt(surface.variance_share(surface.band()->from, surface.band()->to))) * by.rms_roughness;
}

/// All derivatives that f(surface, pair, sample, films) gives.
///   films   of the material, none of thickness 0
template <class Value, class OfPair>
Quantity gradient(Shape trailing, bool views, std::size_t films, OfPair of_pair) {
    trailing.insert(trailing.begin(), static_cast<Shape::value_type>(derivative_count + 3 * films));
    const auto each = [films, of_pair](const Reflectance& of, Pairs pairs, Values out) {
        const auto& surface = *of.properties().surface;
        std::vector<ByFilm<Value>> by_film(films);
        double* to = out.data();
        for (const Pair& pair : pairs) {
            for (const SpectralSample& at : of.samples()) {
                if (at.index.film_count() != films)
                    throw Error{"gradient: films of thickness 0: must be left out, or have a thickness"};
                Gradient<Value> by = of_pair(surface, pair, at, std::span{by_film});
                if (surface.band()) state_for_band(by, surface);
                for (const Value& derivative : in_order(by)) to = put(derivative, to);
                for (const ByFilm<Value>& film : by_film)
                    for (const Value* const derivative : {&film.n, &film.k, &film.thickness})
                        to = put(*derivative, to);
            }
        }
    };
    return {"gradient", std::move(trailing), views, false, false, each, {}};
}

}  // namespace

const Quantity brdf{"brdf",
                    {},
                    true,
                    false,
                    false,
                    [](const Reflectance& of, Pairs pairs, Values values) {
                        of.evaluator().brdf_batch(pairs, values); },
                    {}};
const Quantity directional_diffuse = numbers(
    "directional_diffuse", true,
    [](const Reflectance& of, const Pair& pair, Values values) { of.directional_diffuse(pair, values); });
const Quantity specular_reflectance = numbers(
    "specular_reflectance", false,
    [](const Reflectance& of, const Pair& pair, Values values) { of.specular_reflectance(pair.in, values); });
const Quantity mueller =
    matrices("mueller", true, [](const Reflectance& of, const Pair& pair, std::span<Mueller> all) {
        of.directional_diffuse_mueller(pair, all);
    });
const Quantity diffuse_mueller =
    matrices("mueller", true,
             [](const Reflectance& of, const Pair& pair, std::span<Mueller> all) { of.mueller(pair, all); });
const Quantity specular_mueller =
    matrices("specular_mueller", false, [](const Reflectance& of, const Pair& pair, std::span<Mueller> all) {
        of.specular_mueller(pair.in, all);
    });
const Quantity albedo = albedos(
    "albedo", [](const Reflectance& of, const Direction& in, std::size_t i) { return of.albedo(in, i); });
const Quantity s_albedo =
    albedos("emissivity", [](const Reflectance& of, const Direction& in, std::size_t i) {
        return of.albedo(in, i, Stokes::s_polarised());
    });
const Quantity p_albedo =
    albedos("emissivity", [](const Reflectance& of, const Direction& in, std::size_t i) {
        return of.albedo(in, i, Stokes::p_polarised());
    });
const Quantity pdf{
    "pdf", {}, true, true, false, {}, [](const spectral::Sampler& of, Pairs pairs, Values values) {
        for (std::size_t i = 0; i < pairs.size(); ++i) values[i] = of.pdf(pairs[i].in, pairs[i].out);
    }};

const Quantity validity{"validity",
                        {3},
                        true,
                        false,
                        false,
                        pair_by_pair([](const Reflectance& of, const Pair& pair, Values values) {
                            constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
                            auto to = values.begin();
                            for (const SpectralSample& at : of.samples()) {
                                const auto judged = spectral::judgement(*of.properties().surface, pair, at);
                                *to++ = static_cast<double>(judged.severity);
                                *to++ = judged.error ? judged.error->least : unknown;
                                *to++ = judged.error ? judged.error->most : unknown;
                            }
                        }),
                        {}};

Quantity derivatives(const std::string& of, std::size_t films) {
    using At = SpectralSample;
    using Films = std::span<ByFilm<>>;
    if (of == "brdf") {
        return gradient<double>({}, true, films, [](const Surface& s, const Pair& d, const At& at, Films by) {
            return brdf_gradient({s, d.in, d.out, at.wavelength}, at.wavelength, at.index, at.uniform_diffuse,
                                 DiffuseLobe::full, by)
                .by;
        });
    }
    if (of == "mueller") {
        return gradient<Mueller>(
            {4, 4}, true, films,
            [](const Surface& s, const Pair& d, const At& at, std::span<ByFilm<Mueller>> by) {
                return directional_diffuse_mueller_gradient({s, d.in, d.out, at.wavelength}, at.wavelength,
                                                            at.index, DiffuseLobe::full, by)
                    .by;
            });
    }
    if (of == "specular") {
        return gradient<double>(
            {}, false, films, [](const Surface& s, const Pair& d, const At& at, Films by) {
                return specular_reflectance_gradient(s, view_gradient(s, d.in, at.wavelength), at.wavelength,
                                                     at.index, by)
                    .by;
            });
    }
    throw Error{"of \"" + of + "\": must be \"brdf\", \"mueller\" or \"specular\""};
}

}  // namespace hts::python::quantity
