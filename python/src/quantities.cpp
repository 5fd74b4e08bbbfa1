#include "quantities.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
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
Quantity numbers(const char* name, bool views, Function f) {
    return {name, {}, views, false, pair_by_pair(f), {}};
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
    return {name, {4, 4}, views, false, pair_by_pair(of_pair), {}};
}

/// f(reflectance, light, wavelength): a directional-hemispherical reflectance.
template <class Function>
Quantity albedos(const char* name, Function f) {
    return numbers(name, false, [f](const Reflectance& of, const Pair& pair, Values values) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(of, pair.in, i).total();
    });
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

/// All derivatives that f(surface, pair, sample) gives.
template <class OfPair>
Quantity gradient(Shape trailing, bool views, OfPair of_pair) {
    return {"gradient",
            std::move(trailing),
            views,
            false,
            [of_pair](const Reflectance& of, Pairs pairs, Values out) {
                const auto& surface = of.properties().surface;
                double* to = out.data();
                for (const Pair& pair : pairs) {
                    for (const SpectralSample& at : of.samples()) {
                        if (at.index.coated()) throw Error{"gradient: must be of a surface without films"};
                        for (const auto& derivative : in_order(of_pair(*surface, pair, at))) {
                            if constexpr (std::is_same_v<decltype(derivative), const double&>) {
                                *to++ = derivative;
                            } else {
                                to = std::ranges::copy(derivative.elements(), to).out;
                            }
                        }
                    }
                }
            },
            {}};
}

}  // namespace

const Quantity brdf{
    "brdf",
    {},
    true,
    false,
    [](const Reflectance& of, Pairs pairs, Values values) { of.evaluator().brdf_batch(pairs, values); },
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
const Quantity pdf{"pdf", {}, true, true, {}, [](const spectral::Sampler& of, Pairs pairs, Values values) {
                       for (std::size_t i = 0; i < pairs.size(); ++i)
                           values[i] = of.pdf(pairs[i].in, pairs[i].out);
                   }};

const Quantity validity{"validity",
                        {3},
                        true,
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

Quantity derivatives(const std::string& of) {
    using At = SpectralSample;
    if (of == "brdf") {
        return gradient({derivative_count}, true, [](const Surface& s, const Pair& d, const At& at) {
            return brdf_gradient({s, d.in, d.out}, at.wavelength, at.index.substrate(), at.uniform_diffuse)
                .by;
        });
    }
    if (of == "mueller") {
        return gradient({derivative_count, 4, 4}, true, [](const Surface& s, const Pair& d, const At& at) {
            return directional_diffuse_mueller_gradient({s, d.in, d.out}, at.wavelength, at.index.substrate())
                .by;
        });
    }
    if (of == "specular") {
        return gradient({derivative_count}, false, [](const Surface& s, const Pair& d, const At& at) {
            return specular_reflectance_gradient(s, view_gradient(s, d.in), at.wavelength,
                                                 at.index.substrate())
                .by;
        });
    }
    throw Error{"of \"" + of + "\": must be \"brdf\", \"mueller\" or \"specular\""};
}

}  // namespace hts::python::quantity
