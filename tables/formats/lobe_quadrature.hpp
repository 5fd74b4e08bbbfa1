/// Directions of view to integrate over: some drawn around the lobe, as many in proportion to the cosine,
/// with the weights of the balance heuristic (Veach and Guibas, SIGGRAPH 1995). Private
/// to the exchange formats.
#pragma once

#include <utility>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Facets with Gaussian slopes: density of a pair's view when the light is mirrored by one of them.
class FacetDraws {
  public:
    ///   slope   at which the density of slopes has fallen to half, > 0
    explicit FacetDraws(double slope) noexcept;

    /// Mirrored about a facet drawn with two numbers in [0, 1); may point below the horizon.
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;
    /// Density in solid angle of the view [1/sr].
    [[nodiscard]] double density(const DirectionPair& pair) const noexcept;

  private:
    double alpha_squared_;  // exp(-slope^2/alpha^2) is the density of slopes
};

/// A cone about the mirror direction that holds the specular term where that is spread over a solid angle, as
/// a box or as a lobe of facets (specular_box.hpp), with a quarter to spare.
class SpecularCone {
  public:
    ///   solid_angle   of the box [sr], > 0
    explicit SpecularCone(double solid_angle) noexcept;

    /// With two numbers in [0, 1), even in solid angle; may point below the horizon.
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;
    /// Density in solid angle of the view [1/sr].
    [[nodiscard]] double density(const DirectionPair& pair) const noexcept;

  private:
    double squared_sine_;  // of a quarter of the opening angle
};

struct WeightedView {
    Direction out;
    double weight;  ///< [sr]: the integral of g over the hemisphere is the sum of weight g(out)
};

/// `count` points of each kind, those below the horizon left out; a fixed low-discrepancy sequence.
///   slope                  of the lobe, see lobe_slope
///   specular_solid_angle   of a SpecularCone to draw from, too [sr]; 0 for none
[[nodiscard]] std::vector<WeightedView> lobe_quadrature(const Direction& in, double slope, int count,
                                                        double specular_solid_angle = 0);

}  // namespace hts::tables
