/// Densities p(h) of the normals of microfacets, over the whole sphere, as Ashikhmin, Premoze and Shirley use
/// them: their values, their averages, their projected areas, and normals drawn from them.
///
/// Source: "A microfacet-based BRDF generator", SIGGRAPH 2000, [Ashikhmin00]. A density gives the share of
/// the surface's *own* area per solid angle of the normal, not of its projection; the integral over the
/// sphere is 1. n = +z is the normal of the mean surface. Widths (sigma) are as the paper writes a Gaussian:
/// exp(-x^2/sigma^2), without a factor of 2.
///
///     const auto satin = NormalDensity::mixture({{0.7, NormalDensity::gaussian(0.1, infinity)},
///                                                {0.3, NormalDensity::gaussian(0.3, infinity)}});
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hts/microfacet/model.hpp"

namespace hts {

namespace accuracy {
/// Of `NormalDensity::projected_area`, relative to the mean over directions, 1/4: analytic densities
/// (adaptive quadrature) ...
inline constexpr double projected_area = 1e-9;
/// ... and sampled ones, `tabulated` and `image` (fixed points, 192 by 192 or more).
inline constexpr double projected_area_of_samples = 2e-4;
}  // namespace accuracy

/// What leaves a density as it is: any turn about n; changing the sign of x; changing that of y.
struct NormalSymmetry {
    bool isotropic, mirror_x, mirror_y;
};

/// A warning, no error: the mean normal is not parallel to n, so no surface has this density and the
/// reflectance made from it may exceed 1 [Ashikhmin00 (22), section 6.4].
struct TiltedMean {
    double angle;  ///< between mean normal and n   [rad]
    [[nodiscard]] std::string text() const;
};

/// A normal with the share of area it stands for in a sum that replaces an integral of p(h).
struct WeightedNormal {
    Vector3 normal;
    double weight;
};

/// Values over a grid: rows one after another.
struct ValueGrid {
    std::size_t rows, columns;
    std::vector<double> values;  ///< rows * columns of them, >= 0 and finite
};

class NormalLobe;

/// An immutable density of normals; copies share their data.
class NormalDensity {
  public:
    struct Share;

    /// Gaussian slopes, for facets that face up: c exp(-tan^2 theta (cos^2 phi/sigma_x^2 + sin^2
    /// phi/sigma_y^2)) [Ashikhmin00 (34)].
    ///   sigma_x, sigma_y   1e-4 ... infinity, else hts::Error. Infinite in y: cylinders along x's normal
    ///                      plane, whose normals lie about the plane x = 0 (fibres along x)
    [[nodiscard]] static NormalDensity gaussian(double sigma_x, double sigma_y);

    /// Symmetric V-grooves along y: two Gaussian lobes, half the area each, about the normals tilted by
    /// +-slope in the plane of x [Ashikhmin00 section 6.2: 40 deg, 0.1].
    ///   slope   [rad]  0 ... pi/2 exclusive     sigma   width of each lobe, 1e-4 ...
    ///           infinity; else hts::Error
    [[nodiscard]] static NormalDensity grooves(double slope, double sigma);

    /// Upright fibres, velvet: c exp(-cot^2 theta/sigma^2), theta < 90 deg [Ashikhmin00 (35)].
    ///   sigma   0.1 ... infinity, else hts::Error; infinity: all upward normals alike
    [[nodiscard]] static NormalDensity inverse_gaussian(double sigma);

    /// Slanted velvet [Ashikhmin00 section 6.4: 0.5, 40 deg]: the upper sides of fibres that lean in the
    /// plane of x, `gaussian(sigma, infinity)` with its pole tilted from n by 90 deg - slant towards -x. The
    /// tops of the fibres add as much again to <h.n> and nothing else, as in the paper. Not a
    /// surface: see `tilted_mean`.
    ///   sigma   1e-4 ... infinity     slant   of the fibres from n [rad], 0 ... pi/2; else hts::Error
    [[nodiscard]] static NormalDensity slanted_fibres(double sigma, double slant);

