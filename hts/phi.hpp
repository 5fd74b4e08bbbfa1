/// The roughness function Phi(g, t), on which every directional-diffuse lobe of the model depends.
///
///   Phi(g, t) = exp(-g) sum_{m >= 1} g^m / (m! m) exp(-t / m)      [He91 (78)]
///
/// g is the phase variance, t = v_xy^2 tau^2 / 4. Material, wavelength and directions enter only through
/// these two.
#pragma once

namespace hts {

namespace accuracy {
inline constexpr double phi = 1e-12;      ///< of `phi`, relative, wherever it exceeds 1e-280
inline constexpr double log_phi = 1e-14;  ///< of `log_phi`, relative to max(|log Phi|, 1)
}  // namespace accuracy

/// How a value of Phi was computed.
enum class PhiMethod {
    zero,       ///< g = 0 or t infinite: no term
    sum,        ///< every term that counts, outwards from the largest
    trapezoid,  ///< trapezoidal rule in m with a stride: about 30 terms however large g is
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
///   exp(-t/g)/g error    accuracy::phi, accuracy::log_phi cost     about 0.1 to 1 microsecond, whatever g
[[nodiscard]] Phi phi(double g, double t) noexcept;

}  // namespace hts
