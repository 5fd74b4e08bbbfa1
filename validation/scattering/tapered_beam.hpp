/// A beam that lights a finite piece of a surface and leaves its ends dark [Thorsos88 (12)]:
///
///   psi = exp(i k_i r (1 + w) - q^2/g^2),   q = x + z tan theta,   w = (2 q^2/g^2 - 1)/(k g cos theta)^2
///
/// It obeys the wave equation to order 1/(k g cos theta)^2. Travels towards +x and down.
#pragma once

#include <complex>

namespace hts::validation {

class TaperedBeam {
  public:
    ///   theta   angle of incidence [rad], 0 ... below pi/2      width   g
    ///   wave_number   in units of 1/width
    TaperedBeam(double theta, double width, double wave_number) noexcept;

    [[nodiscard]] std::complex<double> field(double x, double z) const noexcept;
    /// (a d/dx + b d/dz) psi.
    [[nodiscard]] std::complex<double> derivative(double x, double z, double a, double b) const noexcept;
    /// Power through a horizontal line, in units where a plane wave carries 1 per length across it [Thorsos88
    /// (14)]: sqrt(pi/2) g cos theta (1 - (1 + 2 tan^2 theta)/(2 (k g cos theta)^2)).
    [[nodiscard]] double power() const noexcept;

  private:
    struct Exponent {
        std::complex<double> value, by_x, by_z;
    };
    [[nodiscard]] Exponent exponent(double x, double z) const noexcept;

    double sine_, cosine_, tangent_, width_, wave_number_, divergence_;
};

}  // namespace hts::validation
