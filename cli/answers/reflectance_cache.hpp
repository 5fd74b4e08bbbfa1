/// What rows of a points file share, made once. Any thread may ask.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "cli/io/per_thread.hpp"
#include "spectral/energy/compensation.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// What is made of one material for each wavelength, once by each thread.
template <class Value>
class WavelengthCache {
  public:
    /// The one at a wavelength, made where it is not there yet; it stays until the thread asks again.
    ///   make   (double micrometres) -> Value
    template <class Make>
    [[nodiscard]] const Value& at(double micrometres, const Make& make) {
        auto& made = made_.mine();
        if (const auto found = made.find(micrometres); found != made.end()) return found->second;
        if (made.size() >= most) made.clear();
        return made.emplace(micrometres, make(micrometres)).first->second;
    }

  private:
    static constexpr std::size_t most =
        4096;  ///< before it starts anew: a file may have a wavelength of its own in each row
    PerThread<std::map<double, Value>> made_;
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
