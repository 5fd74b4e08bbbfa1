#include "validation/scattering/tapered_beam.hpp"

#include <cmath>
#include <numbers>

namespace hts::validation {

TaperedBeam::TaperedBeam(double theta, double width, double wave_number) noexcept
    : sine_{std::sin(theta)},
      cosine_{std::cos(theta)},
      tangent_{sine_ / cosine_},
      width_{width},
      wave_number_{wave_number},
      divergence_{1 / (wave_number * width * cosine_ * (wave_number * width * cosine_))} {}

TaperedBeam::Exponent TaperedBeam::exponent(double x, double z) const noexcept {
    const double across = (x + z * tangent_) / width_;
    const double path = wave_number_ * (x * sine_ - z * cosine_);
    const double stretch = 1 + (2 * across * across - 1) * divergence_;
    // d/dx of across is 1/g, d/dz of it tan theta/g
    const double stretching = path * 4 * across * divergence_ / width_, taper = -2 * across / width_;
    return {{-across * across, path * stretch},
            {taper, wave_number_ * sine_ * stretch + stretching},
            {taper * tangent_, -wave_number_ * cosine_ * stretch + stretching * tangent_}};
}

std::complex<double> TaperedBeam::field(double x, double z) const noexcept {
    return std::exp(exponent(x, z).value);
}

std::complex<double> TaperedBeam::derivative(double x, double z, double a, double b) const noexcept {
    const Exponent e = exponent(x, z);
    return std::exp(e.value) * (a * e.by_x + b * e.by_z);
}

double TaperedBeam::power() const noexcept {
    return std::sqrt(std::numbers::pi / 2) * width_ * cosine_ *
           (1 - (1 + 2 * tangent_ * tangent_) * divergence_ / 2);
}

}  // namespace hts::validation
