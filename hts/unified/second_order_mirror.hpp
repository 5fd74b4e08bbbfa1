/// The specular amplitudes of a rough surface by second-order perturbation theory, for he_unified with
/// "mirror": "second_order".
///
/// From the reduced Rayleigh equations, with a(q) = sqrt(e - q^2), a0(q) = sqrt(1 - q^2), q in units of k,
/// N_s = a - a0, N_p = (a - a0)/(q^2 + a a0), W the spectrum of heights of unit variance, and for waves p
/// from q, phi the angle from p to q, M+-_ss = cos phi, M+-_sp = +-a0(q) sin phi, M+-_ps = -a(p) sin phi,
/// M+-_pp = p q +- a(p) a0(q) cos phi:
///
///   R2_b = N_b(k) {(1/2) [(a + a0) M-_bb(k|k) + (a - a0) M+_bb(k|k) F_b]
///                  - integral of W(q - k) sum over g of M+_bg(k|q) N_g(q) [M-_gb(q|k)
///                    + M+_gb(q|k) F_b] d^2 q}
///
/// and to second order the amplitude is R_b = F_b + (k sigma_0)^2 R2_b. What is used is
///   F_b exp((k sigma_0)^2 R2_b/F_b)                      where |F_b|^2 >= 0.1 |F_s|^2
///   exp(-g/2) (F_b + (k sigma_0)^2 R2_b + F_b g/2)       where |F_b|^2 <= 0.02
///   |F_s|^2, about Brewster's angle
/// with g = (2 k sigma_0 cos theta)^2, and a smooth blend of both between. Derivation in
/// docs/models/he_unified.md.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "hts/direction.hpp"
#include "hts/fresnel.hpp"

namespace hts {

namespace accuracy {
/// Of the table of SecondOrderMirror, as of R2, beside 2 cos theta.
inline constexpr double second_order_mirror = 5e-4;
}  // namespace accuracy

/// R2_s and R2_p, by quadrature.
///   cos_theta   0 ... 1      k_tau   > 0
///   error       by the rule's own estimate 1e-11 of the integral of each piece
///   cost        some 0.1 ms
[[nodiscard]] FresnelAmplitudes second_order(double cos_theta, double k_tau, const RefractiveIndex& index);

/// The amplitudes at one wavelength, from a table of R2 over theta.
class SecondOrderMirror {
  public:
    ///   cost   some 20 ms
    SecondOrderMirror(double k_sigma, double k_tau, const RefractiveIndex& index);

    /// Of s and p.
    [[nodiscard]] FresnelAmplitudes operator()(const Direction& in) const noexcept;
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    double k_sigma_;
    RefractiveIndex index_;
    std::vector<FresnelAmplitudes> table_;  // R2 over 2 cos theta
};

}  // namespace hts
