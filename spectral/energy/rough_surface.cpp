#include "spectral/energy/rough_surface.hpp"

#include "hts/terms.hpp"
#include "hts/unified/he_unified_spectrum.hpp"

namespace hts::spectral {
namespace {

/// Of light with these shares of s and p.
double reflected(const JonesMatrix& jones, const Polarisation& light) {
    return light.s * (std::norm(jones.ss) + std::norm(jones.ps)) +
           light.p * (std::norm(jones.sp) + std::norm(jones.pp));
}

ReflectedLight by_published_model(const Surface& surface, const Facets& facets,
                                  const Wavelength& wavelength) {
    const Surface seen = surface.seen_by(wavelength);
    return {[=](const Direction& in) {
                return facet_reflectance(facets, in.cos_theta()) *
                       coherent_fraction(surface, view(seen, in), wavelength);
            },
            [=](const Direction& in) -> ReflectedLight::Lobe {
                return [=, lit = view(seen, in)](const Direction& out, double t) {
                    const PairFactors pair{surface, lit, view(seen, out)};
                    return pair.lobe(pair.phi(pair.phase_variance(wavelength), t).value, wavelength) *
                           facet_reflectance(facets, pair.cos_theta_d());
                };
            }};
}

ReflectedLight by_published_model(const Surface& surface, const CoatedIndex& index,
                                  const Wavelength& wavelength, const Polarisation& light) {
    const ReflectedLight lossless = by_published_model(surface, PerfectMirror{}, wavelength);
    return {[=](const Direction& in) {
                const FresnelAmplitudes f = index.amplitudes(in.cos_theta());
                return lossless.mirror(in) * (light.s * std::norm(f.s) + light.p * std::norm(f.p));
            },
            [=](const Direction& in) -> ReflectedLight::Lobe {
                return [=, lobe = lossless.lobe(in)](const Direction& out, double t) {
                    const double cos_theta_d = wave_vector_change(in, out).cos_theta_d();
                    return lobe(out, t) *
                           reflected(facet_jones(in, out, index.amplitudes(cos_theta_d)), light);
                };
            }};
}

ReflectedLight by_successor(const RoughSurface& surface, const Facets& facets, const Wavelength& wavelength,
                            const Polarisation& light) {
    const auto* const index = std::get_if<CoatedIndex>(&facets);
    const HeUnifiedSpectrum model{
        surface,
        {{wavelength, index == nullptr ? CoatedIndex{perfect_conductor()} : *index, 0}},
        Tolerance{hts::accuracy::quick_kicks},
        DiffuseLobe::full,
        *surface.unified()};
    const double mixed = surface.unified()->polarisation_mixing ? mixed_share(surface) : 0;
    const Polarisation mixed_light{light.s + mixed * (light.p - light.s),
                                   light.p + mixed * (light.s - light.p)};
    return {[=](const Direction& in) {
                Mueller value;
                model.specular_mueller(in, {&value, 1});
                return value(0, 0) + (light.s - light.p) * value(0, 1);
            },
            [=](const Direction& in) -> ReflectedLight::Lobe {
                return [=, lit = model.view(in)](const Direction& out, double t) {
                    if (light.s == light.p) return model.unpolarised_lobe(lit, model.view(out), 0, t);
                    return reflected(unified_lobe(lit, model.view(out), model.waves().front(),
                                                  DiffuseLobe::full, model.tolerance(), t)
                                         .jones,
                                     mixed_light);
                };
            }};
}

}  // namespace

double facet_reflectance(const Facets& facets, double cos_theta) noexcept {
    const auto* const index = std::get_if<CoatedIndex>(&facets);
    return index == nullptr ? 1 : index->amplitudes(cos_theta).unpolarised_reflectance();
}

ReflectedLight reflected_light(const RoughSurface& surface, const Facets& facets,
                               const Wavelength& wavelength, const Polarisation& light) {
    if (surface.unified()) return by_successor(surface, facets, wavelength, light);
    const auto* const index = std::get_if<CoatedIndex>(&facets);
    if (index == nullptr || light.s == light.p) return by_published_model(surface, facets, wavelength);
    return by_published_model(surface, *index, wavelength, light);
}

double mirror_shadowing(const RoughSurface& surface, const Direction& in,
                        const Wavelength& wavelength) noexcept {
    if (surface.unified()) return 1;
    const double one_way = visibility(surface.seen_by(wavelength), in).shadowing;
    return one_way * one_way;
}

}  // namespace hts::spectral
