#include "spectral/energy/surely_valid.hpp"

#include <limits>

namespace hts::spectral {

bool surely_valid(const Surface& surface, const DirectionPair& pair, const Wavelength& wavelength) noexcept {
    // of other shapes slopes depend on azimuth and wavelength; a mirror has no slopes
    if (!surface.isotropic() || surface.correlation() || surface.rms_roughness() == 0) return false;
    if (limits(Criterion::energy).outside != std::numeric_limits<double>::infinity()) return false;
    const auto lit = [&](const Direction& direction) {
        return direction.cos_theta() >= surface.slope_width() * direction.sin_theta();
    };
    if (!lit(pair.in) || !lit(pair.out)) return false;
    const double cosine = (1 - 1e-14) * (pair.in.cos_theta() + pair.out.cos_theta()) / 2;  // rounded down
    const double length = surface.correlation_length();
    const auto within = [](Criterion criterion, double measured) {
        return limits(criterion).severity(measured) != Severity::outside;
    };
    return within(Criterion::curvature,
                  wavelength.wave_number() * curvature_radius(surface) * (cosine * cosine * cosine)) &&
           within(Criterion::correlation_length, length / wavelength.micrometres()) &&
           within(Criterion::slope, surface.rms_roughness() / length);
}

}  // namespace hts::spectral
