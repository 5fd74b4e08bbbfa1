/// What standard error says of an answer: how much of it lies outside the model's validity, and that the
/// material reflects more than falls in.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/io/per_thread.hpp"
#include "spectral/energy/judgement.hpp"
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
    /// Verdicts at one pair and every wavelength, of rough surfaces, by spectral/energy/judgement.hpp; of
    /// others their gain alone is asked.
    void note(const spectral::Reflectance& reflectance, const DirectionPair& pair);
    /// "hts: 3 of 10 values are outside the model's validity (curvature, slope): see hts info", or in place
    /// of criteria the distance from exact scattering; nothing if none is. The same of a gain.
    ///   source   the material's file
    void print(const std::string& source) const;

  private:
    /// What was judged by its distance, and how; the view does not matter, and light seldom changes.
    struct Judged {
        std::array<double, 6> of{-1};
        spectral::Judgement judgement{};
    };
    struct Verdicts {
        std::size_t count = 0, outside = 0;
        std::array<bool, spectral::criterion_count> broken{};
        bool far = false, not_studied = false;  // of those that are judged by distance
        std::vector<Judged> last;               // by sample
    };
    void note(const spectral::Validity& verdict) noexcept;
    void note(const spectral::RoughSurface& surface, const SpectralSample& sample, const Direction& in,
              Judged& last);
    [[nodiscard]] Verdicts all() const;

    PerThread<Verdicts> verdicts_;
    GainWarning gain_;
};

}  // namespace hts::cli
