/// How much light a surface reflects in all: directional-hemispherical reflectance split by term, and the
/// diffuse albedo that leaves it below 1 or meets a measurement.
///
///   rho_dh(theta) = exp(-g) S |F|^2 + integral of f_dd cos(theta_r) domega + a        [He91 (5)-(8)]
///
/// The model is reciprocal, f(in, out) = f(out, in), so the hemispherical-directional reflectance (the
/// radiance seen from theta under uniform light, over that of a perfect diffuser) is the same function of
/// theta. It neither conserves nor fills energy: with mirrors for facets rho_dh reaches 1.05 and falls to
/// 0.006 at 85 degrees (`hts furnace` maps it; compensation.hpp repairs it).
/// Unpolarised light, wavelengths in vacuum, reflectances dimensionless.
#pragma once

#include "hts/polarisation.hpp"
#include "hts/terms.hpp"
#include "spectral/energy/rough_surface.hpp"

namespace hts::spectral {

namespace accuracy {
inline constexpr double hemispherical_reflectance = 4e-8;    ///< of the directional-diffuse term, relative
inline constexpr double totally_reflecting_facets = 4e-6;    ///< the same for a real index below 1
inline constexpr double bihemispherical_reflectance = 1e-5;  ///< of each term, absolute
}  // namespace accuracy

/// Shares of the incident light that the three terms reflect.
struct HemisphericalReflectance {
    double specular, directional_diffuse, uniform_diffuse;

    [[nodiscard]] double total() const noexcept { return specular + directional_diffuse + uniform_diffuse; }
};

/// rho_dh of a surface without uniform diffuse term.
///   error   specular: hts::accuracy::specular_reflectance; directional diffuse:
///           accuracy::hemispherical_reflectance, or totally_reflecting_facets where the reflectance of
///           facets has a kink, at the critical angle
///   range   0 ... about 1.05; 0 at the horizon, but 1 there for a mirror (sigma_0 = 0)
///   cost    1 to 30 ms, the more the nearer to the horizon
[[nodiscard]] HemisphericalReflectance directional_hemispherical_reflectance(const RoughSurface& surface,
                                                                             const Facets& facets,
                                                                             const Wavelength& wavelength,
                                                                             const Direction& in) noexcept;

/// The same of light in a state of polarisation, of which only the s and p parts are taken: by the mirror
/// symmetry of the surface nothing else counts, unless it is anisotropic.
///   light   of positive intensity
[[nodiscard]] HemisphericalReflectance directional_hemispherical_reflectance(const RoughSurface& surface,
                                                                             const CoatedIndex& index,
                                                                             const Wavelength& wavelength,
                                                                             const Direction& in,
                                                                             const Stokes& light) noexcept;

/// Share of uniform incident light that is reflected, 2 times the integral of rho_dh cos theta d(cos theta),
/// of a surface without uniform diffuse term.
///   error   accuracy::bihemispherical_reflectance
///   cost    some 30 of the above, of two correlation lengths some 200
[[nodiscard]] HemisphericalReflectance bihemispherical_reflectance(const RoughSurface& surface,
                                                                   const Facets& facets,
                                                                   const Wavelength& wavelength);

/// The largest diffuse albedo with which rho_dh <= 1, and what limits it.
struct DiffuseAlbedoLimit {
    double albedo;       ///< 1 - rho_max, 0 where the lobes alone reach 1
    double reflectance;  ///< rho_max, the most that specular and directional-diffuse terms reflect together
    double theta;        ///< [rad] where they do
};

/// The constraint on a(lambda), for incidence up to an angle; of an anisotropic surface along either of its
/// axes. Up to 90 deg no smooth surface leaves room for any: |F|^2 -> 1 there.
///   steepest_theta   [rad]  0 ... pi/2, else hts::Error
///   error            1e-6 absolute where rho_dh has one maximum between neighbours 3 degrees apart
[[nodiscard]] DiffuseAlbedoLimit largest_diffuse_albedo(const RoughSurface& surface, const Facets& facets,
                                                        const Wavelength& wavelength, double steepest_theta);

/// The diffuse albedo with which rho_dh at an angle is a measured one, as [He91, section 4.5] finds 0.15 for
/// a plastic from 0.195 at the normal: a = measured - specular - directional diffuse.
///   measured   what an integrating sphere sees, mirror direction included; at least what the two terms
///              reflect and at most 1, else hts::Error
[[nodiscard]] double diffuse_albedo_from(double measured, const RoughSurface& surface, const Facets& facets,
                                         const Wavelength& wavelength, const Direction& in);

}  // namespace hts::spectral
