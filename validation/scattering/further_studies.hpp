/// Exact scattering beyond the first maps (`exact_scattering`, `dielectric_scattering`): surfaces that no
/// constant of a model was chosen by, K-correlated ones, a metal, longer profiles, and what twice the points
/// change.
#pragma once

#include "validation/scattering/exact_scattering.hpp"

namespace hts::validation {

/// Perfectly conducting surfaces drawn by chance, each at three angles of incidence: sigma_0/tau 0.05 to 0.4
/// and tau 0.5 to 6 wavelengths, both even on a logarithmic scale, one angle in each
/// third of 10 to 75 degrees.
///   seed   fixed before anything was evaluated on these surfaces: 2026
[[nodiscard]] std::vector<LitSurface> drawn_surfaces(std::uint64_t seed, std::size_t count);

/// 14 of drawn_surfaces, 150 realisations of 50 wavelengths; quick: 2 of them, 20 realisations.
[[nodiscard]] GroundTruth unseen_study(Effort effort, const std::string& unfinished = {});
/// Perfectly conducting K-correlated surfaces drawn by chance: sigma_0 0.05 to 0.25 and l 0.5 to 4
/// wavelengths, even on a logarithmic scale, nu 1/2 (exponential) and 3/2 in turn, angles as of
/// drawn_surfaces. Their spectra are cut beyond most_frequency, 2.5 per wavelength.
///   seed   fixed before anything was evaluated on these surfaces: 2027
[[nodiscard]] std::vector<LitSurface> drawn_k_correlated(std::uint64_t seed, std::size_t count);
/// 8 of them, 100 realisations of 40 wavelengths, 16 points per wavelength; quick: 2, 20 realisations.
[[nodiscard]] GroundTruth k_correlation_study(Effort effort, const std::string& unfinished = {});
/// A metal of refractive index 0.16 + 3.6i: 3 surfaces at 20, 40 and 60 degrees, 160
/// realisations of 24 wavelengths.
[[nodiscard]] GroundTruth metal_study(Effort effort, const std::string& unfinished = {});
/// Smooth conductors at 60 and 70 degrees on profiles of 120 wavelengths in place of 50, so that less of the
/// light near the horizon passes their ends.
[[nodiscard]] GroundTruth grazing_study(Effort effort, const std::string& unfinished = {});
/// The same rough surfaces by the points of the studies and by twice as many: a
/// conductor, glass and the metal.
[[nodiscard]] GroundTruth refinement_study(Effort effort);

}  // namespace hts::validation
