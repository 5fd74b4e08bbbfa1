/// Rough conductors and dielectrics as facets that reflect and refract, each as a small plane interface:
/// Walter, Marschner, Li, Torrance, Microfacet models for refraction through rough surfaces, EGSR 2007
/// [Walter07]. Geometric optics, single scattering, unpolarised light.
///
///   reflection   f_r = F G
///                D(h_r) / (4 (i.n)(o.n)) (20)
///   refraction   f_t = |i.h_t||o.h_t|/((i.n)(o.n)) eta_o^2 (1 - F) G D(h_t) /
///                |eta_i i + eta_o o|^2 (21)
///
/// i points towards the light, o towards the viewer, n on the side of i; G = G_1(i) G_1(o) (23), D and G_1
/// from distribution.hpp. `WalterBrdf` is reflection from the front alone, off metals and glass alike, and a
/// ReflectanceModel; `WalterBsdf` is both, on both sides of a rough interface of two transparent media.
///
/// Energy. Light that facets send into other facets is lost. With F = 1 the albedo is the mean of G_1(o) over
/// the visible normals whose reflection leaves, so it is at most 1 (SmithForm::exact): at alpha 0.5 Beckmann
/// keeps 0.943 of the light at 0 deg and 0.918 at 80 deg, GGX 0.688 and 0.747
/// (hts/microfacet/tests/reference/walter_furnace.csv).
///
/// Roughness to none. As alpha -> 0 the lobes become those of a mirror and of Snell's
/// law with Fresnel's shares.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>

#include "hts/films/coated_index.hpp"
#include "hts/microfacet/distribution.hpp"
#include "hts/microfacet/spectrum.hpp"

namespace hts {

namespace accuracy {
/// Of the BRDF and BSDF, relative, for alpha >= 0.01, indices apart by 0.1 or more and lobes above 1e-30 of
/// their peak: the last bits of the directions, over alpha.
inline constexpr double microfacet = 1.4e-12;
inline constexpr double facet_reflectance = 1.7e-15;  ///< absolute
}  // namespace accuracy

/// The facet that sends one direction into another.
struct Facet {
    Vector3 normal;   ///< unit, on the side of `in`; z <= 0 where no facet of the surface does it
    double cos_in;    ///< in.normal
    double cos_out;   ///< |out.normal|
    double jacobian;  ///< solid angle of normals per solid angle of `out`, (14) or (17)
};

/// Reflection: h_r of (13). Both directions above the horizon.
[[nodiscard]] Facet mirror_facet(const Direction& in, const Direction& out) noexcept;

/// What a facet reflects of unpolarised light, `fresnel(...).unpolarised_reflectance()` in real
/// arithmetic, which is quicker.
///   cos_in   0 ... 1    range   0 ... 1; 1 in total reflection
///   error    accuracy::facet_reflectance, absolute, away from the critical angle
[[nodiscard]] double facet_reflectance(double cos_in, const CoatedIndex& index) noexcept;

/// Reflection by one side of a rough surface, times facet_reflectance(cos_in, index) at each wavelength.
struct FacetLobe {
    double cos_in;  ///< cosine of incidence on the facet
    double value;   ///< G D / (4 (i.n)(o.n)), the BRDF for F = 1 [1/sr]; 0 on the horizon
};

[[nodiscard]] FacetLobe facet_lobe(const FacetDistribution& facets, const Direction& in,
                                   const Direction& out) noexcept;

/// Reflection from the front, (20): a ReflectanceModel.
///
///     const hts::WalterBrdf gold{hts::FacetDistribution::ggx(0.2), {0.18, 3.4}};
///     const double f = gold.brdf(hts::Direction::from_degrees(30, 0),
///                                hts::Direction::from_degrees(40, 170));
class WalterBrdf {
  public:
    ///   index   of the surface, relative to the medium in front: complex of a metal, k = 0
    ///           of glass; with its films
    WalterBrdf(const FacetDistribution& facets, CoatedIndex index,
               NormalDraw normals = NormalDraw::visible) noexcept
        : facets_{facets}, index_{std::move(index)}, normals_{normals} {}

