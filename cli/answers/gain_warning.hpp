/// The one line on standard error that names a material which reflects more than falls in.
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// A lower bound of the directional-hemispherical reflectance: of rough surfaces the integral, of others the
/// mean weight of draws less three standard errors; none where nobody knows how to draw.
[[nodiscard]] std::optional<double> least_reflectance(const spectral::Reflectance& reflectance,
                                                      const Direction& in, std::size_t wavelength);

/// Looks at the steepest incidence of those it is told, at the first of its wavelengths. From any thread;
/// what it says does not depend on their order.
class GainWarning {
  public:
    void note(const spectral::Reflectance& reflectance, const Direction& in);
    ///   source   the material's file
    void print(const std::string& source) const;

  private:
    struct Place {
        spectral::Reflectance reflectance;
        Direction in;
    };
    std::mutex mutex_;
    std::optional<Place> place_;
};

}  // namespace hts::cli
