// The compiled forms of the spectral evaluation for one instruction set.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::evaluation_detail {

/// The axes of a surface of two correlation lengths.
struct AxisTerms {
    bool isotropic;                        // then none of the rest is read
    double cosine, sine;                   // of the azimuth of the first
    double width_along, width_across;      // 2 sigma_0 / tau_x, 2 sigma_0 / tau_y
    double stretch_along, stretch_across;  // tau_x / tau, tau_y / tau
};

[[nodiscard]] AxisTerms axis_terms(const Surface& surface) noexcept;

/// What the lanes need of a surface.
template <class Number>
struct SurfaceTermsAs {
    Number slope_width;  // 2 sigma_0 / tau
    Number variance;     // sigma_0^2 [um^2]
    Number inverse_variance;
    Number quarter_tau_squared;
    Number tau_squared_over_pi;
    AxisTerms axes;
};

/// A surface and its optical constants, one column per quantity, each padded to whole
/// vectors with its last value.
template <class Number>
struct PreparedAs {
    enum Column : std::size_t {
        wave_squared,  // k^2 [1/um^2]
        inverse_wave_squared,
        d_real,  // of d = N^2 - 1
        d_imaginary_squared,
        weight,   // k^2 |d|^2, in single precision |d|^2
        uniform,  // uniform-diffuse BRDF
        columns
    };

    SurfaceTermsAs<Number> surface;
    std::size_t count, padded;
    std::vector<Number> data;
    // of a correlation that is not Gaussian: its table, and the slope widths along both axes that each
    // wavelength sees, first all along
    const correlation_detail::LobeTable* correlation = nullptr;
    std::vector<double> widths{};

    [[nodiscard]] const Number* operator[](Column column) const noexcept {
        return data.data() + column * padded;
    }
};
using SurfaceTerms = SurfaceTermsAs<double>;
using Prepared = PreparedAs<double>;
using PreparedSingle = PreparedAs<float>;

/// Below it a direction grazes so much that the exact path takes the pair: K = 2 / lowest_cosine still lies
/// within lambert_octaves.
inline constexpr double lowest_cosine = 1.1e-5;

[[nodiscard]] inline bool is_ordinary(const Direction& direction) noexcept {
    return direction.cos_theta() >= lowest_cosine;
}
[[nodiscard]] inline bool is_ordinary(const DirectionPair& pair) noexcept {
    return is_ordinary(pair.in) && is_ordinary(pair.out);
}

/// Fewer pairs than these go one by one, with the same bits: a block's vectors would be nearly empty, while
/// the wavelengths fill those of single pairs.
///   lanes   of the block's vectors
[[nodiscard]] constexpr std::size_t fewest_pairs(std::size_t wavelengths, std::size_t lanes) noexcept {
    return wavelengths <= 4 ? lanes / 2 + 3 : 2 * lanes;
}

/// Lengths and indices whose products stay far from the ends of a
/// double's range, in any order.
[[nodiscard]] bool is_ordinary(const Surface& surface, std::span<const SpectralSample> samples) noexcept;

/// What each sample sees of a surface whose correlation is not Gaussian, its table prepared; nothing of
/// others. hts::Error where the lobe is a limit that such a surface lacks, or the table does not reach g.
[[nodiscard]] std::vector<Surface> seen_surfaces(const Surface& surface,
                                                 std::span<const SpectralSample> samples, DiffuseLobe lobe);

/// hts::Error unless a result has a value for each sample, and for each pair of many.
void require_size(const char* call, std::size_t size, std::size_t samples, std::size_t pairs = 1);

/// False, and the result untouched, where the pair is not ordinary.
using BrdfOne = bool (*)(const Prepared& prepared, const DirectionPair& pair, double* result);
using MuellerOne = bool (*)(const Prepared& prepared, const DirectionPair& pair, Mueller* result);
using SpecularOne = bool (*)(const Prepared& prepared, const Direction& in, double* result);
/// Whether every pair is ordinary; the others get an arbitrary result.
using BrdfMany = bool (*)(const Prepared& prepared, std::span<const DirectionPair> pairs, double* result);

struct Forms {
    BrdfOne brdf_one;  ///< null on a processor without vectors
    BrdfMany brdf_many;
    MuellerOne mueller_one;
    SpecularOne specular_one;
};

/// What one instruction set has: Phi at 1e-3 and at 1e-6, its limits, and 2 D of other correlations.
struct FormTable {
    Forms low, medium, first_order, rough_limit, correlated;
};

/// The cheapest that meet a tolerance of 1e-6 or coarser, of the best instruction set this processor has.
///   correlated   whether the correlation is not Gaussian: then of the full lobe alone
[[nodiscard]] Forms forms(Tolerance tolerance, DiffuseLobe lobe, bool correlated) noexcept;

}  // namespace hts::evaluation_detail
