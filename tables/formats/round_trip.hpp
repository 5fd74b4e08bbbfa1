/// How much of a reflectance survives a file: what was written compared with what a reader of the file gives.
///
/// The error at a pair of directions and a wavelength is |read - original|/peak, where peak is the largest
/// BRDF of the original for that angle of incidence and wavelength. Half of the pairs are drawn around the
/// lobe (facets with Gaussian slopes about as wide), half uniformly over the hemisphere, as many in a spread
/// specular term; the light is uniform over the hemisphere; all polar angles are at most 88 degrees. Same
/// seed, same pairs, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// A reader that also draws directions with a density: what a renderer makes of the file.
class HasDensity {
  public:
    virtual ~HasDensity() = default;
    /// Density of `pair.out` in solid angle [1/sr], >= 0, 0 below the horizon.
    [[nodiscard]] virtual double density(const DirectionPair& pair) const noexcept = 0;

  protected:
    HasDensity() = default;
    HasDensity(const HasDensity&) = default;
    HasDensity(HasDensity&&) = default;
    HasDensity& operator=(const HasDensity&) = default;
    HasDensity& operator=(HasDensity&&) = default;
};

/// An error and where it is.
struct PeakError {
    double error = 0;                          ///< |read - original|/peak [1]
    double theta_i = 0, theta_r = 0, phi = 0;  ///< [rad], phi between light and view, 0 ... pi
    double wavelength_um = 0;
    double original = 0, read_back = 0;  ///< [1/sr]
};

/// Directional-hemispherical reflectance of the diffuse terms [1], at the wavelength
/// where the two differ most.
struct AlbedoError {
    double theta_i;  ///< [rad]
    double wavelength_um;
    double original, read_back;
};

/// Integral of a density over the hemisphere.
struct DensityIntegral {
    double theta_i;   ///< [rad]
    double integral;  ///< [1]
};

struct RoundTrip {
    std::size_t pairs = 0, wavelengths = 0;
    PeakError worst;                       ///< of all pairs and wavelengths
    double median = 0, percentile_99 = 0;  ///< over the pairs, of the worst wavelength of each
    std::optional<PeakError>
        worst_mueller;  ///< of all elements, relative to the peak of m00; where both are polarised
    std::vector<AlbedoError> albedo;       ///< at 0, 15, … 75, 85 degrees
    std::vector<DensityIntegral> density;  ///< at the same angles, where the reader HasDensity

    /// Several lines for the eye.
    [[nodiscard]] std::string text() const;
    /// The same as a JSON object, angles in degrees.
    [[nodiscard]] std::string json() const;
};

struct RoundTripOptions {
    std::size_t pairs = 100'000;
    std::uint64_t seed = 1;
    /// Slope of the lobe to draw about (lobe.hpp); 0 for that of the original.
    double slope = 0;
    /// Of the box or lobe over which the original's specular term is spread (specular_box.hpp) [sr], so that
    /// as many pairs are drawn there and the integrals see it; 0 for none.
    double specular_solid_angle = 0;
};

/// Compares the two at the wavelengths they share.
/// hts::Error where these differ in number or by more than 1e-6 of their value.
[[nodiscard]] RoundTrip round_trip(const spectral::Reflectance& original,
                                   const spectral::Reflectance& read_back,
                                   const RoundTripOptions& options = {});

}  // namespace hts::tables
