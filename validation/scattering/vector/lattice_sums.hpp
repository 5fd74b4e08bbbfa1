/// Sums over a square lattice without its origin, continued to where they diverge: what a punctured
/// trapezoidal rule leaves out of a weakly singular integral over a plane.
#pragma once

namespace hts::validation {

/// S_ab = sum' m_a m_b / Q^(3/2) over the integers (m_x, m_y) but (0, 0), with
/// Q = (m_x, m_y)^2 + (slope_x m_x + slope_y m_y)^2, in the sense of Epstein's zeta function.
///
/// For a smooth f, integral u_a u_b/Q(u)^(3/2) f(u) d^2u = h^2 sum' (the same at the nodes of step h) - h
/// S_ab f(0) + O(h^3).
struct LatticeSums {
    double xx, xy, yy;
};
///   slope_x, slope_y   up to 3 in modulus      error   1e-11
///   formula   Ewald's: Gamma(3/2, T Q) on the lattice and on the reciprocal one
///   limit     slopes 0: xx = yy = 2 zeta(1/2) beta(1/2) = -1.9501324…, beta Dirichlet's
[[nodiscard]] LatticeSums lattice_sums(double slope_x, double slope_y) noexcept;

}  // namespace hts::validation
