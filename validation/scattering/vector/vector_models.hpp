/// What closed forms say of rough surfaces of a perfect conductor, polarisation by polarisation, as a beam of
/// finite width sees them. The wavelength is the unit of length.
#pragma once

#include <array>
#include <string_view>

#include "hts/he_torrance_spectrum.hpp"
#include "hts/unified/he_unified_spectrum.hpp"
#include "validation/scattering/vector/plane_wave_beam.hpp"

namespace hts::validation {

enum class VectorModel {
    kirchhoff,   ///< sigma_0, not shadowed
    smith,       ///< the same with the shadowing of correlated heights, 1/(1 + Lambda_i + Lambda_r)
    he,          ///< the published model
    he_unified,  ///< its successor
};
inline constexpr std::array vector_models{VectorModel::kirchhoff, VectorModel::smith, VectorModel::he,
                                          VectorModel::he_unified};
/// "kirchhoff", "smith", "he", "he_unified".
[[nodiscard]] std::string_view name(VectorModel model) noexcept;

/// From incident into reflected polarisations, as in a JonesMatrix: `sp` is reflected s of incident p.
enum class Channel { ss, sp, ps, pp };
inline constexpr std::array channels{Channel::ss, Channel::sp, Channel::ps, Channel::pp};
/// "ss", "sp", "ps", "pp".
[[nodiscard]] std::string_view name(Channel channel) noexcept;

/// A quantity of each channel.
struct Channels {
    std::array<double, channels.size()> values{};

    [[nodiscard]] double operator[](Channel channel) const noexcept {
        return values[static_cast<std::size_t>(channel)];
    }
    [[nodiscard]] double& operator[](Channel channel) noexcept {
        return values[static_cast<std::size_t>(channel)];
    }
    void add(double weight, const Channels& other) noexcept {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * other.values[i];
    }
};

class ClosedForms {
  public:
    /// Of a surface in wavelengths.
    explicit ClosedForms(const Surface& surface);

    /// Power of the lobe per solid angle, of all that falls in: BRDF times cos theta_r [1/sr], by model.
    [[nodiscard]] std::array<Channels, vector_models.size()> lobes(const Direction& in,
                                                                   const Direction& out) const;
    /// The same averaged over the waves of a beam.
    [[nodiscard]] std::array<Channels, vector_models.size()> lobes(const PlaneWaveBeam& beam,
                                                                   const Direction& out) const;
    /// Shares of s and of p that are mirrored, by model, averaged over the waves.
    [[nodiscard]] std::array<std::array<double, 2>, vector_models.size()> mirrors(
        const PlaneWaveBeam& beam) const;

  private:
    HeTorranceSpectrum he_;
    HeUnifiedSpectrum unified_;
};

}  // namespace hts::validation