    /// f_r [1/sr]; reciprocal.    error   accuracy::microfacet
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const WalterBrdf> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] bool shares_geometry(const WalterBrdf& other) const noexcept {
        return facets_ == other.facets_;
    }
    /// Density of `sample` [1/sr], normal_pdf times the Jacobian (38).
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    /// Mirrors `in` at a normal drawn with uniforms 0 and 1 (39). Weight F G |i.m| D/((i.n) p_m), which is
    /// (41) times F for NormalDraw::all and F G_1(out) for visible ones; 0 where the mirrored direction
    /// falls below the horizon.
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept;

    [[nodiscard]] const CoatedIndex& index() const noexcept { return index_; }
    /// Of the facets alone.
    [[nodiscard]] FacetLobe lobe(const Direction& in, const Direction& out) const noexcept {
        return facet_lobe(facets_, in, out);
    }

  private:
    FacetDistribution facets_;
    CoatedIndex index_;
    NormalDraw normals_;
};

static_assert(GeometrySharingModel<WalterBrdf>);

/// The side of an interface that a direction points to; its front is where the outward normal +z points.
enum class Side { front, back };

/// A direction that points away from an interface to either side. `direction` is measured from that side's
/// own normal, so it is always "above" its side; x and y, and so azimuths, are those of the front. Straight
/// on through the interface from (theta, phi) leads to the other side's (theta, phi + 180 deg).
struct SidedDirection {
    Side side;
    Direction direction;

    /// In the frame of the front: z < 0 on the back.
    [[nodiscard]] Vector3 vector() const noexcept {
        const Vector3 v = direction.vector();
        return {v.x, v.y, side == Side::front ? v.z : -v.z};
    }
};

/// Which way a path is traced, and so what `sample` weights.
enum class PathFrom {
    light,  ///< the known direction leads to the light, that drawn to the viewer: photons, with their power
    eye,    ///< the known direction leads to the viewer, that drawn to the light: radiance is gathered
};

/// A direction drawn by a BSDF. `weight` and `pdf` are 0 where nothing was drawn.
struct DrawnScattering {
    SidedDirection out;
    double weight;
    double pdf;  ///< [1/sr]
};

/// Reflection and refraction by a rough interface of two transparent media, (19), from both sides.
///
///     const hts::WalterBsdf glass{hts::FacetDistribution::ggx(0.394), 1.0, 1.51};
///     const hts::SidedDirection light{hts::Side::front, hts::Direction::from_degrees(30, 0)};
///     const hts::SidedDirection view{hts::Side::back, hts::Direction::from_degrees(20, 180)};
///     const double f = glass.bsdf(light, view);
class WalterBsdf {
  public:
    ///   front_index, back_index   real indices of the two media   0.01 ... 100, apart by at least 1e-6 of
    ///                             the greater, else hts::Error; the error of refraction
    ///                             grows as 1/(their difference)
    WalterBsdf(const FacetDistribution& facets, double front_index, double back_index,
               NormalDraw normals = NormalDraw::visible);
    /// With films between the two media, which reflect F and let T through in place of 1 - F. `sample` draws
    /// reflection with probability F, so its weight of refraction has a factor T/(1 - F) where films absorb.
    ///   back   the medium behind, k = 0, and the films, relative to vacuum
    WalterBsdf(const FacetDistribution& facets, double front_index, const CoatedIndex& back,
               NormalDraw normals = NormalDraw::visible);

    /// Radiance that leaves along `out` per irradiance from `in` [1/sr]: f_r on one side, f_t
    /// across. 0 on the horizon.
    ///   reciprocity   f_r(i, o) = f_r(o, i);  f_t(i, o)/eta_o^2 = f_t(o, i)/eta_i^2. The adjoint, for
    ///                 importance carried as if it were radiance, is bsdf(out, in)
    ///   error         accuracy::microfacet
    [[nodiscard]] double bsdf(const SidedDirection& in, const SidedDirection& out) const noexcept;

