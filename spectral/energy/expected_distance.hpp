/// How far the published model and its successor he_unified are to be expected from exact scattering, by
/// surface, wavelength, index and angle of incidence, per polarisation. Not a bound: an interpolation between
/// cases that were solved exactly, profiles that are rough along one direction (`hts truth models`, kept
/// in spectral/energy/data/).
///
///   cases    three studies: perfect conductors, which stand for metals, glass of index 1.5, which stands for
///            dielectrics, and K-correlated perfect conductors, nu 1/2 and 3/2
///   between  ln of the distance is a plane over (log2 sigma_0/lambda, log2 tau/lambda, theta_i, nu), fitted
///            to the cases with weights exp(-d^2/2), d in units of 0.6, 0.6, 10 degrees and 1/2, so that the
///            nearest count most
///   error    `left_out`: each case is predicted from the others
/// Not installed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::spectral {

/// rms over the angles of scattering, weighted with the exact energy [dB]; of errors of such, factors.
struct TrueDecibels {
    double te, tm, unpolarised;
};
struct BothTheories {
    TrueDecibels he, unified;
};

/// A surface under an angle of incidence, lengths in wavelengths.
struct StudiedPoint {
    double rms_roughness, correlation_length, theta_i_deg;
    /// Of K-correlated heights, whose correlation_length is l and rms_roughness that of the frequencies below
    /// most_studied_frequency; none of Gaussian ones.
    std::optional<double> nu{};
};
/// Beyond it the spectra of the K-correlated cases were cut, in one over the wavelength.
inline constexpr double most_studied_frequency = 2.5;

struct ExpectedDistance {
    BothTheories distance;
    bool studied;  ///< else the point or the index is outside what was studied, and the distance a guess
};
[[nodiscard]] ExpectedDistance expected_distance(const StudiedPoint& at, const RefractiveIndex& index);
/// Of a surface at a wavelength. Neither films nor other correlations than Gaussian and K-correlation were
/// studied.
[[nodiscard]] ExpectedDistance expected_distance(const Surface& surface, const SpectralSample& sample,
                                                 const Direction& in);

/// Whether the flat surface reflects at least half of the light along the normal, as the mirrors among metals
/// do, for which perfect conductors stand.
[[nodiscard]] bool reflects_as_metal(const RefractiveIndex& index);

/// What stands behind it.
struct DistanceStudy {
    std::string substance;  ///< "perfect conductors"
    std::size_t cases;
    BothTheories
        left_out;       ///< typical factor, exp of the rms of ln, between a case and what the others predict
    std::string range;  ///< "sigma0 0.05 to 2.4 lambda, …"
};
/// Of the study that stands for surfaces like this one.
[[nodiscard]] const DistanceStudy& distance_study(const Surface& surface, const RefractiveIndex& index);

}  // namespace hts::spectral
