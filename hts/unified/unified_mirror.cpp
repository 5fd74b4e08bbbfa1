#include "hts/unified/unified_mirror.hpp"

#include <cmath>

namespace hts {
namespace {

double square(double x) {
    return x * x;
}

}  // namespace

FresnelAmplitudes unified_mirror(const Direction& in, const UnifiedWave& wave) noexcept {
    const double c = in.cos_theta(), s_squared = square(in.sin_theta());
    const Surface& surface = wave.seen;
    const double k_tau_along =
        surface.isotropic() ? wave.k_tau
                            : wave.k_tau * (surface.correlation_length(in) / surface.correlation_length());
    const double slant = std::sqrt(unified_mirror_slant * s_squared) / k_tau_along;
    const double slanted = std::sqrt(std::hypot(c * c, slant));
    const std::complex<double> impedance = wave.index.normal_impedance();
    const double below = std::norm(c + impedance);
    const double grazing =
        below > 0 ? unified_mirror_grazing * square(s_squared) / (wave.k_tau * std::sqrt(wave.k_tau)) / below
                  : 0;
    const double half = 2 * square(wave.k_sigma) * c;  // of 4 (k sigma_0)^2 c
    const FresnelAmplitudes flat = wave.index.amplitudes(c);
    return {flat.s * std::exp(-half * slanted), flat.p * std::exp(-half * (slanted + grazing))};
}

}  // namespace hts