    /// Density of `sample` drawing `out`, whichever way the path goes [1/sr].
    [[nodiscard]] double pdf(const SidedDirection& known, const SidedDirection& out) const noexcept;

    /// Draws a normal with uniforms 0 and 1, reflects where uniform 2 is below its Fresnel reflectance and
    /// refracts elsewhere: (39), (40) with the square of eta that the first print lacks. Total reflection
    /// needs no case of its own.
    ///   from light   weight bsdf(known, out) cos theta_out / pdf = (41), G_1(out) for visible normals
    ///   from eye     weight bsdf(out, known) cos theta_out / pdf = the same times (eta_known/eta_out)^2:
    ///                radiance is compressed into the denser medium
    [[nodiscard]] DrawnScattering sample(const SidedDirection& known, const Uniforms& uniforms,
                                         PathFrom from = PathFrom::light) const noexcept;

  private:
    /// The media as one direction meets them.
    struct Media {
        double eta_in, eta_out;
        CoatedIndex relative;  // eta_out/eta_in, under the films
    };
    [[nodiscard]] const Media& media(Side side) const noexcept {
        return side == Side::front ? front_ : back_;
    }
    /// What sends one direction into another: a facet, F or T there, and the probability with which it is
    /// drawn; all 0 where there is none.
    struct Event {
        Facet facet;
        double share, chance;
    };
    [[nodiscard]] Event event(const SidedDirection& in, const SidedDirection& out) const noexcept;
    [[nodiscard]] double share(const Facet& facet, const Media& media, bool reflected) const noexcept;
    [[nodiscard]] double chance(const Facet& facet, const Media& media, bool reflected) const noexcept;

    FacetDistribution facets_;
    Media front_, back_;
    NormalDraw normals_;
};

/// Reflects as WalterBrdf does, and where the material is transparent lets the rest through: a
/// TransmittingModel. A diffuse albedo, which the paper has not, stands for what a pigment inside sends back:
/// it adds albedo/pi, and nothing passes through. It is not reduced by what the facets reflect, so that
/// both together may exceed 1.
class WalterInterface : public WalterBrdf {
  public:
    ///   index            of the material, transparent if k = 0: then as WalterBsdf wants it
    ///   exterior_index   of the transparent medium in front
    ///   diffuse_albedo   0 ... 1, else hts::Error
    WalterInterface(const FacetDistribution& facets, const CoatedIndex& index, double exterior_index,
                    double diffuse_albedo = 0);

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const WalterInterface> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    /// Chooses the diffuse term by uniform 2.
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept;
    [[nodiscard]] bool transmits() const noexcept { return glass_.has_value(); }
    [[nodiscard]] double btdf(const Direction& in, const Direction& behind) const noexcept {
        return glass_ ? glass_->bsdf({Side::front, in}, {Side::back, behind}) : 0;
    }

  private:
    /// Share of the draws that go to the diffuse term.
    [[nodiscard]] double diffuse_share(const Direction& in) const noexcept;

    std::optional<WalterBsdf> glass_;
    double diffuse_albedo_;
};

static_assert(GeometrySharingModel<WalterInterface> && TransmittingModel<WalterInterface>);

/// A glass that the paper measured: widths fitted at normal incidence with index 1.51, and the scale from the
/// fitted model to its relative measurements (its Fig. 12).
struct MeasuredGlass {
    const char* name;
    double beckmann_scale, beckmann_alpha;
    double ggx_scale, ggx_alpha;

    /// In air, of the shape of the fit: Beckmann or GGX.
    [[nodiscard]] WalterBsdf bsdf(FacetShape shape) const;
};

inline constexpr double measured_glass_index = 1.51;
inline constexpr std::array<MeasuredGlass, 4> measured_glasses{{
    {"ground", 0.542, 0.344, 0.755, 0.394},
    {"frosted", 0.629, 0.400, 0.861, 0.454},
    {"etched", 0.711, 0.493, 0.955, 0.553},
    {"antiglare", 0.607, 0.023, 0.847, 0.027},
}};

}  // namespace hts
