/// What standard error says of an answer: how much of it lies outside the model's validity, and that the
/// material reflects more than falls in.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "cli/io/per_thread.hpp"
#include "spectral/energy/validity.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// Looks at the most oblique and the least oblique incidence of those it is told, at the first of their
/// wavelengths. From any thread; what it says does not depend on their order.
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
    struct Places {
        std::optional<Place> oblique, upright;
        void note(const spectral::Reflectance& reflectance, const Direction& in);
    };
    PerThread<Places> places_;
};

/// The same of a reflectance that is used as a whole: light along the normal and from 60 deg.
void warn_of_gain_of(const spectral::Reflectance& reflectance, const std::string& source);

/// Counts verdicts, from any thread; what it says does not depend on their order.
class ValidityWarning {
  public:
    void note(const spectral::Validity& verdict) noexcept;
    /// Verdicts at one pair and every wavelength, of rough surfaces; of others their gain alone is asked.
    void note(const spectral::Reflectance& reflectance, const DirectionPair& pair);
    /// "hts: 3 of 10 values are outside the model's validity (curvature, slope): see hts info"; nothing if
    /// none is. The same of a gain.
    ///   source   the material's file
    void print(const std::string& source) const;

  private:
    struct Verdicts {
        std::size_t count = 0, outside = 0;
        std::array<bool, spectral::criterion_count> broken{};
    };
    [[nodiscard]] Verdicts all() const;

    PerThread<Verdicts> verdicts_;
    GainWarning gain_;
};

}  // namespace hts::cli
