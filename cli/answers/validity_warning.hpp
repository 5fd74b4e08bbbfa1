/// The one line on standard error that says how much of an answer lies outside the model's validity.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

#include "spectral/energy/validity.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// Counts verdicts, from any thread; what it says does not depend on their order.
class ValidityWarning {
  public:
    void note(const spectral::Validity& verdict) noexcept;
    /// Verdicts at one pair and every wavelength, of rough surfaces; of others nothing is known.
    void note(const spectral::Reflectance& reflectance, const DirectionPair& pair) noexcept;
    /// "hts: 3 of 10 values are outside the model's validity (curvature, slope): see hts info"; nothing if
    /// none is.
    void print() const;

  private:
    [[nodiscard]] std::string criteria() const;

    std::atomic<std::size_t> count_{0}, outside_{0};
    std::array<std::atomic<bool>, spectral::criterion_count> broken_{};
};

}  // namespace hts::cli
