// What a direction is drawn from: the shares and scales of lobe_sampler.hpp's mixture
// at one angle of incidence.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "hts/sampling/scattering_lobe.hpp"

namespace hts::sampling_detail {

/// The densities of lobe_sampler.hpp, each facet lobe once per width, then the other lobes.
enum Part : std::size_t {
    lowered_half,
    lowered_1,
    lowered_2,
    raised_half,
    raised_1,
    raised_2,
    grazing_half,
    grazing_1,
    grazing_2,
    beam,
    cosine,
    uniform,
    components,  // of the directional-diffuse lobe
    uniform_diffuse = components,
    diffuse_parts,
    specular = diffuse_parts,
    parts
};

/// alpha^2 of a facet lobe over that of the mixture, and its root.
inline constexpr std::array<double, 3> widths{0.5, 1, 2};
inline constexpr std::array<double, 3> roots_of_widths{std::numbers::sqrt2 / 2, 1, std::numbers::sqrt2};
/// Lane 0 has the exponential of the beam, the others those of the widths.
inline constexpr std::size_t lanes = 4;

/// One angle of incidence, ready for the kernel: each part's factor is its share times
/// its density's constants.
struct alignas(64) Mixture {
    using Lanes = std::array<double, lanes>;

    Lanes rate{};     ///< exponents of 2: times |v_xy|^2 in lane 0, |q|^2 in the others
    Lanes lowered{};  ///< factors of the lowered facets
    Lanes raised{};   ///< of the raised ones
    Lanes grazing{};  ///< of the grazing ones, and in lane 0 of the beam
    double lowered_skew = 0, raised_skew = 0;
    double cosine = 0, uniform_diffuse = 0, uniform = 0;
    double alpha = 0, beam_radius = 0;
    alignas(32) std::array<double, 16> sums{};  ///< of the shares up to each part's own; 2 beyond

    /// Probability of a part.
    [[nodiscard]] double share(std::size_t part) const noexcept {
        return sums[part] - (part > 0 ? sums[part - 1] : 0);
    }
};

/// The mixtures of cos theta_i in eighths of octaves from 2^-8 on, one for all below and one for 1 alone.
inline constexpr std::size_t mixture_count = 66;

[[nodiscard]] constexpr std::size_t mixture_index(double cosine) noexcept {
    constexpr std::int64_t before_first = (std::int64_t{1023 - 8} << 3) - 1;
    const std::int64_t index = (std::bit_cast<std::int64_t>(cosine) >> 49) - before_first;
    return index > 0 ? static_cast<std::size_t>(index) : 0;
}

/// Of an anisotropic surface as many for each of these parts of a right angle between light and an axis,
/// one of all azimuths else.
inline constexpr std::size_t azimuth_count = 6;

/// The part that a light is in, from the first axis on.
[[nodiscard]] std::size_t azimuth_index(const Surface& surface, const Direction& in) noexcept;

/// Those of one surface at one wavelength: mixture_count of each azimuth.
[[nodiscard]] std::vector<Mixture> fitted_mixtures(const ScatteringLobe& lobe);

}  // namespace hts::sampling_detail
