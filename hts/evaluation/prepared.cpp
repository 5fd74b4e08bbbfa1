// What the spectral evaluation prepares and asks beforehand, the same for every instruction set.
#include <algorithm>
#include <string>

#include "hts/error.hpp"
#include "hts/evaluation/evaluation_simd.hpp"

namespace hts::evaluation_detail {

AxisTerms axis_terms(const Surface& surface) noexcept {
    const auto& [along, across] = surface.correlation_lengths();
    const double height = 2 * surface.rms_roughness(), mean = surface.correlation_length();
    return {surface.isotropic(), surface.axis().cos_phi(), surface.axis().sin_phi(),
            height / along,      height / across,          along / mean,
            across / mean};
}

bool is_ordinary(const Surface& surface, std::span<const SpectralSample> samples) noexcept {
    const auto length = [](double x) { return x >= 1e-6 && x <= 1e6; };
    const auto& [along, across] = surface.correlation_lengths();
    return length(surface.rms_roughness()) && length(along) && length(across) &&
           std::all_of(samples.begin(), samples.end(), [&](const SpectralSample& s) {
               return length(s.wavelength.micrometres()) && s.index.substrate().n() >= 1e-3 &&
                      s.index.substrate().n() <= 1e6 && s.index.substrate().k() <= 1e6;
           });
}

std::vector<Surface> seen_surfaces(const Surface& surface, std::span<const SpectralSample> samples,
                                   DiffuseLobe lobe) {
    if (!surface.correlation()) return {};
    if (lobe == DiffuseLobe::rough_limit) {
        throw Error{
            "lobe rough_limit of a correlation that is not gaussian: must be full, first_order or none"};
    }
    std::vector<Surface> seen;
    seen.reserve(samples.size());
    for (const SpectralSample& sample : samples) {
        const double k_sigma = sample.wavelength.wave_number() * surface.rms_roughness();
        if (4 * k_sigma * k_sigma > Correlation::most_phase_variance) {
            throw Error{"rms roughness " + shortest(surface.rms_roughness()) + " um at the wavelength " +
                        shortest(sample.wavelength.micrometres()) +
                        " um: must be at most 795 wavelengths where the correlation is not gaussian"};
        }
        seen.push_back(surface.seen_by(sample.wavelength));
    }
    if (lobe == DiffuseLobe::full && surface.rms_roughness() > 0) surface.correlation()->prepare();
    return seen;
}

void require_size(const char* call, std::size_t size, std::size_t samples, std::size_t pairs) {
    if (size == pairs * samples) return;
    throw Error{std::string{call} + ": result has " + std::to_string(size) + " values: must be " +
                (pairs == 1 ? "" : "pairs x ") + "samples = " + std::to_string(pairs * samples)};
}

}  // namespace hts::evaluation_detail
