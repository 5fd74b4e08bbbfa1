/// What rows of a points file share, made once. Any thread may ask.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "spectral/energy/compensation.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// What is made of one material for each wavelength.
template <class Value>
class WavelengthCache {
  public:
    /// The one at a wavelength, made where it is not there yet.
    ///   make   (double micrometres) -> Value
    template <class Make>
    [[nodiscard]] Value at(double micrometres, const Make& make) {
        {
            const std::lock_guard lock{mutex_};
            if (const auto found = made_.find(micrometres); found != made_.end()) return found->second;
        }
        const Value made = make(micrometres);
        const std::lock_guard lock{mutex_};
        if (made_.size() >= most) made_.clear();
        return made_.emplace(micrometres, made).first->second;
    }

  private:
    static constexpr std::size_t most =
        4096;  ///< before it starts anew: a file may have a wavelength of its own in each row
    std::mutex mutex_;
    std::map<double, Value> made_;
};

/// The energy compensation of surfaces of one material and wavelengths, each solved once.
class CompensationCache {
  public:
    /// One per wavelength.
    [[nodiscard]] std::vector<spectral::EnergyCompensation> at(const spectral::RoughSurface& surface,
                                                               const spectral::WavelengthGrid& wavelengths);

  private:
    struct Entry {
        std::once_flag once;
        std::optional<spectral::EnergyCompensation> solved;
    };
    [[nodiscard]] const spectral::EnergyCompensation& at(const spectral::RoughSurface& surface,
                                                         const Wavelength& wavelength);

    std::mutex mutex_;
    std::map<std::array<double, 4>, Entry> entries_;
};

}  // namespace hts::cli
