// Phi by summation, for every (g, t): what phi falls back on outside its tables, takes its derivatives from,
// and is tested against.
#pragma once

#include "hts/phi.hpp"

namespace hts::phi_detail {

/// Phi and its companions e^(-g) sum_{m >= 1} g^m / m! m^(-k) e^(-t/m), which are Psi (k = 0), Phi (k = 1)
/// and -dPhi/dt (k = 2), as one logarithm and two means under the weights of Phi's own terms.
struct PhiSum {
    double log;           ///< ln Phi
    double excess;        ///< <m> - g = Psi/Phi - g = g d ln Phi / dg
    double inverse_mean;  ///< <1/m> = -d ln Phi / dt
    double rest;          ///< 1 - <1/m>, without the difference
    PhiMethod method;
};

/// The sums.
///   domain  0 < g <= 1e300, 0 <= t < infinity
///   error   log: 1e-14 of max(|log|, 1); excess: 1e-13 of <m> + g; inverse_mean and
///           rest: 1e-13 of themselves
///   cost    about 0.1 to 1 microsecond, whatever g
[[nodiscard]] PhiSum phi_sum(double g, double t) noexcept;

/// An upper bound, within a few units, of ln Phi where it is far below -700; cheaper than the sum.
///   domain  as phi_sum
[[nodiscard]] double log_phi_bound(double g, double t) noexcept;

}  // namespace hts::phi_detail
