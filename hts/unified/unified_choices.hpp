/// What he_unified (unified_terms.hpp) leaves to choose.
#pragma once

namespace hts {

struct UnifiedChoices {
    /// The exponents of the specular term: in closed form (unified_mirror.hpp), or by second-order
    /// perturbation theory as an integral (second_order_mirror.hpp).
    enum class Mirror { closed, second_order } mirror = Mirror::closed;
    /// Whether a share 0.2 (sigma_0/tau)^2 of the lobe, at most 1/2, changes s for p. A
    /// fit to what scatters twice.
    bool polarisation_mixing = false;
};

}  // namespace hts
