#include "cli/answers/reflectance_cache.hpp"

namespace hts::cli {

std::vector<spectral::EnergyCompensation> CompensationCache::at(const spectral::RoughSurface& surface,
                                                                const spectral::WavelengthGrid& wavelengths) {
    std::vector<spectral::EnergyCompensation> all;
    all.reserve(wavelengths.size());
    for (std::size_t i = 0; i < wavelengths.size(); ++i) all.push_back(at(surface, wavelengths[i]));
    return all;
}

const spectral::EnergyCompensation& CompensationCache::at(const spectral::RoughSurface& surface,
                                                          const Wavelength& wavelength) {
    std::unique_lock lock{mutex_};
    const auto& [along, across] = surface.correlation_lengths();
    Entry& entry = entries_[{surface.rms_roughness(), along, across, wavelength.micrometres()}];
    lock.unlock();
    std::call_once(entry.once, [&] { entry.solved.emplace(surface, wavelength); });
    return *entry.solved;
}

}  // namespace hts::cli