    /// Bilinear in (theta, phi) between values of any common scale: row i at theta = i 90 deg/(rows - 1),
    /// column j at phi = j 360 deg/columns. One column: isotropic. Facets that face down have density 0.
    ///   grid   2 ... 4096 rows, 1 ... 4096 columns, not all zero; else hts::Error
    [[nodiscard]] static NormalDensity tabulated(ValueGrid grid);

    /// `gaussian` times a picture of the normals seen from above [Ashikhmin00 section 6.5]:
    /// its pixels span |h_x| and
    /// |h_y| <= extent, the first row towards +y, bilinear between their centres, and 0 outside.
    ///   extent   of the picture, sine of a polar angle, 0 exclusive ... 1; grid as for
    ///            `tabulated`, else hts::Error
    [[nodiscard]] static NormalDensity image(double sigma_x, double sigma_y, ValueGrid pixels, double extent);

    /// The sum of densities by their shares of the area, which are scaled to add up to 1.
    ///   shares   at least one, each weight > 0 and finite, else hts::Error
    [[nodiscard]] static NormalDensity mixture(const std::vector<Share>& shares);

    /// p(h) [1/sr].   h   unit vector, up or down
    [[nodiscard]] double operator()(Vector3 h) const noexcept;

    /// Average normal <h>, over the sphere.
    [[nodiscard]] Vector3 mean() const noexcept { return mean_; }
    /// <h.n>, that of the hidden tops of `slanted_fibres` included   [1]
    [[nodiscard]] double projection() const noexcept { return projection_; }
    /// Nothing where the mean normal is within 0.01 rad of n.
    [[nodiscard]] std::optional<TiltedMean> tilted_mean() const;

    /// g(k), the area of the facets turned towards k as seen from there, <(h.k)+> [Ashikhmin00 (18)]. For
    /// Gaussian lobes, with 1/(1 + q^2)^2 = int_0^inf s exp(-s(1 + q^2)) ds over the slopes q, in
    /// one dimension (derived):
    ///   c pi int_0^inf s e^-s ((a_x + s)(a_y + s))^(-1/2) (k_z N(k_z/d) + d N'(k_z/d)) ds,   a = 1/sigma^2,
    ///   d^2 = (k_x^2/(a_x + s) + k_y^2/(a_y + s))/2, N the normal distribution
    ///   k   unit vector, up or down     error   accuracy::projected_area     cost   10
    ///       to 100 us: tables hold it
    [[nodiscard]] double projected_area(Vector3 k) const;

    /// Draws a normal from a closed-form density near p: p <= 1.5 pdf for Gaussian lobes and velvet.
    [[nodiscard]] Vector3 sample(const Uniforms& uniforms) const noexcept;
    /// Density of `sample` at h [1/sr]; its integral over the sphere is 1.
    [[nodiscard]] double pdf(Vector3 h) const noexcept;

    /// Points that replace integrals: int f p dw ~ sum of f weight, per_side^2 points for
    /// each share of a mixture.
    [[nodiscard]] std::vector<WeightedNormal> quadrature(std::size_t per_side) const;

    [[nodiscard]] NormalSymmetry symmetry() const noexcept { return symmetry_; }
    /// Polar angle over which the projected area bends at the horizon, towards x and
    /// towards y [rad], at most 1.
    [[nodiscard]] double width_x() const noexcept { return width_x_; }
    [[nodiscard]] double width_y() const noexcept { return width_y_; }

  private:
    struct Part {
        double share;
        std::shared_ptr<const NormalLobe> lobe;
    };

    NormalDensity(std::vector<Part> parts, NormalSymmetry symmetry, double width_x, double width_y);

    std::vector<Part> parts_;
    NormalSymmetry symmetry_;
    double width_x_, width_y_;
    Vector3 mean_;
    double projection_ = 0;
};

struct NormalDensity::Share {
    double weight;
    NormalDensity density;
};

}  // namespace hts
