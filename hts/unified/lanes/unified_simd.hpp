// The compiled forms of he_unified's spectral evaluation for one instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hts/evaluation/evaluation_simd.hpp"
#include "hts/unified/return_factor.hpp"
#include "hts/unified/unified_terms.hpp"

namespace hts::unified_detail {

/// What the lanes need of a surface.
struct SurfaceTerms {
    double slope_width;  // 2 sigma_0 / tau
    double variance;     // sigma_0^2 [um^2]
    double inverse_variance;
    double quarter_tau_squared;
    double return_width;                                    // slope_width, but at most 2
    double mixed;                                           // of the polarisations
    std::array<double, ReturnFactor::terms> return_factor;  // in powers of 2 y - 1
    evaluation_detail::AxisTerms axes;
    // m of surfaces of two correlation lengths: rows of the same powers, for T_0, T_1, ... of the width along
    // an azimuth, taken from -1 to 1 as (width - return_centre) return_scale
    std::vector<std::array<double, ReturnFactor::terms>> return_rows;
    double return_centre, return_scale;
};

/// Terms of r = sqrt(e - s^2) in powers of s^2, where |e| is large: the first left out is 21/1024 (s^2/e)^6.
inline constexpr std::size_t root_terms = 6;
inline constexpr double dense_square = 12;  ///< least |e| at every wavelength: there r keeps 7e-9

/// A surface and its optical constants, one column per quantity, each padded to whole
/// vectors with its last value.
struct Prepared {
    enum Column : std::size_t {
        wave_squared,  // k^2 [1/um^2]
        inverse_wave_squared,
        d_real,  // of d = N^2 - 1
        d_imaginary,
        weight,          // (k tau)^2 |d|^2 / 4 pi
        horizon,         // 1.25 k sigma_0
        lift,            // Z
        returned,        // R'
        uniform,         // uniform-diffuse BRDF
        mirror_slant,    // a^2 = slant s in x_s
        mirror_grazing,  // unified_mirror_grazing (k tau)^(-3/2)
        impedance_real,  // 1/N
        impedance_imaginary,
        root_real,
        root_imaginary = root_real + root_terms,
        columns = root_imaginary + root_terms
    };

    /// Rows of `seen`; of two correlation lengths the first two alone, along both axes.
    enum SeenRow : std::size_t { slope_width, slope_width_across, return_width, return_factor };

    SurfaceTerms surface;
    bool dense;  // whether the powers of s^2 serve
    std::size_t count, padded;
    std::vector<double> data;
    bool conductor = false;  // the shortcut, of unpolarised light
    // of a correlation that is not Gaussian: its table, and what each wavelength sees of the surface, the
    // last as ReturnFactor::terms rows
    const correlation_detail::LobeTable* correlation = nullptr;
    std::vector<double> seen{};

    [[nodiscard]] const double* operator[](Column column) const noexcept {
        return data.data() + column * padded;
    }
};

/// False, and the result untouched, where the pair is not ordinary.
using BrdfOne = bool (*)(const Prepared& prepared, const DirectionPair& pair, double* result);
using MuellerOne = bool (*)(const Prepared& prepared, const DirectionPair& pair, Mueller* result);
/// Whether every pair is ordinary; the others get an arbitrary result.
using BrdfMany = bool (*)(const Prepared& prepared, std::span<const DirectionPair> pairs, double* result);

/// Of samples first ... first + count - 1, at most 64: the lobe without its Jones matrix M and |d|^2, and the
/// share of Kirchhoff's matrix in M.
using SharesOne = bool (*)(const Prepared& prepared, const DirectionPair& pair, std::size_t first,
                           std::size_t count, double* lobes, double* shares);

/// Specular reflectances of unpolarised light by the closed form.
using SpecularOne = bool (*)(const Prepared& prepared, const Direction& in, double* result);

struct Forms {
    BrdfOne brdf_one;  ///< null on a processor without vectors
    BrdfMany brdf_many;
    MuellerOne mueller_one;
    SharesOne shares_one;
    SpecularOne specular_one;
};

/// What one instruction set has: with Phi and the kicks at 1e-3 and at 1e-6, and with 2 D of another
/// correlation.
struct FormTable {
    Forms low, medium, correlated;
};

/// The cheapest that meet a tolerance of 1e-6 or coarser, of the best instruction set this processor has.
///   correlated   whether the correlation is not Gaussian
[[nodiscard]] Forms forms(Tolerance tolerance, bool correlated) noexcept;

/// H of kicks_table.hpp where the table has no cell; 0 where Phi is.
[[nodiscard]] double far_mean_kicks(double g, double t) noexcept;

}  // namespace hts::unified_detail
