/// Reflectance made from any density of the normals of microfacets: reciprocal, energy-conserving, with a
/// diffuse term that takes what the facets leave.
///
/// Source: Ashikhmin, Premoze, Shirley, "A microfacet-based BRDF generator", SIGGRAPH 2000, [Ashikhmin00].
/// Facets are mirrors (or Lambertian, `LambertianFacets`); one is shadowed with a probability that depends on
/// the direction alone, not on the facet.
///   rho = p(h) <h.n> F(k.h)/(4 g(k_1) g(k_2))   (26),     g(k) = <(h.k)+>   (18),     P(k)
///   = (k.n) <h.n>/g(k)   (25)
///
///     const AshikhminFacets facets{NormalDensity::gaussian(0.1, 1)};                       // once, 0.1 s
///     const AshikhminBrdf plastic{facets, FacetFresnel::schlick(0.05), 0.5};               // per wavelength
///     const double f = plastic.brdf(Direction::from_degrees(30, 0),
///                                  Direction::from_degrees(40, 180));                      // 1/sr
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hts/films/coated_index.hpp"
#include "hts/microfacet/normals/normal_density.hpp"
#include "hts/microfacet/spectrum.hpp"

namespace hts {

namespace accuracy {
inline constexpr double tabulated_area = 2e-3;  ///< of g(k) from the table, relative, mean normal along n
inline constexpr double integrated_reflectance = 1e-3;  ///< of R(k) by integration, absolute
inline constexpr double tabulated_reflectance = 1e-2;   ///< of R(k) from the table, absolute
inline constexpr double lambertian_facets = 3e-3;       ///< of `LambertianFacets::brdf` relative to albedo/pi
}  // namespace accuracy

/// How the facets reflect at one wavelength.
class FacetFresnel {
  public:
    /// f0 + (1 - f0)(1 - cos)^5 [Ashikhmin00 (31)].    f0   reflectance at normal incidence,
    /// 0 ... 1, else hts::Error
    [[nodiscard]] static FacetFresnel schlick(double f0);
    /// The reflectance of a plane interface for unpolarised light, under its films.
    [[nodiscard]] static FacetFresnel exact(const CoatedIndex& index);

    /// Reflectance [1].   cosine   of the local angle of incidence, 0 ... 1
    [[nodiscard]] double operator()(double cosine) const noexcept;
    [[nodiscard]] double at_normal() const noexcept { return f0_; }
    [[nodiscard]] bool is_schlick() const noexcept { return !index_; }

  private:
    FacetFresnel(double f0, std::optional<CoatedIndex> index) : f0_{f0}, index_{std::move(index)} {}

    double f0_;
    std::optional<CoatedIndex> index_;
};

/// Whether a facet that is lit is the more likely to be seen.
enum class FacetShadowing {
    uncorrelated,  ///< P(k_1) P(k_2) [Ashikhmin00 (13)]
    /// (1 - t) P_1 P_2 + t min(P_1, P_2), t = exp(-(phi/15 deg)^2) [Ashikhmin00 (14)], for velvets
    correlated,
};

/// What a pair of directions contributes, whatever the wavelength.
struct FacetPair {
    double cos_theta_d;  ///< of the local angle of incidence
    double lobe;         ///< BRDF of perfect mirrors [1/sr]
};

/// A density of normals with g(k) and R(k) tabulated; immutable, copies share the tables.
class AshikhminFacets {
  public:
    struct Share;

    /// Integrates g(k), at 64 elevations (isotropic: 512) and 32 azimuths per quarter turn,
    /// then R(k) at f0 = 0 and 1.
    explicit AshikhminFacets(NormalDensity density, FacetShadowing shadowing = FacetShadowing::uncorrelated);
    /// The mixture of shares, whose g(k) is that of their tables, added: only R(k) is integrated.
    ///   shares   as NormalDensity::mixture
    AshikhminFacets(const std::vector<Share>& shares, FacetShadowing shadowing);

    [[nodiscard]] const NormalDensity& density() const noexcept;
    [[nodiscard]] FacetShadowing shadowing() const noexcept;

    /// g(k) from the table [1].   error   accuracy::tabulated_area; where the mean normal is tilted, g may
    ///           nearly vanish, and its relative error reaches 1
    [[nodiscard]] double projected_area(const Direction& k) const noexcept;
    /// P(k), probability that a facet turned towards k is not hidden [Ashikhmin00 (25)]; above 1 only where
    /// the mean normal is tilted.
    [[nodiscard]] double visibility(const Direction& k) const noexcept;

