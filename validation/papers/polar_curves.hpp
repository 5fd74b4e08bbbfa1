/// In-plane curves of reflectance against view angle, as in He et al. 1991, Figures 7 to 10.
#pragma once

#include <optional>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::validation {

/// How source and receiver widen the specular term: both are cones of the same solid angle.
///
/// The delta reflects the source's cone into an equal cone about the mirror direction; a receiver off by the
/// angle d takes in the part of it that overlaps its own cone. With radiance averaged over the source's
/// cone, the measured BRDF is rho_s / (cos theta_i omega) [He91 (70)] times that part of the cone. Cones are
/// taken as flat discs; the diffuse terms, which hardly change within a cone, are not averaged.
class EqualCones {
  public:
    ///   solid_angle   omega [sr]  > 0 … 1, else hts::Error
    explicit EqualCones(double solid_angle);

    [[nodiscard]] double solid_angle() const noexcept { return solid_angle_; }
    /// acos(1 - omega / 2 pi) = 2 asin(sqrt(omega / 4 pi)) [rad].
    [[nodiscard]] double half_angle() const noexcept { return half_angle_; }
    /// Common part of two equal discs: 2/pi (acos x - x sqrt(1 - x^2)), x = off_mirror / (2 half angle).
    ///   range   1 at the mirror direction, 0 from two half angles on
    [[nodiscard]] double overlap(double off_mirror) const noexcept;
    /// The specular term as a BRDF [1/sr], averaged over the cones; 0 at grazing incidence.
    [[nodiscard]] double brdf(const SpecularReflectance& specular, double cos_theta_i,
                              double off_mirror) const noexcept;

  private:
    double solid_angle_, half_angle_;
};

struct PolarPoint {
    double view_angle;  ///< [deg] -90 … 90, positive on the mirror's side
    double directional_diffuse, uniform_diffuse, specular;  ///< [1/sr], the last averaged over the cones
    double radius;                                          ///< what is drawn

    [[nodiscard]] double brdf() const noexcept { return directional_diffuse + uniform_diffuse + specular; }
};

struct PolarCurve {
    double theta_i;  ///< [deg]
    std::vector<PolarPoint> points;
};

enum class PolarRadius {
    normalised,  ///< BRDF / BRDF in the specular direction [He91 (11)]
    absolute,    ///< BRDF [1/sr]
};

/// The curve of one angle of incidence, at the first wavelength.
///   theta_i, phi_i   of the light [deg], theta_i 0 … 90      cones   none leaves the specular term out
/// Throws hts::Error if the radius shall be normalised and the BRDF in the specular direction is 0.
[[nodiscard]] PolarCurve polar_curve(const spectral::Reflectance& reflectance, double theta_i, double phi_i,
                                     const std::optional<EqualCones>& cones, PolarRadius radius);

/// A point of the plane of incidence by direction sines, beta towards the viewer and beta_0
/// of the mirror direction.
struct SinePoint {
    double beta;                                  ///< sin theta_r, negative on the light's side
    double difference;                            ///< |beta - beta_0|, > 0
    double directional_diffuse, uniform_diffuse;  ///< [1/sr]

    [[nodiscard]] double brdf() const noexcept { return directional_diffuse + uniform_diffuse; }
};

/// Both sides of the mirror direction, each from the least difference to the horizon in
/// equal steps of its logarithm.
struct SineCurve {
    double theta_i;                         ///< [deg]
    std::vector<SinePoint> beyond, within;  ///< beta > beta_0, towards the horizon, and beta < beta_0
};

/// The curve of one angle of incidence, at the first wavelength, without the specular term: the usual plot of
/// optical scatter, on which a spectrum of heights that is a power law is a straight line, the same for all
/// angles of incidence [Harvey 1976].
///   theta_i, phi_i   of the light [deg], theta_i 0 … 90      least   of the differences, > 0
[[nodiscard]] SineCurve sine_curve(const spectral::Reflectance& reflectance, double theta_i, double phi_i,
                                   double least);

}  // namespace hts::validation
