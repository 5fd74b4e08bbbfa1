/// The roughness function Phi(g, t), on which every directional-diffuse lobe of the model depends, in
/// constant time.
///
///   Phi(g, t) = exp(-g) sum_{m >= 1} g^m / (m! m) exp(-t / m)      [He91 (78)]
///
/// g is the phase variance, t = v_xy^2 tau^2 / 4. Material, wavelength and directions enter only through
/// these two.
///
/// Tables of polynomials hold every (g, t) with Phi > 1e-280, but for t > 7 where g < 1/128 (1/64 at
/// tolerance 1e-3): there the few terms that count are summed. Wherever the arguments' own last bits count
/// for more than an error stated here, they bound it: one ulp of t changes Phi by 1.1e-16 t/g at most.
#pragma once

#include <cstddef>
#include <span>

#include "hts/tolerance.hpp"

namespace hts {

namespace accuracy {
inline constexpr double phi = 1e-12;                  ///< of `phi`, relative, wherever it exceeds 1e-280
inline constexpr double log_phi = 4e-13;              ///< of `log_phi`, relative to max(|log Phi|, 1)
inline constexpr double phi_gradient = 1e-12;         ///< of `phi_gradient`, see there
inline constexpr double tabled_phi_gradient = 1e-10;  ///< the finest tolerance that its quicker form meets
}  // namespace accuracy

/// How a value of Phi was computed.
enum class PhiMethod {
    zero,       ///< g = 0 or infinite, or t infinite: no term
    table,      ///< piecewise polynomials about the saddle point
    sum,        ///< every term that counts, outwards from the largest
    trapezoid,  ///< trapezoidal rule in m with a stride: about 30 terms however large g is
    limit,      ///< one of its limits, chosen by the caller
    spline,     ///< 2 D in its place, by the table of another correlation
};

[[nodiscard]] const char* name(PhiMethod method) noexcept;

/// Phi with its logarithm, which stays finite where Phi underflows.
struct Phi {
    double value;
    double log;  ///< natural logarithm; -infinity for PhiMethod::zero
    PhiMethod method;
};

/// Phi and log Phi.
///   g        0 ... 1e300        t   0 ... infinity
///   limits   t = 0: exp(-g)(Ei(g) - ln g - gamma); g -> 0: g exp(-g - t); g -> infinity at fixed t/g:
///            exp(-t/g)/g
///   error    accuracy::phi, accuracy::log_phi
///   cost     about 40 ns, at every g; up to 1 microsecond where Phi < 1e-280 or few terms are summed
[[nodiscard]] Phi phi(double g, double t) noexcept;

/// Phi alone, by the cheapest form that meets a tolerance: one for 1e-3 and coarser, one for 1e-6, one for
/// 1e-12.
///   g, t       as above; NaN for a negative or NaN argument      range   [0, 0.52), falling in t
///   error      relative, at most `tolerance`; values below 1e-280 lose digits to underflow, and those below
///              1e-300 may be 0
///   cost       17, 20 or 30 ns (AMD Zen 4, 3.7 GHz, AVX-512), some 50 where few terms are summed
[[nodiscard]] double phi(double g, double t, Tolerance tolerance) noexcept;

/// Phi of many pairs, in vector lanes chosen by the processor. Each value has the bits of the call above for
/// that pair, wherever it stands.
///   g, t, result   equally long, else hts::Error; result may be g or t
///   cost           4.6, 5.1 or 13 ns a pair, as above
void phi(std::span<const double> g, std::span<const double> t, std::span<double> result, Tolerance tolerance);

/// Phi with its partial derivatives, and the same for log Phi, which does not underflow.
struct PhiGradient {
    double value;
    double d_g;  ///< Psi/g - Phi, Psi = exp(-g) sum g^m / m! exp(-t/m)
    double d_t;  ///< -exp(-g) sum g^m / (m! m^2) exp(-t/m)
    double log;
    double log_d_g;  ///< d log Phi / dg
    double log_d_t;  ///< d log Phi / dt
};

/// Phi and its derivatives, summed over a common scale.
///   g, t     as for phi
///   limits   g = 0: d_g = exp(-t), log_d_g = infinity
///   error    accuracy::phi_gradient, of value relative, of d_g relative to Psi/g + Phi (its two terms may
///            cancel), of d_t relative; of their logarithmic twins the same over Phi
///   cost     about 0.2 to 1 microsecond, whatever g and t
[[nodiscard]] PhiGradient phi_gradient(double g, double t) noexcept;

/// Phi and its derivatives by the cheapest form that meets a tolerance: the derivatives of the table's
/// polynomials from accuracy::tabled_phi_gradient on, else the sums.
///   g, t     as for phi
///   error    at most `tolerance`, of the kinds above; from the table also of g log_d_g, beside 1 plus
///            itself, where the sums lose 1e-16 sqrt(g)
///   cost     about a fifth of the sums
[[nodiscard]] PhiGradient phi_gradient(double g, double t, Tolerance tolerance) noexcept;

/// Bytes of coefficients behind `phi` at a tolerance: what it takes of the caches.
[[nodiscard]] std::size_t phi_table_bytes(Tolerance tolerance) noexcept;

}  // namespace hts
