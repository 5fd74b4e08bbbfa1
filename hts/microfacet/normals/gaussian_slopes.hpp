/// Facets whose slopes are Gaussian, of two widths: the normals of Kurt's, Ward's, Duer's and Cook and
/// Torrance's models. For one width Beckmann's distribution.
#pragma once

#include "hts/microfacet/lobes.hpp"

namespace hts {

class GaussianSlopes {
  public:
    ///   mx, my   widths of the slopes along x and y, sqrt(2) times their rms   [1]   1e-6
    ///            ... 1e3, else hts::Error
    GaussianSlopes(double mx, double my);

    [[nodiscard]] double mx() const noexcept { return mx_; }
    [[nodiscard]] double my() const noexcept { return my_; }
    [[nodiscard]] bool operator==(const GaussianSlopes&) const noexcept = default;

    /// q = exp(-tan^2 theta_h (cos^2 phi_h/mx^2 + sin^2 phi_h/my^2)) [Kurt10 (4)].
    [[nodiscard]] double shape(const HalfDirection& half) const noexcept;
    /// D = q/(pi mx my cos^4 theta_h) [Kurt10 (5)]; the integral of D cos theta_h is 1 [1/sr].
    [[nodiscard]] double density(const HalfDirection& half) const noexcept;
    /// Density of the direction that a drawn normal mirrors to, D cos theta_h/(4 cos
    /// theta_d) [Kurt10 (20)] [1/sr].
    [[nodiscard]] double outgoing_pdf(const HalfDirection& half) const noexcept;
    /// A normal with the density D cos theta_h [Kurt10 (16), (17)]: its slopes are sqrt(-ln(1 - u1)) times
    /// (mx cos 2 pi u2, my sin 2 pi u2), which has (17) in the quadrant of 2 pi u2.
    [[nodiscard]] Vector3 normal(double u1, double u2) const noexcept;

  private:
    double mx_, my_;
};

/// What lobes with such facets share: where they draw.
class SlopeLobe {
  public:
    SlopeLobe(double mx, double my) : slopes_{mx, my} {}

    [[nodiscard]] const GaussianSlopes& slopes() const noexcept { return slopes_; }
    [[nodiscard]] bool same_facets(const SlopeLobe& other) const noexcept { return slopes_ == other.slopes_; }
    /// [Kurt10 (20)].
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    /// [Kurt10 (16)-(19)].
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;

  private:
    GaussianSlopes slopes_;
};

}  // namespace hts
