/// Geometric optics on explicit surfaces: rays through Gaussian height fields of perfect mirrors, however
/// often they are reflected. Only sigma_0/tau matters; tau is the unit of length.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hts/direction.hpp"
#include "validation/scattering/gaussian_surface.hpp"

namespace hts::validation {

/// A periodic height field of flat triangles, two a cell.
class FacetSurface {
  public:
    explicit FacetSurface(RandomField field);

    /// A ray, with a direction of any length.
    struct Ray {
        Vector3 origin, direction;
    };
    struct Hit {
        Vector3 point, normal;  ///< normal upwards, not of unit length
    };
    /// The first facet that a ray from above the surface or from a point on it meets; none if it leaves
    /// upwards. A ray that leaves a facet must go to its upper side.
    [[nodiscard]] std::optional<Hit> first_hit(const Ray& ray) const;
    /// Point and facet at a place in the period.
    [[nodiscard]] Hit at(double x, double y) const;

    [[nodiscard]] double highest() const noexcept { return highest_; }
    [[nodiscard]] double period() const noexcept;

  private:
    struct Cell {
        double low, along, across, high;  // heights at (0,0), (1,0), (0,1), (1,1)
    };
    [[nodiscard]] Cell cell(std::ptrdiff_t i, std::ptrdiff_t j) const;

    RandomField field_;
    double highest_;
};

struct TracingSettings {
    int surfaces = 24;  ///< each of 24 tau x 24 tau
    int samples_per_tau = 16;
    int points = 4000;  ///< of a surface, looked at along each direction
    int rays = 20000;   ///< onto a surface from each direction
    std::uint64_t study = 1967;
};

/// How much of a surface is lit, along a direction and in the one seen from it too.
struct ShadowingPoint {
    double slope;  ///< sigma_0/tau
    double theta_deg;
    double lit, lit_error;  ///< share of the surface's plan, and its standard error from surface to surface
    double lit_and_seen;    ///< from the mirror direction
    double smith;           ///< S_1 [He91 (24)]
    double he_torrance;     ///< S = S_1^2 [He91 (23)]
    double correlated;  ///< share lit and seen if heights are, 1/(1 + Lambda_i + Lambda_r) of facing points
};

/// Where the light of one direction goes.
struct BouncePoint {
    double slope, theta_i_deg;
    double once, once_error;  ///< share that leaves after one reflection
    double more;              ///< after two or more
    double lost;              ///< still inside after `most_bounces`
    double he_torrance;       ///< what the model's lobe returns in the rough limit, |F| = 1
};

/// Light reflected once into the plane of incidence, within 15 degrees of azimuth.
struct LobePoint {
    double slope, theta_i_deg, theta_r_deg;  ///< theta_r < 0 on the side of the source
    double traced;                           ///< BRDF x cos theta_r [1/sr], mean over the bin
    double he_torrance;                      ///< the model's rough limit
    double smith;  ///< Beckmann's facets of sigma_0 with 1/(1 + Lambda_i + Lambda_r)
};

inline constexpr int most_bounces = 1000;

[[nodiscard]] std::vector<ShadowingPoint> shadowing_points(double slope, const std::vector<double>& theta_deg,
                                                           const TracingSettings& settings);

struct TracedLight {
    BouncePoint bounces;
    std::vector<LobePoint> lobe;
};
[[nodiscard]] TracedLight traced_light(double slope, double theta_i_deg, const TracingSettings& settings);

}  // namespace hts::validation