    /// Geometry of a pair; a lobe of 0 where a direction grazes. Reciprocal.
    [[nodiscard]] FacetPair pair(const Direction& in, const Direction& out) const noexcept;

    /// R(k) of the facets alone [Ashikhmin00 (29)], by sums that are refined until they settle.
    ///   error   accuracy::integrated_reflectance     cost   0.1 to 3 ms
    [[nodiscard]] double integrated_reflectance(const Direction& k, const FacetFresnel& fresnel) const;
    /// R(k) for Schlick's F from the tables, linear in f0.    error   accuracy::tabulated_reflectance
    [[nodiscard]] double reflectance(const Direction& k, double f0) const noexcept;

  private:
    friend class AshikhminBrdf;
    struct Data;
    struct Seen;
    std::shared_ptr<const Data> data_;
};

struct AshikhminFacets::Share {
    double weight;
    AshikhminFacets facets;
};

/// The whole model at one wavelength, rho_s + c (t - R(k_1))(t - R(k_2)) rho_d [Ashikhmin00 (30)]; a
/// ReflectanceModel. c = 1/int (t - R) cos dw makes the albedo R(k) + rho_d (t - R(k)), so that rho_d = t = 1
/// returns all light, in every direction.
class AshikhminBrdf {
  public:
    /// A dielectric, t = 1: what the facets leave enters and is scattered.
    ///   diffuse_albedo   rho_d, 0 ... 1, else hts::Error; 0 leaves the facets alone. With an exact F and
    ///                    rho_d > 0 the constructor integrates R(k) for this F; with
    ///                    Schlick's it costs microseconds
    AshikhminBrdf(AshikhminFacets facets, FacetFresnel fresnel, double diffuse_albedo);
    /// A metal with Schlick's F, t = rho_d = f0: its diffuse light is what the facets scatter more than once;
    /// 0 where R(k) > f0 [Ashikhmin00 section 5.1].    f0   0 ... 1, else hts::Error
    [[nodiscard]] static AshikhminBrdf metal(AshikhminFacets facets, double f0);

    /// [1/sr], 0 on the horizon.
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const AshikhminBrdf> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] bool shares_geometry(const AshikhminBrdf& other) const noexcept {
        return facets_.data_ == other.facets_.data_;
    }
    /// Density in solid angle of `sample` [1/sr].
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept;
    /// Directional-hemispherical reflectance, facets and diffuse light, from the tables.
    [[nodiscard]] double albedo(const Direction& in) const noexcept;

    [[nodiscard]] const AshikhminFacets& facets() const noexcept { return facets_; }

  private:
    AshikhminBrdf(AshikhminFacets facets, FacetFresnel fresnel, double diffuse_albedo, double top);

    /// R(k).
    [[nodiscard]] double facets_reflectance(const AshikhminFacets::Seen& k) const noexcept;
    /// (t - R(k))+.
    [[nodiscard]] double left_over(const AshikhminFacets::Seen& k) const noexcept;
    [[nodiscard]] double facets_probability(const Direction& in) const noexcept;

    AshikhminFacets facets_;
    FacetFresnel fresnel_;
    double diffuse_albedo_, top_;
    double c_ = 0;
    std::shared_ptr<const class HemisphereTable> exact_reflectance_;
};

/// Lambertian facets, isotropic density, uncorrelated shadowing [Ashikhmin00 (33)]; a ReflectanceModel.
///   formula   albedo <h.n>/(pi g(k_1) g(k_2)) int (h.k_1)+ (h.k_2)+ p(h) dw; the integral over g g is
///             tabulated over the two elevations and the azimuth between
///   limit     flat facets: albedo/pi
class LambertianFacets {
  public:
    ///   facets   isotropic, else hts::Error     albedo   0 ... 1, else hts::Error
    LambertianFacets(const AshikhminFacets& facets, double albedo);

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& uniforms) const noexcept;

  private:
    double albedo_;
    std::shared_ptr<const std::vector<double>> table_;
};

static_assert(GeometrySharingModel<AshikhminBrdf> && ReflectanceModel<LambertianFacets>);

}  // namespace hts
