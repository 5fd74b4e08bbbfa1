/// Diffuse models: Lambert's, and that of Oren and Nayar (SIGGRAPH 1994) for rough matt surfaces.
/// (hts/phi/lambert.hpp is something else: Lambert's W function.)
#pragma once

#include "hts/microfacet/spectrum.hpp"

namespace hts {

namespace accuracy {
inline constexpr double oren_nayar = 1.4e-15;  ///< relative
}

/// The same radiance into every direction, albedo/pi. Exact, reciprocal, conserves energy.
class LambertianModel {
  public:
    ///   albedo   0 ... 1, else hts::Error
    explicit LambertianModel(double albedo);

    [[nodiscard]] double albedo() const noexcept { return albedo_; }

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    /// Weight: the albedo, always.
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept;

  private:
    double albedo_;
};

/// The qualitative model of Oren and Nayar: Lambertian V-shaped grooves of Gaussian slope,
///   albedo/pi (A + B max(0, cos(phi_i - phi_r)) sin(max theta) tan(min theta)),
///   A = 1 - 0.5 s^2/(s^2 + 0.33),   B = 0.45 s^2/(s^2 + 0.09),   s the standard
///   deviation of the slope's angle
///   normalisation   none: for albedo 1 it reflects about A at normal incidence, since light
///                   between facets is left out
///   flaws           reflects A + B/2 at grazing, above 1 for s below 0.326; a kink at 90
///                   deg between the azimuths
class OrenNayar {
  public:
    ///   albedo   of the facets, 0 ... 1      slope_angle   s [rad], 0 ... pi/2; else hts::Error
    OrenNayar(double albedo, double slope_angle);

    [[nodiscard]] double albedo() const noexcept { return albedo_; }
    [[nodiscard]] double slope_angle() const noexcept { return slope_angle_; }

    ///   error   accuracy::oren_nayar
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const OrenNayar> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] bool shares_geometry(const OrenNayar& other) const noexcept {
        return slope_angle_ == other.slope_angle_;
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept;

  private:
    double albedo_, slope_angle_;
    double a_, b_;
};

}  // namespace hts
