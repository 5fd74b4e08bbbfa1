/// How steep the facets of an isotropic rough surface are: distributions of their normals, what each
/// direction sees of them, and draws of normals. Source: Walter, Marschner, Li, Torrance 2007, section 5.2
/// and appendix A [Walter07].
///
/// A normal m is a vector in the frame of the surface, z along the outward normal n; D(m) is facet area per
/// solid angle and per area of the surface, so the integral of D(m) (m.n) is 1 (4). The shadowing G_1 is
/// Smith's for a facet of known normal, 1/(1 + Lambda): not the average over normals that He et al. use
/// (shadowing.hpp). It says nothing of facets that face away, (v.m) <= 0; whoever uses it leaves those out.
#pragma once

#include "hts/direction.hpp"

namespace hts {

namespace accuracy {
/// Of D, relative, where D exceeds 1e-30 of its peak; beside it the last bits of m.x/m.z
/// count with the slope of ln D.
inline constexpr double facet_density = 3e-14;
inline constexpr double facet_shadowing = 7e-16;  ///< of Beckmann's and GGX's G_1, SmithForm::exact, relative
inline constexpr double phong_shadowing = 9e-16;  ///< of Phong's G_1, SmithForm::exact, relative
inline constexpr double rational_smith =
    0.0035;  ///< of Beckmann's G_1, SmithForm::rational, relative to exact
inline constexpr double visible_draw =
    4e-15;  ///< of the distribution function at the slope of a visible normal
}  // namespace accuracy

enum class FacetShape { beckmann, phong, ggx };

/// How G_1 of Beckmann and Phong is computed; GGX has one form.
enum class SmithForm {
    exact,     ///< Smith's of the distribution's own slopes: (26) for Beckmann
    rational,  ///< (27), cheaper: within accuracy::rational_smith of Beckmann's
};

/// Which normals are drawn for light from a direction v.
enum class NormalDraw {
    /// in proportion to the area that v sees: D G_1(v) (v.m)/(v.n); weights of reflection are G_1(out)
    visible,
    /// in proportion to D (m.n) (24): the paper's first way, whose weights at grazing have no useful bound
    all,
    /// as `all`, from a distribution wider by 1.2 - 0.2 sqrt(v.n): bounds them, Beckmann's by about 4
    widened,
};

/// A distribution of normals with its shadowing.
///
///     const auto ground_glass = hts::FacetDistribution::ggx(0.394);
///
/// Every call is noexcept, total and allocates nothing.
class FacetDistribution {
  public:
    /// Gaussian slopes, D = exp(-tan^2/alpha^2)/(pi alpha^2 cos^4) (25); of He et al.'s
    /// surface alpha = 2 sigma/tau.
    ///   alpha   width [1], sqrt(2) times the rms slope   1e-6 ... 1e3, else hts::Error
    [[nodiscard]] static FacetDistribution beckmann(double alpha, SmithForm form = SmithForm::exact);

    /// D = (exponent + 2)/(2 pi) cos^exponent (30).
    ///   exact      (48) does have a closed form: Lambda = C sin^(e+2)/((e + 1) cos) - I(sin^2; e/2 + 1,
    ///              1/2)/2 with the incomplete beta function, C = Gamma((e + 3)/2)/(sqrt(pi) Gamma((e +
    ///              2)/2)); some microseconds
    ///   rational   as the paper advises, (27) at alpha(). At grazing that is too large, by up to sqrt(pi)
    ///              for exponent 0, and a rough surface then reflects more light than falls in
    ///   exponent   0 ... 1e12, else hts::Error
    [[nodiscard]] static FacetDistribution phong(double exponent, SmithForm form = SmithForm::exact);

    /// D = alpha^2/(pi cos^4 (alpha^2 + tan^2)^2) (33), G_1 = 2/(1 + sqrt(1 + alpha^2 tan^2)) (34).
    ///   alpha   width [1]   1e-6 ... 1e3, else hts::Error
    [[nodiscard]] static FacetDistribution ggx(double alpha);

    [[nodiscard]] bool operator==(const FacetDistribution&) const noexcept = default;
    [[nodiscard]] FacetShape shape() const noexcept { return shape_; }
    /// The width; of Phong that of the Beckmann distribution like it, sqrt(2/(exponent + 2)).
    [[nodiscard]] double alpha() const noexcept { return alpha_; }

    /// D(m) [1/sr].
    ///   normal   m, of any length    range   >= 0; 0 where m.z <= 0    error   accuracy::facet_density
    [[nodiscard]] double density(Vector3 normal) const noexcept;

    /// G_1(v), the part of the facets turned towards v that no other hides from it [1].
    ///   range   (0, 1], 1 along the normal, 0 at the horizon    error   accuracy::facet_shadowing,
    ///           phong_shadowing or rational_smith
    [[nodiscard]] double shadowing(const Direction& v) const noexcept {
        return v.cos_theta() > 0 ? v.cos_theta() * shadowing_over_cosine(v) : 0;
    }
    /// G_1(v)/(v.n), as reflection has it [1].    v   above the horizon
    [[nodiscard]] double shadowing_over_cosine(const Direction& v) const noexcept;

    /// A unit normal drawn for light from v.
    ///   u0, u1   independent, uniform in [0, 1)
    ///   visible  Beckmann: the slope along v by Newton's method on the logarithm of its distribution
    ///            function, to accuracy::visible_draw; GGX: a cap of the sphere [Dupuy23]; Phong has no such
    ///            draw and takes the visible normals of GGX at the same alpha(), which
    ///            bounds its weights by 2.7
    ///   all      (28), (29), (31), (32), (35), (36), with 1 - u0 for Phong's xi_1
    [[nodiscard]] Vector3 normal(const Direction& v, double u0, double u1, NormalDraw which) const noexcept;

    /// Density p_m in solid angle of drawing a unit normal m [1/sr]; its integral over
    /// all m is 1, rounding apart.
    ///   v        above the horizon    range   >= 0, 0 where no such m is drawn
    [[nodiscard]] double normal_pdf(const Direction& v, Vector3 m, NormalDraw which) const noexcept;

  private:
    FacetDistribution(FacetShape shape, double alpha, double exponent, SmithForm form) noexcept
        : shape_{shape}, form_{form}, alpha_{alpha}, exponent_{exponent} {}

    [[nodiscard]] FacetDistribution widened_for(const Direction& v) const noexcept;
    [[nodiscard]] FacetDistribution with_visible_draw() const noexcept;
    [[nodiscard]] double tan_squared(double u) const noexcept;
    [[nodiscard]] Vector3 any_normal(double u0, double u1) const noexcept;

    FacetShape shape_;
    SmithForm form_;
    double alpha_;
    double exponent_;  // of Phong
};

}  // namespace hts
