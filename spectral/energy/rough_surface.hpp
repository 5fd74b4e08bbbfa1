/// A rough surface with the theory by which it reflects: that of He, Torrance, Sillion and Greenberg, or
/// its successor he_unified.
#pragma once

#include <functional>
#include <optional>
#include <variant>

#include "hts/direction.hpp"
#include "hts/films/coated_index.hpp"
#include "hts/surface.hpp"
#include "hts/unified/unified_choices.hpp"
#include "hts/wavelength.hpp"

namespace hts::spectral {

/// The frequencies [1/um] that an rms roughness was stated for: those of the periods
/// of a file's "rms_band_um".
struct FrequencyBand {
    double from, to;  ///< to may be infinite
};

/// Statistics of the heights, and the theory.
class RoughSurface : public Surface {
  public:
    /// By the published model.
    RoughSurface(const Surface& surface)
        : Surface{surface} {}  // NOLINT(google-explicit-constructor): what a surface was
    RoughSurface(double rms_roughness, double correlation_length)
        : Surface{rms_roughness, correlation_length} {}
    /// By its successor.
    RoughSurface(const Surface& surface, const UnifiedChoices& choices)
        : Surface{surface}, unified_{choices} {}

    /// The same theory of another surface.
    [[nodiscard]] RoughSurface with(const Surface& surface) const {
        RoughSurface other{surface};
        other.unified_ = unified_;
        return other;
    }
    /// The same with the band that its rms roughness was stated for; rms_roughness() is
    /// that of all frequencies.
    [[nodiscard]] RoughSurface stated_for(const FrequencyBand& band) const {
        RoughSurface other{*this};
        other.band_ = band;
        return other;
    }
    [[nodiscard]] const std::optional<FrequencyBand>& band() const noexcept { return band_; }
    /// Choices of he_unified; none of the published model.
    [[nodiscard]] const std::optional<UnifiedChoices>& unified() const noexcept { return unified_; }

  private:
    std::optional<UnifiedChoices> unified_;
    std::optional<FrequencyBand> band_;
};

/// Facets that reflect everything, |F|^2 = 1 at every angle: what is missing from 1 is then the model's own
/// loss. Of he_unified: a perfect conductor.
struct PerfectMirror {};
/// What a facet of the surface reflects.
using Facets = std::variant<PerfectMirror, CoatedIndex>;

/// |F|^2 of a facet for unpolarised light.
///   cos_theta   cosine of the angle of incidence on the facet   [1]   0 ... 1
[[nodiscard]] double facet_reflectance(const Facets& facets, double cos_theta) noexcept;

/// Shares of s and p in the light; by the mirror symmetry of the surface nothing else of
/// its polarisation counts.
struct Polarisation {
    double s = 0.5, p = 0.5;
};

/// What is reflected at one wavelength, for integrals over directions.
struct ReflectedLight {
    /// The lobe of one incident direction [1/sr].
    ///   t   v_xy^2 tau^2/4, which the caller knows better than the difference of two directions can
    using Lobe = std::function<double(const Direction& out, double t)>;

    std::function<double(const Direction& in)> mirror;  ///< the specular term [1]
    std::function<Lobe(const Direction& in)> lobe;
};
///   light   other than the default only where the facets have an index
[[nodiscard]] ReflectedLight reflected_light(const RoughSurface& surface, const Facets& facets,
                                             const Wavelength& wavelength, const Polarisation& light = {});

/// What is left of a mirror's light by shadowing alone, S at theta_r = theta_i [1]; 1 of he_unified,
/// whose mirror is not shadowed.
[[nodiscard]] double mirror_shadowing(const RoughSurface& surface, const Direction& in,
                                      const Wavelength& wavelength) noexcept;

}  // namespace hts::spectral
