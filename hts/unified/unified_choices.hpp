/// What he_unified (unified_terms.hpp) leaves to choose.
#pragma once

namespace hts {

// Of UnifiedChoices::conductor_shortcut.
namespace accuracy {
/// Least reflectance of the flat surface along the normal.
inline constexpr double least_of_conductors = 0.5;
/// From the whole lobe, rms over directions with the weight of light [dB]: silver to chromium, sigma_0/tau
/// 0.05 to 0.5; for tau of 1 to 4 lambda and light up to 60 degrees, and for tau from 0.5 and up to 75.
inline constexpr double conductor_shortcut_gentle_db = 1.5, conductor_shortcut_db = 3.5;
}  // namespace accuracy

struct UnifiedChoices {
    /// The exponents of the specular term: in closed form (unified_mirror.hpp), or by second-order
    /// perturbation theory as an integral (second_order_mirror.hpp).
    enum class Mirror { closed, second_order } mirror = Mirror::closed;
    /// Whether a share 0.2 (sigma_0/tau)^2 of the lobe, at most 1/2, changes s for p. A
    /// fit to what scatters twice.
    bool polarisation_mixing = false;
    /// Whether unpolarised light gets the lobe of a perfect conductor times |F|^2 of the facet, in place of
    /// the complex matrix of the metal. An approximation by accuracy::conductor_shortcut_db. Mueller matrices
    /// and polarised light keep the metal's.
    bool conductor_shortcut = false;
};

}  // namespace hts
