/// How far the published model and he_unified are from exact scattering by surfaces that are rough in both
/// directions, polarised, in and out of the plane of incidence: the case nearest to a surface, of the few
/// that were solved (`hts truth vector`; the distances by `hts truth models`, kept in spectral/energy/data/).
/// Nothing is interpolated.
/// Not installed.
#pragma once

#include <optional>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::spectral {

/// rms over the hemisphere up to 80 degrees, weighted with the exact energy [dB]; cross is s into p and p
/// into s.
struct PolarisedDecibels {
    double ss, pp, cross, unpolarised;
};

/// A case, lengths in wavelengths: a perfect conductor with a Gaussian correlation.
struct SolvedSurface {
    double rms_roughness;
    double length_in_plane, length_across;  ///< correlation lengths in the plane of incidence and across it
    double theta_i_deg;
    PolarisedDecibels he, unified;
};

/// The nearest to a surface of metal under light of a wavelength; none where its rms roughness or a
/// correlation length differs by more than a factor of 1.6 or the angle by more than 12 degrees, where no
/// axis of an anisotropic surface lies near the plane of incidence, where the normal reflectance is below a
/// half, under films, and for correlations that are not Gaussian.
[[nodiscard]] std::optional<SolvedSurface> nearest_solved(const Surface& surface,
                                                          const SpectralSample& sample, const Direction& in);

}  // namespace hts::spectral
